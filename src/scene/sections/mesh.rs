//! `[mesh]`: files and generated shapes with their parameters, and the tree of solids.

use std::path::Path;
use std::sync::LazyLock;

use super::solid::part;
use crate::mesh::shapes::{Body, Grid, Operation, PolyhedronSource, Shape, Solid, limits, polyhedron_names};
use crate::mesh::{FileFormat, Weld};
use crate::scene::data::MeshSection;
use crate::scene::keys::Table;
use crate::scene::keys::suggestion;

/// Bounds that keep a mistyped number from asking for more memory than there is; the shapes limit their faces besides.
const MAX_PARTS: f64 = 1000.0;
const MAX_CELLS: f64 = 10_000.0;

static FILE_DOC: LazyLock<String> =
    LazyLock::new(|| format!("A mesh file ({}, by its ending), relative to the scene.", FileFormat::names()));

pub(super) fn mesh(table: &mut Table) -> (MeshSection, Option<Weld>) {
    let file = table.key::<String>("file", &FILE_DOC).optional("bunny.obj".into());
    let shape = table.variants(
        "shape",
        "The name of a generated shape; its parameters stand beside it.",
        &[
            ("sphere", "A sphere of nearly equilateral triangles.", sphere),
            ("uv_sphere", "A sphere of meridians and parallels.", uv_sphere),
            ("octasphere", "A sphere with the symmetry of an octahedron or of another bipyramid around the z axis.", octasphere),
            ("halfway", "The halfway model of a sphere eversion, around the z axis: Morin's surface, Boy's surface twice covered, and so on.", halfway),
            ("flat_torus", "A parallelogram with opposite sides glued, known by its lengths alone.", flat_torus),
            ("torus", "A torus of revolution around the z axis.", torus),
            ("cylinder", "A cylinder without lids around the z axis.", cylinder),
            ("annulus", "A flat annulus in the plane of x and y.", annulus),
            ("disk", "A flat disk in the plane of x and y.", disk),
            ("hyperbolic_disk", "A disk of constant negative curvature, known by its lengths; x and y in formulas are places in the Poincaré disk.", hyperbolic_disk),
            ("polyhedron", "A polyhedron whose edges are divided: one that is built in, or your own.", polyhedron),
            ("implicit", "The surface of solids that are joined, cut from one another, and rounded where they meet.", implicit),
        ],
    );
    // Generated shapes have no seams.
    let weld = if table.has("weld") || !table.has("shape") { weld(table) } else { None };
    table.only_one_of(&["file", "shape"]);
    if weld.is_some() && shape.is_some() {
        table.complain("weld", "`weld` joins vertices of a `file`, and this is a generated shape", "remove it");
    }
    if table.has_none_of(&["file", "shape"]) {
        table.complain(
            "shape",
            "[mesh] has neither `file` nor `shape`",
            "add for example file = \"bunny.obj\" or shape = \"sphere\"",
        );
    }
    let section = match (file, shape) {
        (Some(file), _) => {
            if FileFormat::of(Path::new(&file)).is_none() {
                let ending = Path::new(&file).extension().map(|ending| ending.to_string_lossy().to_lowercase());
                let ending = ending.unwrap_or_default();
                let reason = format!("`file` ends in `.{ending}`, which is no mesh format that can be read");
                let endings = FileFormat::ALL.map(FileFormat::ending);
                table.complain("file", reason, suggestion("endings", &ending, &endings));
            }
            MeshSection::File(file.into())
        }
        (None, Some(shape)) => MeshSection::Shape(shape),
        (None, None) => MeshSection::default(),
    };
    (section, weld)
}

fn weld(table: &mut Table) -> Option<Weld> {
    let doc = "Whether boundary edges of a file that lie upon each other become one: \"exact\", a largest distance, or \
               \"none\". Left out, \"exact\", for STL files also within the rounding of single precision; FOLD files and \
               arrays stay as they are.";
    table.key("weld", doc).at_least(0.0).optional(Weld::Exact)
}

/// A number of subdivisions, columns, rows.
fn count(table: &mut Table, name: &'static str, doc: &'static str, least: usize, default: usize) -> usize {
    table.key(name, doc).at_least(least as f64).at_most(MAX_CELLS).or(default)
}

fn radius(table: &mut Table) -> f64 {
    table.key("radius", "Its radius.").above(0.0).or(1.0)
}

