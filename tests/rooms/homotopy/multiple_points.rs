//! Where sheets pass through each other: planes that meet in known points, and an eversion, whose quadruple points are odd in number.

use super::points;
use crate::support::scene;
use glam::DVec3;
use immerse::evolve::Unobserved;
use immerse::homotopy::{MultiplePoints, Sheets};
use immerse::mesh::Mesh;

/// Four triangles: parts of the planes of the coordinates, and of x + y + z = s.
fn planes(s: f64) -> Vec<DVec3> {
    let around = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| [a, b, c];
    let coordinates = [
        around([0.0, -3.0, -3.0], [0.0, 5.0, -3.0], [0.0, -3.0, 5.0]),
        around([-3.0, 0.0, -3.0], [-3.0, 0.0, 5.0], [5.0, 0.0, -3.0]),
        around([-3.0, -3.0, 0.0], [5.0, -3.0, 0.0], [-3.0, 5.0, 0.0]),
    ];
    let slanted = [[5.0, -2.0, -3.0], [-3.0, 5.0, -2.0], [-2.0, -3.0, 5.0]]
        .map(|[x, y, z]| [x + s / 3.0, y + s / 3.0, z + s / 3.0]);
    points(&[coordinates[0], coordinates[1], coordinates[2], slanted].concat())
}

fn four() -> Mesh {
    Mesh::from_faces(12, &[[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]]).expect("four triangles")
}

#[test]
fn planes_meet_in_known_points() {
    let mut film = MultiplePoints::new(&four());
    for s in [-0.5, 1.0, 1.0, 0.25] {
        film.append(&planes(s));
    }
    // Every two planes cross in a line, and every three in a point.
    assert_eq!(film.frames(), [Sheets { double_curves: 6, double_segments: 6, triple_points: 4 }; 4]);
    let [moment] = film.quadruple_points() else { panic!("{:?}", film.quadruple_points()) };
    assert_eq!((moment.interval, moment.faces.map(|f| f.index())), (0, [0, 1, 2, 3]));
    assert!((moment.time - 1.0 / 3.0).abs() < 1e-6 && moment.place.length() < 1e-6, "{moment:?}");
}

/// The moment falls on a frame exactly, and once the film turns back there: it passes once, or not at all.
#[test]
fn a_moment_on_a_frame_counts_once() {
    for (frames, odd) in [([-0.5, 0.0, 0.5], true), ([-0.5, 0.0, -0.5], false)] {
        let mut film = MultiplePoints::new(&four());
        frames.iter().for_each(|s| film.append(&planes(*s)));
        assert_eq!(film.quadruple_points().len() % 2 == 1, odd, "{:?}", film.quadruple_points());
    }
}

/// Triangles that miss each other's insides though their planes meet.
#[test]
fn planes_alone_are_not_enough() {
    let mut film = MultiplePoints::new(&four());
    for s in [-0.5, 1.0] {
        let mut places = planes(s);
        places[9..].iter_mut().for_each(|place| *place += DVec3::new(20.0, -10.0, -10.0));
        film.append(&places);
    }
    assert!(film.quadruple_points().is_empty());
    assert_eq!(film.frames()[0], Sheets { double_curves: 3, double_segments: 3, triple_points: 1 });
}

/// Max and Banchoff (1981): every eversion of the sphere has an odd number of quadruple points. A closed surface of even Euler characteristic
/// has an even number of triple points (Banchoff 1974), and round spheres have none.
#[test]
fn an_eversion_has_an_odd_number_of_quadruple_points() {
    let eversion = "[mesh]\nshape = 'octasphere'\nsubdivisions = 12\n[start]\nhalfway = 2\n[clock]\nboth_ways = true\nframes = 61\n\
                    [bending]\nbending_stiffness = 0.05\n";
    let mut simulation = scene(eversion).simulation().expect("a simulation");
    let mut film = MultiplePoints::new(simulation.mesh());
    for _ in 0..61 {
        film.append(&simulation.next_frame(&mut Unobserved).expect("a frame").positions);
    }
    let sheets = film.frames();
    assert!(
        [sheets[0], sheets[60]].iter().all(|round| *round == Sheets::default()),
        "{:?} {:?}",
        sheets[0],
        sheets[60]
    );
    assert!(sheets.iter().all(|sheets| sheets.triple_points.is_multiple_of(2)), "{sheets:?}");
    assert!(sheets.iter().any(|sheets| sheets.triple_points >= 4));
    let moments = film.quadruple_points();
    assert!(!moments.len().is_multiple_of(2), "{moments:?}");
}
