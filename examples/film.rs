//! A film with an observer: a torus breathes. `cargo run --release --example film`.
#![allow(clippy::print_stdout, reason = "an example talks")]

use std::ops::ControlFlow;

use immerse::evolve::{Program, Progress, Start};
use immerse::mesh::shapes;
use immerse::metric::{Change, Lengths, MetricProgram};
use immerse::timeline::{Clock, Formula, Number};
use immerse::{Simulation, evolve::Schedule, mesh::write_obj};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let torus = shapes::torus(1.0, 0.4, 48, 20)?;
    let positions = torus.positions.clone().unwrap_or_default();
    // Lengths are multiplied by the mean exp(u) of their ends, so that one side grows and the other one shrinks.
    let u = Formula::parse("0.3 * x * sin(2 * PI * t)", &["x", "y", "z"], &Default::default())?;
    let breath = Change::conformal(&torus, u, Number::Constant(1.0))?;
    let program = Program {
        start: Start::at(positions),
        schedule: Schedule::of_last_phase(),
        clock: Clock::new(24, [0.0, 1.0], true)?,
        ..Program::of(MetricProgram::of(Lengths::of_surface(&torus)?).changed_by(breath))
    };
    let mut simulation = Simulation::new(torus, program)?;
    let mut steps = 0;
    let mut observer = |progress: &Progress| {
        steps += 1;
        // Whoever has seen enough breaks off.
        if progress.l2_length_error.is_nan() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    std::fs::create_dir_all("film")?;
    for k in 1..=simulation.clock().frames() {
        let frame = simulation.next_frame(&mut observer)?;
        println!("frame {k}: length error {:.3} %", 100.0 * frame.report.l2_length_error);
        write_obj(format!("film/{k:06}.obj").as_ref(), simulation.mesh(), &frame.positions)?;
    }
    println!("{steps} steps");
    Ok(())
}
