//! Fig. 6 and Thm. 4.2: a vertex is pinched exactly if an odd number of rims ends there, and a rim makes of it a vertex that is immersed.

use super::document::{Line, Section};
use super::measure::rims_of;
use super::peers::torus;
use super::request::{Outcome, Request};
use super::table::percent;
use immerse::immersion::pinch_points;

pub fn figure_6(request: &Request) -> Outcome<Section> {
    let given = torus(request)?;
    let pinched = given.rotations(0)?;
    let (mesh, metric) = (&given.mesh, &given.metric);
    let rims = rims_of(mesh, metric, &given.spin, &pinched.positions);
    let mut ends = vec![0; mesh.vertex_count()];
    rims.iter().flat_map(|e| mesh.edge_vertices(*e)).for_each(|v| ends[v.index()] += 1);
    let mut is_pinched = vec![false; mesh.vertex_count()];
    pinch_points(mesh, &pinched.positions).iter().for_each(|v| is_pinched[v.index()] = true);
    let pinches = is_pinched.iter().filter(|pinched| **pinched).count();
    let exceptions = ends.iter().zip(&is_pinched).filter(|(ends, pinched)| (*ends % 2 == 1) != **pinched).count();
    let eights = given.spin.figure_8_vertices(mesh, metric).len();
    let body = format!(
        "On the pinched flat torus of Fig. 10 (rotations, seed 0, error {}), seen as a rimmed immersion of class 00: it has {pinches} pinch points and {} rims. \
        An odd number of rims ends at each pinch point and an even number at each of the other {} vertices, with {exceptions} exceptions. With the rims added, {eights} \
        of all vertices are figure eights.",
        percent(pinched.l2()),
        rims.len(),
        mesh.vertex_count() - pinches,
    );
    let summary = Line {
        what: "Fig. 6, rims end at pinch points".into(),
        paper: ["–".into(), "–".into(), "theorem".into()],
        ours: [mesh.face_count().to_string(), percent(pinched.l2()), "–".into()],
        state: format!("{} rims, {pinches} pinch points, {exceptions} exceptions", rims.len()),
        miss: if exceptions + eights > 0 {
            format!("{exceptions} exceptions, {eights} figure eights")
        } else {
            String::new()
        },
    };
    Ok(Section { summary: vec![summary], body })
}
