//! Loops along rims of a flat grid: where they touch it, where they end, and which side is their front.

use super::{AROUND, Loops};
use crate::mesh::{EdgeId, Mesh};
use glam::DVec3;
use std::collections::BTreeSet;

/// Five by five vertices in the plane, fronts up.
fn grid() -> (Mesh, Vec<DVec3>) {
    let cells = (0..4_u32).flat_map(|i| (0..4).map(move |j| 5 * i + j));
    let faces: Vec<[u32; 3]> = cells.flat_map(|v| [[v, v + 5, v + 6], [v, v + 6, v + 1]]).collect();
    let mesh = Mesh::from_faces(25, &faces).unwrap_or_else(|error| panic!("{error}"));
    let places = (0..25).map(|v| DVec3::new(f64::from(v / 5), f64::from(v % 5), 0.0)).collect();
    (mesh, places)
}

/// Edges between vertices that follow each other.
fn path(mesh: &Mesh, vertices: &[u32]) -> Vec<EdgeId> {
    let edge = |ends: &[u32]| {
        let ends = BTreeSet::from([ends[0], ends[1]]);
        mesh.edges().find(|e| mesh.edge_vertices(*e).map(|v| v.0).into_iter().collect::<BTreeSet<_>>() == ends)
    };
    vertices.windows(2).filter_map(edge).collect()
}

#[test]
fn a_loop_touches_the_surface_along_its_rim_and_closes_at_its_ends() {
    let (mesh, places) = grid();
    let rims = path(&mesh, &[7, 12, 17]);
    let loops = Loops::along(&mesh, &rims, 0.25, |vertices| if vertices.len() == 3 { 1.0 } else { 0.0 });
    let points = loops.places(&mesh, &places);
    let sections: Vec<&[DVec3]> = points.chunks(AROUND).collect();
    for section in &sections {
        assert!(section[0].z.abs() < 1e-12 && (section[0].y - 2.0).abs() < 1e-12, "{:?}", section[0]);
    }
    let height = |section: &[DVec3]| section.iter().map(|p| p.z).fold(0.0, f64::max);
    let last = sections.len() - 1;
    assert!([0, last].iter().all(|k| height(sections[*k]) < 1e-12), "closed at both ends");
    assert!((height(sections[last / 2]) - 0.5).abs() < 1e-12, "a circle of that radius in between");
    let all: Vec<DVec3> = places.iter().copied().chain(points.iter().copied()).collect();
    let triangles = loops.triangles(25);
    assert_eq!(triangles.len(), loops.faces().len());
    // Where it leaves the surface its front is that of the surface, and at the top it is below.
    for triangle in &triangles {
        let [a, b, c] = triangle.map(|v| all[v as usize]);
        let (normal, middle) = ((b - a).cross(c - a), (a + b + c) / 3.0);
        if normal.length() > 1e-3 && middle.z < 0.02 {
            assert!(normal.z > 0.0, "{normal}");
        }
        if middle.z > 0.48 {
            assert!(normal.z < 0.0);
        }
    }
    // Every side belongs to at most one triangle on each side.
    let sides = triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)]);
    assert_eq!(sides.collect::<BTreeSet<_>>().len(), 3 * triangles.len());
}

/// A rim around a vertex has no end; three rims that meet stay open there.
#[test]
fn rims_that_close_or_meet_stay_open() {
    let (mesh, places) = grid();
    let around = path(&mesh, &[6, 7, 8, 13, 18, 17, 16, 11, 6]);
    let star = path(&mesh, &[7, 12, 17]).into_iter().chain(path(&mesh, &[12, 11])).collect::<Vec<_>>();
    for (rims, count, closed) in [(around, 1, 0), (star, 3, 3)] {
        let loops = Loops::along(&mesh, &rims, 0.1, |_| 1.0);
        assert_eq!(loops.strands.len(), count);
        let points = loops.places(&mesh, &places);
        let is_point = |section: &&[DVec3]| section.iter().all(|p| p.distance(section[0]) < 1e-12);
        assert_eq!(points.chunks(AROUND).filter(is_point).count(), closed);
    }
}
