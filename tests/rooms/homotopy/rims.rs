//! Events put together to rims: what is born, moves, joins, parts and dies.

use immerse::homotopy::{Change, Element, Event, FilmEvent, RimCounts, rims_through_time};
use immerse::mesh::{EdgeId, FaceId, Mesh};
use std::cmp::Ordering::{Equal, Greater, Less};

/// A film of which hinges fold over, one after the other.
fn film(mesh: &Mesh, edges: &[[usize; 2]]) -> Vec<FilmEvent> {
    let edge = |ends: &[usize; 2]| {
        let has = |e: &EdgeId| {
            let [a, b] = mesh.edge_vertices(*e).map(|v| v.index());
            [a, b] == *ends || [b, a] == *ends
        };
        mesh.edges().find(has).expect("an edge")
    };
    let event = |(interval, ends)| FilmEvent { interval, event: of(Element::Hinge(edge(ends)), [Less, Greater]) };
    edges.iter().enumerate().map(event).collect()
}

fn of(element: Element, sides: [std::cmp::Ordering; 2]) -> Event {
    Event { element, time: [0.5; 2], lasts: false, place: glam::DVec3::ZERO, sides }
}

/// A row of vertices 0, 1, 2 … with edges between neighbours.
fn row() -> Mesh {
    let cells = (0..8_u32).flat_map(|k| [[k, k + 1, k + 10], [k, k + 10, k + 9]]);
    Mesh::from_faces(18, &cells.collect::<Vec<_>>()).expect("a row of cells")
}

#[test]
fn a_rim_is_born_grows_joins_another_parts_and_dies() {
    let mesh = row();
    let along = |k: usize| [k, k + 1];
    let events = film(
        &mesh,
        &[along(0), along(1), along(4), along(3), along(2), along(3), along(4), along(7), along(2), along(1), along(0)],
    );
    use Change::{Birth, Death, Join, Move, Part};
    let rims = rims_through_time(&mesh, &[], &events);
    assert_eq!(rims.changes, [Birth, Move, Birth, Move, Join, Part, Death, Birth, Move, Move, Death]);
    let runs: Vec<(&[usize], usize)> = rims.runs.iter().map(|run| (&*run.events, run.edges_left)).collect();
    assert_eq!(runs, [(&[0, 1, 2, 3, 4, 5, 6, 8, 9, 10][..], 0), (&[7][..], 1)]);
    let counts = RimCounts { births: 3, moves: 4, joins: 1, parts: 1, deaths: 2, ..Default::default() };
    assert_eq!(rims.counts, counts);
    assert_eq!(rims.runs[1].counts, RimCounts { births: 1, ..Default::default() });
}

/// Rims that are there in the beginning die; what only touches, and faces that vanish, change no rim.
#[test]
fn the_first_frame_has_rims_of_its_own() {
    let mesh = row();
    let mut events = film(&mesh, &[[2, 3], [0, 1], [0, 1]]);
    let first = [events[0].event.element, events[1].event.element].map(|element| match element {
        Element::Hinge(edge) => edge,
        Element::Face(_) => panic!("a hinge"),
    });
    events[1].event.sides = [Less, Less];
    events.push(FilmEvent { interval: 3, event: of(Element::Face(FaceId(0)), [Equal; 2]) });
    let rims = rims_through_time(&mesh, &first, &events);
    assert_eq!(rims.changes, [Change::Death, Change::Touch, Change::Death, Change::Vanishing]);
    assert!(rims.runs.iter().all(|run| run.events.len() == 1 && run.edges_left == 0));
    let left = rims_through_time(&mesh, &first, &[]);
    assert_eq!(left.runs.iter().map(|run| run.edges_left).collect::<Vec<_>>(), [1, 1]);
}