fn sphere(table: &mut Table) -> Shape {
    Shape::Sphere {
        radius: radius(table),
        subdivisions: table
            .key(
                "subdivisions",
                "Parts into which each edge of an icosahedron is divided; there are 20 subdivisions² triangles.",
            )
            .at_least(limits::LEAST_SUBDIVISIONS as f64)
            .at_most(MAX_PARTS)
            .or(16),
    }
}

fn uv_sphere(table: &mut Table) -> Shape {
    Shape::UvSphere {
        radius: radius(table),
        meridians: count(table, "meridians", "Number of meridians.", limits::LEAST_MERIDIANS, 48),
        parallels: count(table, "parallels", "Number of parallels.", limits::LEAST_PARALLELS, 24),
    }
}

fn octasphere(table: &mut Table) -> Shape {
    Shape::Octasphere {
        radius: radius(table),
        subdivisions: table
            .key("subdivisions", "Parts into which each edge is divided; there are 2 sides subdivisions² triangles.")
            .at_least(limits::LEAST_SUBDIVISIONS as f64)
            .at_most(MAX_PARTS)
            .or(24),
        sides: count(table, "sides", "Corners of the equator, 4 of an octahedron.", limits::LEAST_SIDES, 4),
    }
}

fn halfway(table: &mut Table) -> Shape {
    Shape::Halfway {
        lobes: table
            .key("lobes", "Lobes: 2 is Morin's surface, 3 Boy's surface twice covered.")
            .at_least(limits::LEAST_LOBES as f64)
            .at_most(limits::MOST_LOBES as f64)
            .or(2),
        subdivisions: table
            .key(
                "subdivisions",
                "Parts into which each edge of an octasphere is divided; there are 4 lobes subdivisions² triangles.",
            )
            .at_least(limits::LEAST_SUBDIVISIONS as f64)
            .at_most(MAX_PARTS)
            .or(40),
    }
}

fn flat_torus(table: &mut Table) -> Shape {
    let a = table.key("a", "First side of the parallelogram, [x, y].").or([3.0, 0.0]);
    let b = table.key("b", "Second side, [x, y].").or([0.0, 2.5]);
    let grid = table.choice_or(
        "grid",
        "\"equilateral\" shifts every second row by half a cell; \"square\" cuts cells along a diagonal.",
        &[("equilateral", Grid::Equilateral), ("square", Grid::Square)],
        Grid::Equilateral,
    );
    let size = f64::max(a[0].abs() + a[1].abs(), b[0].abs() + b[1].abs());
    let area = (a[0] / size) * (b[1] / size) - (a[1] / size) * (b[0] / size);
    if area.is_nan() || area.abs() <= 1e-9 {
        let reason = format!("the lattice vectors {a:?} and {b:?} are parallel, so that they span no torus");
        table.complain("b", reason, "write for example a = [3, 0] and b = [0, 2.5]");
    }
    Shape::FlatTorus {
        a,
        b,
        columns: count(table, "columns", "Cells along a.", limits::LEAST_COLUMNS, 60),
        rows: count(table, "rows", "Cells along b.", limits::LEAST_FLAT_TORUS_ROWS, 50),
        grid,
    }
}

/// Reports the smaller of two radii if it is not smaller.
fn ordered(table: &Table, small: (&str, f64), large: (&str, f64)) {
    if small.1 >= large.1 {
        let reason = format!("`{}` is {}, not less than `{}`, which is {}", small.0, small.1, large.0, large.1);
        table.complain(small.0, reason, format!("write a number between 0 and {}", large.1));
    }
}

fn torus(table: &mut Table) -> Shape {
    let major_radius =
        table.key("major_radius", "Distance from the axis to the middle of the tube.").above(0.0).or(1.0);
    let minor_radius = table.key("minor_radius", "Radius of the tube.").above(0.0).or(0.4);
    ordered(table, ("minor_radius", minor_radius), ("major_radius", major_radius));
    Shape::Torus {
        major_radius,
        minor_radius,
        columns: count(table, "columns", "Cells around the axis.", limits::LEAST_COLUMNS, 96),
        rows: count(table, "rows", "Cells around the tube.", limits::LEAST_TORUS_ROWS, 40),
    }
}

fn cylinder(table: &mut Table) -> Shape {
    Shape::Cylinder {
        radius: radius(table),
        height: table.key("height", "Its height.").above(0.0).or(2.0),
        columns: count(table, "columns", "Cells around.", limits::LEAST_COLUMNS, 64),
        rows: count(table, "rows", "Cells up.", limits::LEAST_ROWS, 24),
    }
}

