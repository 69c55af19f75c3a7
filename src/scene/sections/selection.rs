//! The keys that select vertices.

use crate::mesh::Selection;
use crate::scene::keys::{Boundary, Table};

/// The keys that select vertices.
pub(super) fn selection(table: &mut Table) -> Selection {
    let section = optional_selection(table);
    if section.is_none() && table.is_given() {
        let reason = format!("{} selects nothing", table.title());
        table.complain("vertices", reason, "add vertices, boundary, box, ball or nearest");
    }
    section.unwrap_or(Selection::Vertices(Vec::new()))
}

pub(super) fn optional_selection(table: &mut Table) -> Option<Selection> {
    let vertices =
        table.key("vertices", "Vertices by their numbers in the mesh file, counted from 0.").optional(vec![0, 1]);
    let boundary = table
        .key::<Boundary>(
            "boundary",
            "All vertices of these boundary loops, counted from 0 as `immerse check` lists them; or \"outer\", the one \
             around the others, or \"longest\", of each component.",
        )
        .optional(Boundary::Loops(vec![0]));
    let corners = table
        .key("box", "Vertices in the box with these opposite corners.")
        .optional([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]);
    let ball = table.key("ball", "Vertices in the ball [x, y, z, radius].").optional([0.0, 0.0, 1.0, 0.5]);
    let nearest = table.key("nearest", "The vertex nearest to each of these points.").optional(vec![[0.0, 0.0, 1.0]]);
    let names = ["vertices", "boundary", "box", "ball", "nearest"];
    table.only_one_of(&names);
    let section = match (vertices, boundary, corners, ball, nearest) {
        (Some(vertices), ..) => Selection::Vertices(vertices),
        (_, Some(loops), ..) => loops.into(),
        (_, _, Some(corners), ..) => Selection::Box(corners),
        (_, _, _, Some(ball), _) => Selection::Ball(ball),
        (.., Some(points)) => Selection::Nearest(points),
        _ => return None,
    };
    let empty = match &section {
        Selection::Vertices(list) | Selection::Boundary(list) => list.is_empty(),
        Selection::Nearest(points) => points.is_empty(),
        _ => false,
    };
    if empty && let Some(name) = names.into_iter().find(|name| table.has(name)) {
        table.complain(
            name,
            format!("`{name}` is empty"),
            format!("name at least one, or remove this {}", table.title()),
        );
    }
    Some(section)
}
