//! A scene as plain data: what the file says, after types and keys were checked and defaults filled in.
//!
//! Angles are in degrees here, as in the file. Lengths and times are unit-free. Nothing in this module
//! computes; each stage turns its part into a validated value in its own `from_scene`.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::Source;

/// A whole scene.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File stem of the scene, the default name of its output folder.
    pub name: String,
    /// Folder of the scene file; relative paths in it start here.
    pub folder: PathBuf,
    /// The surface.
    pub mesh: MeshSection,
    /// Its edge lengths.
    pub metric: MetricSection,
    /// Its regular homotopy class.
    pub spin: SpinSection,
    /// Where the frames start.
    pub start: StartSection,
    /// Stages of the relaxation; empty means the default ones.
    pub phases: Vec<PhaseSection>,
    /// Target bending angles.
    pub bending: Option<BendingSection>,
    /// Point constraints.
    pub pins: Vec<PinSection>,
    /// How many frames.
    pub clock: ClockSection,
    /// The view.
    pub camera: CameraSection,
    /// Lights; empty means the studio's three.
    pub lights: Vec<LightSection>,
    /// Colours and lines.
    pub look: LookSection,
    /// Picture size and format.
    pub output: OutputSection,
    /// What the result must satisfy.
    pub checks: ChecksSection,
    /// Where the file says it, for the messages of later stages.
    pub source: Source,
}

/// `[mesh]`: a file or a generated shape.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSection {
    /// `file = "…"`: OBJ, PLY, OFF or STL, by its ending.
    File(PathBuf),
    /// `shape = "…"` with that shape's parameters.
    Shape(Shape),
}

impl Default for MeshSection {
    fn default() -> Self {
        MeshSection::Shape(Shape::Sphere { radius: 1.0, subdivisions: 16 })
    }
}

/// Generated shapes with their parameters (defaults in parentheses).
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Icosphere: `radius` (1), `subdivisions` of an icosahedron's edges into this many parts (16).
    Sphere { radius: f64, subdivisions: usize },
    /// Meridians and parallels: `radius` (1), `meridians` (48), `parallels` (24).
    UvSphere { radius: f64, meridians: usize, parallels: usize },
    /// A parallelogram with opposite sides glued, known by its lengths alone: lattice vectors `a`
    /// ([3, 0]) and `b` ([0, 2.5]), `columns` (60) along a and `rows` (50) along b, `grid`
    /// ("equilateral": every second row is shifted by half a cell where the rows are even, or "square").
    FlatTorus { a: [f64; 2], b: [f64; 2], columns: usize, rows: usize, grid: Grid },
    /// Torus of revolution: `major_radius` (1), `minor_radius` (0.4), `columns` (96), `rows` (40).
    Torus { major_radius: f64, minor_radius: f64, columns: usize, rows: usize },
    /// Cylinder without lids: `radius` (1), `height` (2), `columns` (64) around, `rows` (24) up.
    Cylinder { radius: f64, height: f64, columns: usize, rows: usize },
    /// Flat annulus: `inner_radius` (0.5), `outer_radius` (1), `columns` (64) around, `rows` (12).
    Annulus { inner_radius: f64, outer_radius: f64, columns: usize, rows: usize },
    /// Flat disk of equilateral-like triangles: `radius` (1), `rings` (24).
    Disk { radius: f64, rings: usize },
    /// Disk of constant negative curvature with geodesic edge lengths: `curvature` (−1), geodesic
    /// `radius` (3), about `faces` triangles (5000).
    HyperbolicDisk { curvature: f64, radius: f64, faces: usize },
    /// Polyhedron with every edge divided into `subdivisions` (8) parts: a `name` ("tetrahedron",
    /// "cube", "octahedron", "dodecahedron", "icosahedron", "genus_two") or `vertices` and `polygons`.
    Polyhedron { source: PolyhedronSource, subdivisions: usize },
    /// Isosurface of a tree of solids, remeshed to `edge_length` (0.05).
    Implicit { solid: Solid, edge_length: f64 },
}

