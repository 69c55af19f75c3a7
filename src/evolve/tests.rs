//! Going back to where a component was before a step that failed.

use super::course::Course;
use super::pace::Settling;
use super::program::{Program, Start};
use super::progress::Unobserved;
use super::simulation::Simulation;
use crate::immersion::Pins;
use crate::mesh::shapes;
use crate::metric::{Lengths, MetricProgram};
use crate::timeline::{Clock, Formula};
use std::sync::Arc;

#[test]
fn a_way_that_is_taken_again_leads_to_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let surface = shapes::torus(1.0, 0.4, 12, 6)?;
    let formula = Formula::parse("length * (1 + 0.2 * t * z)", &Lengths::VARIABLES, &Arc::default())?;
    let metric = MetricProgram::of(Lengths::by_formula(&surface, formula)?);
    let mesh = Arc::new(surface.mesh.clone());
    let mut course = Course::new(mesh, metric.clone(), None, Pins::default(), 0.0)?;
    let positions = surface.positions.clone().unwrap_or_default();
    let program =
        Program { start: Start::at(positions), clock: Clock::new(3, [0.0, 1.0], false)?, ..Program::of(metric) };
    let mut simulation = Simulation::new(surface, program)?;
    simulation.next_frame(&mut Unobserved)?;
    let settling = Settling::default();
    let relaxation = &mut simulation.components[0];
    let (before, frames) = (relaxation.mark(), relaxation.state().face_frames().to_vec());
    relaxation.follow(&mut course, 0.5, &settling, 0, &mut Unobserved)?;
    let (there, spin) = (relaxation.state().face_frames().to_vec(), relaxation.state().spin().clone());
    assert_ne!(there, frames);
    relaxation.go_back(&course, &before)?;
    assert_eq!((relaxation.state().face_frames(), relaxation.state().time()), (&frames[..], 0.0));
    relaxation.follow(&mut course, 0.5, &settling, 0, &mut Unobserved)?;
    assert_eq!((relaxation.state().face_frames(), relaxation.state().spin()), (&there[..], &spin));
    Ok(())
}
