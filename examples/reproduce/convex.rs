//! Convex metrics: each has one convex surface (Alexandrov), so that lengths from random frames have to lead to it.

use super::document::{Line, Section};
use super::ideal::{convexities, distance};
use super::pictures::{ALONE, Style, picture, save};
use super::refinement::of_lengths;
use super::request::{Outcome, Request};
use super::solve::Polish;
use super::table::{ours, percent};
use glam::DVec3;
use immerse::mesh::{Surface, shapes};
use immerse::render::LookName;
use std::collections::HashMap;
use std::fmt::Write;

const RADII: DVec3 = DVec3::new(1.0, 0.7, 0.5);

pub fn section(request: &Request) -> Outcome<Section> {
    let mut body = String::from(
        "The ellipsoid 1 : 0.7 : 0.5, with the vertices of a subdivided icosahedron and the triangulation of their convex hull, all of whose hinges \
        are convex. Only lengths are given. The surface from random frames of seed 0 is compared with the one that is known, after the best rigid motion and, if that is nearer, \
        reflection: distances are shares of the longest diameter. A hinge is convex if it bends as most do; the dent is the largest angle by which one bends the other way.\n\n\
        | faces | polish | distance | largest | L2 length error | max | convex hinges | least convex hinge known | largest dent | rims, pinch points | seconds |\n\
        |--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    let (mut image, mut summary) = (String::new(), Vec::new());
    for frequency in if request.quick { vec![8] } else { vec![16, 24, 48, 70] } {
        let mut errors = Vec::new();
        for polish in Polish::ALL {
            let surface = hull_of_ellipsoid(frequency)?;
            let known = surface.positions.clone().unwrap_or_default();
            let least = convexities(&surface.mesh, &known).into_iter().fold(f64::INFINITY, f64::min);
            let found = of_lengths(surface, false, polish)?;
            let far = distance(&found.mesh, &found.metric, &known, &found.positions);
            let angles = convexities(&found.mesh, &found.positions);
            let convex = angles.iter().filter(|angle| **angle > 0.0).count();
            let dent = angles.iter().copied().fold(0.0, |dent: f64, angle| dent.max(-angle));
            let report = found.report();
            let (faces, edges) = (found.mesh.face_count(), found.mesh.edge_count());
            writeln!(
                body,
                "| {faces} | {} | {} | {} | {} | {} | {convex} of {edges} | {least:.3}° | {dent:.3}° | {}, {} | {:.1} |",
                polish.name(),
                percent(far.mean),
                percent(far.max),
                percent(report.l2_length_error),
                percent(report.max_length_error),
                report.rims,
                report.pinch_points,
                found.seconds
            )?;
            errors.push(percent(found.l2()));
            if Polish::ALL.ends_with(&[polish]) {
                let dents = edges - convex;
                summary.push(Line {
                    what: format!("convex ellipsoid, {} away at most", percent(far.max)),
                    paper: ["–", "–", "–"].map(str::to_owned),
                    ours: ours(faces, &errors),
                    state: format!("{}, {}", report.rims, report.pinch_points),
                    miss: if dents > 0 {
                        format!("{dents} of {edges} hinges are not convex, by {dent:.2}° at most")
                    } else {
                        String::new()
                    },
                });
                let style = Style::from([0.4, -1.0, 0.5], LookName::Studio)?;
                image = save(request, "convex", &picture(&found, &style, ALONE)?, "the ellipsoid from its lengths")?;
            }
        }
    }
    Ok(Section { summary, body: format!("{body}\n{image}") })
}

/// The convex hull of the vertices of a subdivided icosahedron pushed to the ellipsoid: edges of the icosphere are flipped until
/// every hinge is convex. A polyhedron that is convex at every edge is convex.
pub fn hull_of_ellipsoid(frequency: usize) -> Outcome<Surface> {
    let sphere = shapes::sphere(1.0, frequency)?;
    let positions: Vec<DVec3> = sphere.positions.unwrap_or_default().into_iter().map(|p| p * RADII).collect();
    let mut triangles = sphere.mesh.triangles();
    // The triangle on the left of each directed edge.
    let mut left: HashMap<[u32; 2], usize> = HashMap::new();
    for (index, triangle) in triangles.iter().enumerate() {
        left.extend(edges(triangle).map(|edge| (edge, index)));
    }
    let mut waiting: Vec<[u32; 2]> = left.keys().copied().filter(|[a, b]| a < b).collect();
    waiting.sort_unstable();
    let limit = 100 * waiting.len();
    for _ in 0..limit {
        let Some([a, b]) = waiting.pop() else { return Ok(Surface::from_positions(positions, &triangles)?) };
        let (Some(&i), Some(&j)) = (left.get(&[a, b]), left.get(&[b, a])) else { continue };
        let (c, d) = (opposite(&triangles[i], [a, b]), opposite(&triangles[j], [a, b]));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| positions[v as usize]);
        // The fourth corner above the plane of the triangle: the hinge is not convex.
        if (pb - pa).cross(pc - pa).dot(pd - pa) <= 0.0 || left.contains_key(&[c, d]) || left.contains_key(&[d, c]) {
            continue;
        }
        (triangles[i], triangles[j]) = ([c, d, b], [d, c, a]);
        left.remove(&[a, b]);
        left.remove(&[b, a]);
        for index in [i, j] {
            left.extend(edges(&triangles[index]).map(|edge| (edge, index)));
        }
        waiting.extend([[a, c], [c, b], [b, d], [d, a]]);
    }
    Err("the hull was not found by flips".into())
}

fn edges([a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[*a, *b], [*b, *c], [*c, *a]]
}

fn opposite(triangle: &[u32; 3], edge: [u32; 2]) -> u32 {
    triangle.iter().copied().find(|v| !edge.contains(v)).unwrap_or(edge[0])
}