/// How the cells of a flat torus are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// Rows shifted by half a cell, so that a lattice of the right proportions is equilateral.
    Equilateral,
    /// Parallelograms cut along a diagonal.
    Square,
}

/// Where the polyhedron comes from.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum PolyhedronSource {
    /// A built-in one.
    Named(String),
    /// Explicit corners and polygons (counterclockwise seen from outside, any number of sides).
    Explicit { vertices: Vec<[f64; 3]>, polygons: Vec<Vec<usize>> },
}

/// A solid: a primitive or a group, and how it joins what stands before it in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub body: Body,
    /// How it joins the solids before it (the first one ignores this).
    pub operation: Operation,
    /// Width over which the joint is rounded, 0 for a sharp one.
    pub blend: f64,
}

/// Primitives by signed distance, and groups.
#[allow(missing_docs)] // the parameters are described with their shape
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A ball.
    Sphere { center: [f64; 3], radius: f64 },
    /// A tube with round ends; with two radii a round cone.
    Capsule { from: [f64; 3], to: [f64; 3], radii: [f64; 2] },
    /// A ring around `axis`.
    Torus { center: [f64; 3], axis: [f64; 3], major_radius: f64, minor_radius: f64 },
    /// An ellipsoid with semi-axes `radii`, turned by `rotation` degrees about x, then y, then z.
    Ellipsoid { center: [f64; 3], radii: [f64; 3], rotation: [f64; 3] },
    /// Several solids, joined in order.
    Group(Vec<Solid>),
}

/// How a solid joins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Added.
    Union,
    /// Cut away.
    Difference,
    /// Only what both have.
    Intersection,
}

/// `[metric]`: where edge lengths come from.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum MetricSection {
    /// Left out: the lengths the shape decrees, or those of the mesh's own positions.
    #[default]
    OfMesh,
    /// `length = 0.05`: the same for every edge.
    Uniform(f64),
    /// `csv = "…"`: lines `u,v,length`, every edge once.
    Csv(PathBuf),
    /// `formula = "…"`: an expression in x, y, z of the edge midpoint and `length`, the length of the mesh.
    Formula(String),
}

/// `[spin]`
#[derive(Clone, Debug, PartialEq, Default)]
pub enum SpinSection {
    /// Left out: as "immersion" where the mesh has positions and no lengths were decreed, else zeros.
    #[default]
    Automatic,
    /// `class = "immersion"`: read off the mesh's positions (Sec. 4.1.2).
    Immersion,
    /// `class = "01"`: one digit of q per generator, shortest generator first.
    Digits(String),
}

/// `[start]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartSection {
    /// `random = 7`: independent uniform frames from this seed.
    Random(u64),
    /// `from = "mesh"`: frames of the mesh's positions.
    Mesh,
    /// `from = "mirror"`: frames of the mirror image of the mesh's positions.
    Mirror,
    /// `from = "spectral"`: lowest modes of the connection Laplacian.
    Spectral,
}

impl Default for StartSection {
    fn default() -> Self {
        StartSection::Random(0)
    }
}

/// `[[phase]]`: one stage of the relaxation. What is left out is as in the default value.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseSection {
    /// Which step is taken.
    pub method: MethodName,
    /// (length, bending, normal rotation, torsion) weights (Eq. 20).
    pub epsilon: [f64; 4],
    /// Time step in units of the mean face area.
    pub dt: f64,
    /// How far the frame of a face of mean area is moved toward that of the integrated surface after each step,
    /// 0 to 1: `1 − exp(−Δt/(a A))` of Alg. 8.
    pub feedback: f64,
    /// How far frames are moved toward those of edge vectors without periods, 0 to 1.
    pub periods: f64,
    /// Stiffness of creases that are about to fold over; 0 lets them.
    pub crease: f64,
    /// Whether steps are combined with earlier ones once they shrink (Anderson acceleration).
    pub accelerate: bool,
    /// The stage ends when the mean turn of a frame per step is below this (degrees),
    pub tolerance: f64,
    /// and not before this many steps;
    pub min_steps: usize,
    /// it is said not to have converged after this many,
    pub max_steps: usize,
    /// or, as long as there are rims, this many more.
    pub untangle_steps: usize,
}

