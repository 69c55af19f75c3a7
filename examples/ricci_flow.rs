//! Ricci flow without any positions: a dented metric becomes round. `cargo run --release --example ricci_flow`.
#![allow(clippy::print_stdout, reason = "an example talks")]

use immerse::mesh::shapes;
use immerse::metric::{CurvatureTarget, Metric, RicciFlow, lengths_of_positions};
use immerse::{Immersion, Mesh};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sphere = shapes::sphere(1.0, 10)?;
    let bumpy: Vec<_> = sphere.positions.iter().flatten().map(|p| *p * (1.0 + 0.2 * libm::sin(5.0 * p.x))).collect();
    let mesh: &Mesh = &sphere.mesh;
    let lengths = lengths_of_positions(mesh, &bumpy);
    let mut flow = RicciFlow::new(mesh, &lengths, &CurvatureTarget::default())?;
    for time in [0.0, 0.5, 1.0, 2.0, 4.0] {
        let metric = Metric::new(mesh, flow.advance_to(time)?)?;
        let densities = immerse::immersion::gaussian_curvatures(mesh, &metric);
        let (low, high) = densities.iter().fold((f64::MAX, f64::MIN), |(low, high), k| (low.min(*k), high.max(*k)));
        println!("time {time}: curvature {low:.3} to {high:.3}");
    }
    let round = Metric::new(mesh, flow.limit().edge_lengths.clone())?;
    let shape = Immersion::of(mesh, &round).start_at(&bumpy).relax()?;
    println!("round within {:.4} %", 100.0 * shape.report().l2_length_error);
    shape.write_obj("round.obj")?;
    Ok(())
}
