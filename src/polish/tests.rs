//! Derivatives against finite differences.

use super::barrier::barrier;
use super::energy::{Energy, Stiffness};
use super::hinge::hinges;
use super::newton::NewtonSystem;
use crate::mesh::{Surface, shapes};
use crate::metric::{Metric, lengths_of_positions};
use glam::DVec3;

/// A torus that is no solution of its metric.
fn bent_torus() -> Result<(Surface, Metric, Vec<DVec3>), Box<dyn std::error::Error>> {
    let surface = shapes::torus(1.0, 0.4, 9, 6)?;
    let positions = surface.positions.clone().unwrap_or_default();
    let metric = Metric::new(&surface.mesh, lengths_of_positions(&surface.mesh, &positions))?;
    let bent = positions.iter().map(|p| *p + 0.05 * DVec3::new(p.y * p.z, p.x * p.x, p.y - p.z)).collect();
    Ok((surface, metric, bent))
}

#[test]
fn the_gradient_of_a_bending_angle() -> Result<(), Box<dyn std::error::Error>> {
    let (surface, metric, positions) = bent_torus()?;
    let way = DVec3::new(0.3, -0.5, 0.7) * 1e-6;
    for hinge in hinges(&surface.mesh, &metric) {
        let bend = hinge.bend(&positions);
        assert_eq!(bend.angle.to_bits(), hinge.angle(&positions).to_bits());
        for (v, gradient) in hinge.corners.into_iter().zip(bend.gradient) {
            let at = |sign: f64| {
                let mut moved = positions.clone();
                moved[v] += sign * way;
                hinge.angle(&moved)
            };
            let difference = (at(1.0) - at(-1.0)) / 2.0;
            assert!((difference - gradient.dot(way)).abs() < 1e-14, "{hinge:?}: {difference}");
        }
    }
    Ok(())
}

#[test]
fn the_angle_is_that_of_the_measure() -> Result<(), Box<dyn std::error::Error>> {
    let (surface, metric, positions) = bent_torus()?;
    let measured = crate::immersion::bending_angles(&surface.mesh, &positions);
    for hinge in hinges(&surface.mesh, &metric) {
        assert!((hinge.angle(&positions) - measured[hinge.edge]).abs() < 1e-12);
    }
    Ok(())
}

#[test]
fn the_derivatives_of_the_barrier() {
    for degrees in [-179.0_f64, -160.0, 141.0, 150.0, 175.0] {
        let (angle, step) = (degrees.to_radians(), 1e-5);
        let [before, after] = [angle - step, angle + step].map(barrier);
        let scale = barrier(angle).second;
        assert!(((after.value - before.value) / (2.0 * step) - barrier(angle).first).abs() < 1e-5 * scale, "{degrees}");
        assert!(
            ((after.first - before.first) / (2.0 * step) - barrier(angle).second).abs() < 1e-3 * scale,
            "{degrees}"
        );
    }
    assert_eq!(barrier(2.0).value, 0.0);
}

/// A step falls as fast at its beginning as it says.
#[test]
fn the_slope_of_a_step() -> Result<(), Box<dyn std::error::Error>> {
    let (surface, metric, positions) = bent_torus()?;
    let energy = Energy::new(&surface.mesh, &metric, None, false, 1.0);
    let mut system = NewtonSystem::new(&energy, &vec![false; positions.len()])?;
    let stiffness = Stiffness { bending: 0.1, barrier: 0.2 };
    let direction = system.direction(&energy, &positions, stiffness, None)?;
    let at = |share: f64| {
        let moved: Vec<DVec3> = positions.iter().zip(&direction.moves).map(|(p, x)| *p + *x * share).collect();
        energy.value(&moved, &energy.angles(&moved), stiffness)
    };
    let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
    assert!((slope + direction.slope).abs() < 1e-6 * direction.slope, "{slope} {}", direction.slope);
    assert!(direction.slope > 0.0);
    Ok(())
}
