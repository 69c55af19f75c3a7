//! Convex metrics come out convex, and the report says how large the largest dent is.

use crate::support::{Random, scene};
use glam::DVec3;
use immerse::evolve::{Frame, Unobserved};
use immerse::immersion::{is_convex, largest_dent};
use immerse::mesh::{Surface, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use std::sync::Arc;

/// A sphere with bumps and pits of so many tenths of the radius.
fn bumpy(subdivisions: usize, count: usize, width: f64, height: f64, seed: u64) -> Surface {
    let mut surface = shapes::sphere(1.0, subdivisions).expect("a sphere");
    let mut random = Random::new(seed);
    let bumps: Vec<(DVec3, f64)> = (0..count)
        .map(|k| (random.vector().normalize(), if k % 4 == 3 { -1.0 } else { 0.5 + 0.5 * random.unit() }))
        .collect();
    surface.positions.iter_mut().flatten().for_each(|p| {
        let bump = |(center, size): &(DVec3, f64)| size * (-(center.angle_between(*p) / width).powi(2)).exp();
        *p *= 1.0 + height * bumps.iter().map(bump).sum::<f64>();
    });
    surface
}

const FLOW: &str = "[start]\nfrom = 'mesh'\n[clock]\nframes = 12\n[[metric.change]]\nkind = 'ricci'\n\
                    amount = { times = [0, 1], values = [0, 1] }\n";

fn film(surface: &Surface, text: &str) -> Vec<Arc<Frame>> {
    let scene = scene(text);
    let mut simulation = scene.simulation_of(surface.clone()).expect("a simulation");
    (0..scene.clock.frames).map(|_| simulation.next_frame(&mut Unobserved).expect("a frame")).collect()
}

/// Least and largest distance from the middle.
fn radii(positions: &[DVec3]) -> (f64, f64) {
    let middle = positions.iter().sum::<DVec3>() / positions.len() as f64;
    let distances = positions.iter().map(|p| p.distance(middle));
    distances.fold((f64::MAX, 0.0), |(least, most): (f64, f64), d| (least.min(d), most.max(d)))
}

#[test]
fn ricci_flow_of_bumpy_spheres_ends_at_round_ones() {
    for (count, width, height, seed) in [(24, 0.3, 0.12, 1), (12, 0.5, 0.2, 2), (40, 0.2, 0.1, 3)] {
        let surface = bumpy(12, count, width, height, seed);
        let frames = film(&surface, FLOW);
        let last = &frames[11];
        let (least, most) = radii(&last.positions);
        assert!(most / least < 1.02, "seed {seed}: {least} to {most}");
        assert!(last.report.l2_length_error < 1e-3 && last.report.rims == 0, "{}", last.report.l2_length_error);
        let dent = last.report.largest_dent.expect("a convex metric");
        assert!(dent < 0.005 * most, "seed {seed}: {dent}");
        assert_eq!(frames[0].report.largest_dent, None, "bumps are not convex");
    }
}

/// With the phases of films before, the same surface keeps its pits as dents; so the test above can fail.
#[test]
fn phases_of_ones_own_leave_dents() {
    let frames = film(&bumpy(12, 12, 0.5, 0.2, 2), &format!("{FLOW}[[phase]]\n"));
    let report = &frames[11].report;
    let dent = report.largest_dent.expect("a convex metric");
    let (least, most) = radii(&frames[11].positions);
    assert!(dent > 0.03 * most && most - least > 0.03 * most, "{dent} {least} {most}");
}

/// In one step, from a mesh with pits to the round metric.
#[test]
fn a_single_frame_of_a_convex_metric_is_ironed() {
    let text = "[start]\nfrom = 'mesh'\n[[metric.change]]\nkind = 'ricci'\namount = 1\n";
    let frames = film(&bumpy(10, 12, 0.5, 0.2, 2), text);
    let (least, most) = radii(&frames[0].positions);
    assert!(most / least < 1.02, "{least} to {most}");
}

#[test]
fn convex_metrics_are_told_from_others() {
    let check = |surface: &Surface, convex: bool| {
        let lengths = lengths_of_positions(&surface.mesh, surface.positions.as_deref().expect("positions"));
        let metric = Metric::new(&surface.mesh, lengths).expect("a metric");
        assert_eq!(is_convex(&surface.mesh, &metric), convex);
    };
    check(&shapes::sphere(3.0, 5).expect("a sphere"), true);
    check(&bumpy(12, 12, 0.5, 0.2, 2), false);
    check(&shapes::torus(1.0, 0.4, 20, 12).expect("a torus"), false);
    check(&shapes::disk(1.0, 4).expect("a disk"), false);
}

/// A cap that is mirrored inward lies as deep as it was high twice.
#[test]
fn the_depth_of_a_dent_is_measured() {
    let mut ball = shapes::sphere(1.0, 24).expect("a sphere").positions.expect("positions");
    assert!(largest_dent(&ball) < 1e-3);
    let height = 0.8;
    ball.iter_mut().filter(|p| p.z > height).for_each(|p| p.z = 2.0 * height - p.z);
    let depth = largest_dent(&ball);
    assert!((depth - (1.0 - height)).abs() < 0.02, "{depth}");
    let far: Vec<DVec3> = ball.iter().map(|p| 7.0 * *p + DVec3::splat(1e4)).collect();
    assert!((largest_dent(&far) / 7.0 - depth).abs() < 1e-6);
}