impl Default for PhaseSection {
    fn default() -> Self {
        Self {
            method: MethodName::Implicit,
            epsilon: [1.0, 1e-4, 1.0, 0.1],
            dt: 100.0,
            feedback: 1.0,
            periods: 1.0,
            crease: 1.0,
            accelerate: true,
            tolerance: 0.01,
            min_steps: 3,
            max_steps: 200,
            untangle_steps: 0,
        }
    }
}

/// Steps by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodName {
    /// Alg. 5/8 with the basis of the norm frozen during a step.
    Implicit,
    /// Alg. 5/8 as printed.
    Gradient,
    /// Alg. 6.
    Newton,
}

/// `[bending]`: target bending angles (Sec. 6.3).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BendingSection {
    /// `from = "mesh"`: those of the mesh's positions.
    Mesh,
    /// `from = "mirror"`: those of its mirror image.
    Mirror,
}

/// `[[pin]]`: vertices held in place (Sec. 5.4.1).
#[derive(Clone, Debug, PartialEq)]
pub struct PinSection {
    /// Vertices by index.
    pub vertices: Vec<usize>,
    /// Where they belong; empty means where the mesh's positions are.
    pub positions: Vec<[f64; 3]>,
}

/// `[clock]`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClockSection {
    /// Number of frames; 1 is a static scene, the relaxed surface.
    pub frames: usize,
    /// Steps between the frames of a film of the relaxation.
    pub steps_per_frame: usize,
}

impl Default for ClockSection {
    fn default() -> Self {
        Self { frames: 1, steps_per_frame: 2 }
    }
}

/// `[camera]`: everything left out frames the surface by itself.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CameraSection {
    /// Direction from the surface to the eye; left out, the best view along the principal axes.
    pub direction: Option<[f64; 3]>,
    /// Up in the picture.
    pub up: Option<[f64; 3]>,
    /// Vertical field of view in degrees; 0 is orthographic.
    pub field_of_view: Option<f64>,
    /// Share of the picture the surface fills, 0 to 1.
    pub fill: Option<f64>,
}

/// `[[light]]`: a directional light in view space.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSection {
    /// Toward the light; x right, y up, z toward the eye.
    pub direction: [f64; 3],
    /// Linear colour times strength.
    pub color: [f64; 3],
    /// Whether it casts shadows.
    pub shadow: bool,
}

/// `[look]`
#[derive(Clone, Debug, PartialEq)]
pub struct LookSection {
    /// sRGB of the side the normal points from.
    pub front: [u8; 3],
    /// sRGB of the other side.
    pub back: [u8; 3],
    /// sRGB behind the surface.
    pub background: [u8; 3],
    /// Strength of the mesh edges, 0 to 1.
    pub wireframe: f64,
    /// Whether silhouettes, boundary and rims are drawn.
    pub lines: bool,
}

impl Default for LookSection {
    fn default() -> Self {
        Self {
            front: [0xE0, 0x82, 0x3D],
            back: [0x3E, 0x7C, 0xB8],
            background: [0xF4, 0xF3, 0xF0],
            wireframe: 0.0,
            lines: true,
        }
    }
}

/// `[output]`
#[derive(Clone, Debug, PartialEq)]
pub struct OutputSection {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Samples per pixel: 1, 4, 8 or 16.
    pub samples: usize,
    /// PNG pictures.
    pub png: bool,
    /// EXR pictures.
    pub exr: bool,
}

impl Default for OutputSection {
    fn default() -> Self {
        Self { size: [1280, 960], samples: 8, png: true, exr: false }
    }
}

/// `[checks]`: what must hold on the last frame.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct ChecksSection {
    /// Bound on the L2 relative length error.
    pub max_l2_length_error: Option<f64>,
    /// Bound on the number of rims.
    pub max_rims: Option<usize>,
    /// Bound on the number of pinch points.
    pub max_pinch_points: Option<usize>,
    /// The class the result must have.
    pub class: Option<String>,
}
