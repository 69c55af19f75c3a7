//! Solids of an implicit shape: primitives by signed distance, and groups.

use crate::mesh::shapes::{Body, Operation, Solid};
use crate::scene::keys::Table;

const BODIES: [&str; 5] = ["sphere", "capsule", "torus", "ellipsoid", "group"];

pub(super) fn part(table: &mut Table) -> Solid {
    let operation = table.choice_or(
        "operation",
        "What is done with what stands before it: it is added, cut off, or only what both have is kept.",
        &[
            ("union", Operation::Union),
            ("difference", Operation::Difference),
            ("intersection", Operation::Intersection),
        ],
        Operation::Union,
    );
    let blend = table.key("blend", "Width over which the joint is rounded; 0 leaves a crease.").at_least(0.0).or(0.0);
    let primitives = [
        table.optional_table("sphere", "A ball.", ball),
        table.optional_table("capsule", "A tube with round ends; with two radii a round cone.", capsule),
        table.optional_table("torus", "A ring.", ring),
        table.optional_table("ellipsoid", "An ellipsoid.", ellipsoid),
    ];
    let group = table.tables_like("group", "parts", "Several solids, joined in order.", part);
    table.only_one_of(&BODIES);
    if table.has_none_of(&BODIES) {
        table.complain("sphere", "this part is no solid", "add one of sphere, capsule, torus, ellipsoid and group");
    }
    if table.has("group") && group.is_empty() {
        table.complain("group", "`group` is empty", "write for example group = [{ sphere = { radius = 1 } }]");
    }
    let body = primitives.into_iter().flatten().next().unwrap_or(Body::Group(group));
    Solid { body, operation, blend }
}

fn center(table: &mut Table) -> [f64; 3] {
    table.key("center", "Its middle.").or([0.0; 3])
}

fn ball(table: &mut Table) -> Body {
    Body::Sphere { center: center(table), radius: table.key("radius", "Its radius.").above(0.0).required(1.0) }
}

fn capsule(table: &mut Table) -> Body {
    let from = table.key("from", "One end of the axis.").required([0.0, 0.0, 0.0]);
    let to = table.key("to", "The other end.").required([0.0, 0.0, 1.0]);
    let radius = table.key::<f64>("radius", "Radius all along.").above(0.0).optional(0.2);
    let radii = table.key::<[f64; 2]>("radii", "Radius at `from` and at `to`.").above(0.0).optional([0.3, 0.1]);
    table.only_one_of(&["radius", "radii"]);
    if table.has_none_of(&["radius", "radii"]) {
        table.complain("radius", "a capsule needs a `radius` or two `radii`", "add for example radius = 0.2");
    }
    Body::Capsule { from, to, radii: radii.unwrap_or([radius.unwrap_or(1.0); 2]) }
}

fn ring(table: &mut Table) -> Body {
    let center = center(table);
    let axis = table.key("axis", "Axis of revolution.").or([0.0, 0.0, 1.0]);
    if axis == [0.0; 3] {
        table.complain("axis", "`axis` is the zero vector, which points nowhere", "write for example axis = [0, 0, 1]");
    }
    let major_radius =
        table.key("major_radius", "Distance from the axis to the middle of the tube.").above(0.0).required(1.0);
    let minor_radius = table.key("minor_radius", "Radius of the tube.").above(0.0).required(0.3);
    Body::Torus { center, axis, major_radius, minor_radius }
}

fn ellipsoid(table: &mut Table) -> Body {
    Body::Ellipsoid {
        center: center(table),
        radii: table.key("radii", "Its three half-axes.").above(0.0).required([1.0, 0.7, 0.5]),
        rotation: table.key("rotation", "How it is turned: degrees about x, then y, then z.").or([0.0; 3]),
    }
}
