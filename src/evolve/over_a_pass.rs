//! Films that begin in their middle: a halfway model, and the way down from it on either side.

mod no_pass;

pub use no_pass::NoPass;

use super::error::EvolveError;
use super::pace::{HalfwayModel, OverAPass, Pace};
use super::progress::Observer;
use super::state::State;
use crate::mesh::Mesh;
use crate::mesh::shapes::Halfway;
use crate::metric::Metric;
use crate::polish::{Exchange, Pass, PassError};
use glam::DVec3;
use std::f64::consts::PI;

/// A film over a pass. All its frames belong together; one that is resumed finds them again, to the same bits.
#[derive(Debug)]
pub(super) struct BothWays {
    pass: Pass,
    /// Positions of each frame, |V|, once they are known.
    frames: Vec<Vec<DVec3>>,
}

impl BothWays {
    /// Of a mesh with these positions, |V|, if the film is one.
    pub fn of(pace: Pace, mesh: &Mesh, positions: Option<&[DVec3]>) -> Result<Option<BothWays>, NoPass> {
        let Pace::BothWays(OverAPass { halfway, stiffness }) = pace else { return Ok(None) };
        let is_connected = mesh.components().len() == 1;
        let pass = match halfway {
            HalfwayModel::Sphere { lobes } => {
                if !is_connected || mesh.euler_characteristic() != 2 {
                    return Err(NoPass::NoSphere);
                }
                let sphere = positions.ok_or(NoPass::NoPositions)?;
                let at = |time: f64| Halfway { lobes, time }.of_sphere(sphere);
                let exchange = Exchange::of_sphere(sphere, lobes).map_err(NoPass::AsymmetricSphere)?;
                Pass { halfway: at(0.0), aside: aside(at), exchange: Some(exchange), size: 1.0, stiffness }
            }
            HalfwayModel::Torus(ring) => {
                if !is_connected || mesh.euler_characteristic() != 0 || mesh.vertex_count() != ring.columns * ring.rows
                {
                    return Err(NoPass::NoTorus);
                }
                let at = |time: f64| ring.at(time);
                let exchange = (!ring.slides).then(|| Exchange::of_ring(&ring.embedded())).transpose();
                let exchange = exchange.map_err(NoPass::AsymmetricTorus)?;
                // The area is 4π² times both radii, that of a sphere 4π times the square of its own.
                let size = (ring.tube_radius / (PI * ring.ring_radius)).sqrt();
                Pass { halfway: at(0.0), aside: aside(at), exchange, size, stiffness }
            }
        };
        Ok(Some(BothWays { pass, frames: Vec::new() }))
    }

    /// The frame with this number, from 1, once frames are known.
    pub fn frame(&self, number: usize) -> Option<&[DVec3]> {
        self.frames.get(number.checked_sub(1)?).map(Vec::as_slice)
    }

    /// Gives a state the frames of the surface that has this number.
    pub fn show(&self, number: usize, state: &mut State) {
        self.frame(number).into_iter().for_each(|places| state.set_positions(places));
    }

    /// Finds all frames, if they are not known yet; `time` is that of the one that is to be made.
    pub fn find(
        &mut self,
        mesh: &Mesh,
        metric: &Metric,
        frames: usize,
        time: f64,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        if self.frames.is_empty() {
            let found = self.pass.frames(mesh, metric, frames, &mut |step| observer.after_polish_step(step));
            self.frames = found.map_err(|error| match error {
                PassError::Stopped { steps } => EvolveError::Stopped { steps },
                error => EvolveError::Pass { time, error },
            })?;
        }
        Ok(())
    }
}

/// Which way leads off the halfway model, |V|.
fn aside(at: impl Fn(f64) -> Vec<DVec3>) -> Vec<DVec3> {
    at(BESIDE).iter().zip(at(-BESIDE)).map(|(ahead, behind)| *ahead - behind).collect()
}

/// The time of surfaces beside a halfway model that say which way leads off it.
const BESIDE: f64 = 0.01;