fn annulus(table: &mut Table) -> Shape {
    let inner_radius = table.key("inner_radius", "Radius of the hole.").above(0.0).or(0.5);
    let outer_radius = table.key("outer_radius", "Radius of the outer rim.").above(0.0).or(1.0);
    ordered(table, ("inner_radius", inner_radius), ("outer_radius", outer_radius));
    Shape::Annulus {
        inner_radius,
        outer_radius,
        columns: count(table, "columns", "Cells around.", limits::LEAST_COLUMNS, 64),
        rows: count(table, "rows", "Cells outward.", limits::LEAST_ROWS, 12),
    }
}

fn disk(table: &mut Table) -> Shape {
    Shape::Disk {
        radius: radius(table),
        rings: table
            .key("rings", "Rings of triangles around the middle; there are 6 rings² triangles.")
            .at_least(limits::LEAST_RINGS as f64)
            .at_most(MAX_PARTS)
            .or(24),
    }
}

fn hyperbolic_disk(table: &mut Table) -> Shape {
    Shape::HyperbolicDisk {
        curvature: table.key("curvature", "Gaussian curvature, per length squared.").below(0.0).or(-1.0),
        radius: table.key("radius", "Radius, measured along the surface.").above(0.0).or(3.0),
        faces: table
            .key("faces", "About how many triangles.")
            .at_least(limits::LEAST_DISK_FACES as f64)
            .at_most(limits::MOST_FACES as f64)
            .or(5000),
    }
}

fn polyhedron(table: &mut Table) -> Shape {
    let names: Vec<(&'static str, &'static str)> = polyhedron_names().map(|name| (name, name)).collect();
    let name = table.choice("name", "A built-in polyhedron; or give `vertices` and `polygons`.", &names);
    let vertices = table.key::<Vec<[f64; 3]>>("vertices", "Its corners, [x, y, z] each.").optional(vec![
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, 0.0],
    ]);
    let polygons = table
        .key::<Vec<Vec<usize>>>(
            "polygons",
            "Its faces, each a list of corners by their place in `vertices`, counterclockwise as seen from outside.",
        )
        .optional(vec![vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 1], vec![1, 3, 2]]);
    table.only_one_of(&["name", "vertices"]);
    table.only_one_of(&["name", "polygons"]);
    if table.has_none_of(&["name", "vertices"]) || table.has_none_of(&["name", "polygons"]) {
        table.complain(
            "shape",
            "a polyhedron needs a `name`, or both `vertices` and `polygons`",
            "add for example name = \"cube\"",
        );
    }
    let source = match (name, vertices, polygons) {
        (None, Some(vertices), Some(polygons)) => {
            check_polygons(table, vertices.len(), &polygons);
            PolyhedronSource::Explicit { vertices, polygons }
        }
        // Without a name the scene is refused.
        (name, ..) => PolyhedronSource::Named(name.unwrap_or_default().to_owned()),
    };
    let subdivisions = table
        .key("subdivisions", "Parts into which each edge is divided.")
        .at_least(limits::LEAST_SUBDIVISIONS as f64)
        .at_most(MAX_PARTS)
        .or(8);
    Shape::Polyhedron { source, subdivisions }
}

fn check_polygons(table: &Table, vertex_count: usize, polygons: &[Vec<usize>]) {
    for (i, polygon) in polygons.iter().enumerate() {
        if polygon.len() < 3 {
            let reason = format!("`polygons[{i}]` has {} corners, a polygon has at least 3", polygon.len());
            table.complain("polygons", reason, "add its corners or remove it");
        }
        if let Some(&vertex) = polygon.iter().find(|&&vertex| vertex >= vertex_count) {
            let reason = format!("`polygons[{i}]` names vertex {vertex}, but there are {vertex_count} vertices");
            table.complain("polygons", reason, "name vertices by their place in `vertices`, counted from 0");
        }
    }
}

fn implicit(table: &mut Table) -> Shape {
    let parts = table.tables("parts", "Solids, joined one after another. Each has one of the keys `sphere`, `capsule`, `torus`, `ellipsoid` and `group`.", part);
    if parts.is_empty() && !table.has("parts") {
        table.complain("shape", "an implicit shape has no `parts`", "add [[mesh.parts]] with sphere = { radius = 1 }");
    } else if parts.is_empty() {
        table.complain("parts", "`parts` is empty", "add [[mesh.parts]] with sphere = { radius = 1 }");
    }
    Shape::Implicit {
        solid: Solid { body: Body::Group(parts), operation: Operation::Union, blend: 0.0 },
        edge_length: table.key("edge_length", "About how long the edges of the mesh are.").above(0.0).or(0.05),
    }
}
