//! The Platonic solids, with corners at distance 1 from the origin, and two polyhedra of genus 2.

use glam::{DMat3, DVec3};

type Polyhedron = (Vec<DVec3>, Vec<Vec<usize>>);

/// A name, and how what has it is made.
type Named = (&'static str, fn() -> Polyhedron);

/// All built-in polyhedra.
const ALL: [Named; 7] = [
    ("tetrahedron", tetrahedron),
    ("cube", cube),
    ("octahedron", octahedron),
    ("dodecahedron", dodecahedron),
    ("icosahedron", || {
        let (corners, triangles) = icosahedron();
        (corners, triangles.iter().map(|t| t.map(|v| v as usize).to_vec()).collect())
    }),
    ("genus_two", genus_two),
    ("genus_two_saddle", genus_two_saddle),
];

/// The names of all built-in polyhedra.
pub fn names() -> impl Iterator<Item = &'static str> {
    ALL.into_iter().map(|(name, _)| name)
}

pub(super) fn named(name: &str) -> Option<Polyhedron> {
    ALL.into_iter().find(|(known, _)| *known == name).map(|(_, polyhedron)| polyhedron())
}

fn tetrahedron() -> Polyhedron {
    on_unit_sphere(
        &[[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]],
        &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 1], &[1, 3, 2]],
    )
}

fn cube() -> Polyhedron {
    let corners: Vec<[f64; 3]> =
        (0..8).map(|v| [v & 1, v >> 1 & 1, v >> 2].map(|bit| if bit == 1 { 1.0 } else { -1.0 })).collect();
    on_unit_sphere(
        &corners,
        &[&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5]],
    )
}

fn octahedron() -> Polyhedron {
    on_unit_sphere(
        &[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
        &[&[0, 2, 4], &[2, 1, 4], &[1, 3, 4], &[3, 0, 4], &[2, 0, 5], &[1, 2, 5], &[3, 1, 5], &[0, 3, 5]],
    )
}

fn on_unit_sphere(corners: &[[f64; 3]], polygons: &[&[usize]]) -> Polyhedron {
    (corners.iter().map(|&v| DVec3::from(v).normalize()).collect(), polygons.iter().map(|p| p.to_vec()).collect())
}

pub(in crate::mesh::shapes) fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut corners = Vec::with_capacity(12);
    for (long, short) in [(golden, 1.0), (golden, -1.0), (-golden, 1.0), (-golden, -1.0)] {
        corners.extend([[0.0, short, long], [short, long, 0.0], [long, 0.0, short]]);
    }
    let corners: Vec<DVec3> = corners.into_iter().map(|v| DVec3::from(v).normalize()).collect();
    // The faces are the triples of corners at edge distance.
    let near = |a: usize, b: usize| corners[a].distance_squared(corners[b]) < 1.2;
    let mut triangles = Vec::with_capacity(20);
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = corners[a].dot(corners[b].cross(corners[c])) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    triangles.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    (corners, triangles)
}

/// Dual to the icosahedron: a corner per face, a pentagon per corner.
fn dodecahedron() -> Polyhedron {
    let (corners, triangles) = icosahedron();
    let centers = triangles.iter().map(|t| t.map(|v| corners[v as usize]).iter().sum::<DVec3>().normalize()).collect();
    let pentagon = |v: u32| {
        let from = |k: usize, t: &[u32; 3]| [t[k % 3], t[(k + 1) % 3]];
        // The next triangle counterclockwise begins with the side that this one ends with.
        let next = |&f: &usize| {
            let end = (0..3).map(|k| from(k, &triangles[f])).find(|side| side[1] == v)?;
            triangles.iter().position(|t| (0..3).any(|k| from(k, t) == [end[1], end[0]]))
        };
        std::iter::successors(triangles.iter().position(|t| t.contains(&v)), next).take(5).collect()
    };
    (centers, (0..12).map(pentagon).collect())
}

/// A block of 5 × 3 × 1 unit cubes without the second and the fourth of the middle row.
fn genus_two() -> Polyhedron {
    let solid = |i: i32, j: i32| (0..5).contains(&i) && (0..3).contains(&j) && !(j == 1 && i % 2 == 1);
    let corner = |i: i32, j: i32, k: i32| (k * 24 + j * 6 + i) as usize;
    let mut corners = Vec::with_capacity(48);
    for (k, j, i) in (0..2).flat_map(|k| (0..4).flat_map(move |j| (0..6).map(move |i| (k, j, i)))) {
        corners.push(DVec3::new(i as f64 - 2.5, j as f64 - 1.5, k as f64 - 0.5));
    }
    let mut polygons = Vec::with_capacity(50);
    for (i, j) in (0..5).flat_map(|i| (0..3).map(move |j| (i, j))).filter(|&(i, j)| solid(i, j)) {
        let around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        polygons.push(around.iter().map(|&(i, j)| corner(i, j, 1)).collect());
        polygons.push(around.iter().rev().map(|&(i, j)| corner(i, j, 0)).collect());
        for (side, (di, dj)) in [(0, -1), (1, 0), (0, 1), (-1, 0)].into_iter().enumerate() {
            if !solid(i + di, j + dj) {
                let ((a, b), (c, d)) = (around[side], around[(side + 1) % 4]);
                polygons.push(vec![corner(a, b, 0), corner(c, d, 0), corner(c, d, 1), corner(a, b, 1)]);
            }
        }
    }
    (corners, polygons)
}

/// Genus 2 without self-intersections and with negative curvature at every corner: the angles add up to more than a
/// full turn also at those that stick out, whose stars are pleated. It has the rotations of a triangular prism, which
/// make 12 corners of two and 28 triangles of six; seven triangles meet at each corner. Barros et al. describe such
/// a polyhedron (2011, in Fig. 17 of the paper); this one has been found by a search.
fn genus_two_saddle() -> Polyhedron {
    let third =
        DMat3::from_cols(DVec3::new(-0.5, 0.75f64.sqrt(), 0.0), DVec3::new(-0.75f64.sqrt(), -0.5, 0.0), DVec3::Z);
    let mut corners = Vec::with_capacity(12);
    for corner in [DVec3::new(-0.4, 1.2, -1.0), DVec3::new(1.05, 1.1, 0.1)] {
        for start in [corner, DVec3::new(corner.x, -corner.y, -corner.z)] {
            corners.extend([start, third * start, third * third * start]);
        }
    }
    // Corner `6 orbit + 3 half + turns` comes from the first of its orbit by half a turn about x, if any, and then
    // thirds of a turn about z. These are its images.
    let image = |v: usize, half: usize, turns: usize| {
        let (orbit, flipped, turned) = (v / 6, v / 3 % 2, v % 3);
        let turned = if half == 1 { 3 - turned } else { turned };
        6 * orbit + 3 * (flipped ^ half) + (turned + turns) % 3
    };
    let mut polygons = Vec::with_capacity(28);
    // The first two are mapped to themselves by thirds of a turn.
    for (corner, turns) in
        [([0, 2, 1], 1), ([6, 8, 7], 1), ([0, 1, 7], 3), ([0, 5, 10], 3), ([0, 9, 6], 3), ([0, 10, 9], 3)]
    {
        for (half, turn) in (0..2).flat_map(|half| (0..turns).map(move |turn| (half, turn))) {
            polygons.push(corner.iter().map(|&v| image(v, half, turn)).collect());
        }
    }
    (corners, polygons)
}
