//! Over a pass: a halfway model takes on the lengths of a sphere and slides down to it, on either side.
//!
//! A halfway model is taken to itself by a rotation that exchanges the sides of the surface. Its lengths become those that are asked
//! for little by little, within this symmetry (`saddle.rs`). Pushed off to one side it descends as a thin shell would, vertex by
//! vertex, to the round sphere (`descent.rs`). The way to the other side is the same one, turned, with sides exchanged. One half
//! backwards and then the other is an eversion (`way.rs`). No step folds a hinge over or crushes a face (`flow.rs`), so that
//! it is a regular homotopy.

mod descent;
mod flow;
mod saddle;
mod symmetry;
mod way;

use super::descent::{Polish, Watch};
use super::energy::Energy;
use super::newton::NewtonSystem;
use crate::algebra::CholeskyError;
use crate::immersion::enclosed_volume;
use crate::mesh::Mesh;
use crate::metric::{Metric, MetricError};
use crate::tuning::MEMBRANE_HOLD;
use flow::{Flow, Progress};
use glam::DVec3;
pub use symmetry::{NoSymmetry, SideExchange};
use way::Way;

/// What an eversion over a pass is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// The halfway model, |V|.
    pub halfway: Vec<DVec3>,
    /// Which way it is pushed off, |V|: the rotation that exchanges sides takes it to its opposite.
    pub aside: Vec<DVec3>,
    /// What takes the halfway model to itself.
    pub exchange: SideExchange,
    /// Weight of bending; strain of an edge weighs 1.
    pub stiffness: f64,
}

/// Why there is no way over a pass.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PassError {
    /// On the way from the lengths of the halfway model to those that are asked for.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A linear system.
    #[error(transparent)]
    Linear(#[from] CholeskyError),
    /// The shell got stuck before it was the surface that is asked for.
    #[error("the surface got stuck at a length error of {:.2} %", 100.0 * .l2_length_error)]
    Stuck {
        /// L2 length error there.
        l2_length_error: f64,
    },
    /// Whoever watches said so.
    #[error("stopped after {steps} steps")]
    Stopped {
        /// Steps taken.
        steps: usize,
    },
}

impl Pass {
    /// Positions of all frames of the film, each |V|: the middle one is the pass, the first and the last one have the lengths of the
    /// metric, and the last one its front outside. The same bits on any number of threads.
    ///
    /// # Errors
    /// [`PassError`]
    pub fn frames(
        &self,
        mesh: &Mesh,
        metric: &Metric,
        frames: usize,
        watch: &mut Watch,
    ) -> Result<Vec<Vec<DVec3>>, PassError> {
        let unit = metric.edge_lengths().iter().sum::<f64>() / metric.edge_lengths().len() as f64;
        let energy = Energy::new(mesh, metric, None, false, unit).with_uncrushed_faces();
        let system = NewtonSystem::new(&energy, &vec![false; mesh.vertex_count()])?;
        let masses: Vec<f64> = metric.vertex_areas(mesh).iter().map(|area| area / (unit * unit)).collect();
        let mut flow = Flow::new(system, masses, Progress::new(watch));
        let mut way = Way::new(self.saddle(mesh, &energy, &mut flow)?);
        self.descend(&energy, &mut way, &mut flow)?;
        drop(flow);
        let end = self.end(mesh, metric, way.end(), unit, watch);
        way.push(end);
        let is_outward = enclosed_volume(mesh, way.end()).is_some_and(|volume| volume > 0.0);
        let mut film = way.both_ways(&self.exchange, frames, unit);
        if !is_outward {
            film.reverse();
        }
        Ok(film)
    }

    /// The end of the way with the lengths of the metric.
    fn end(&self, mesh: &Mesh, metric: &Metric, from: &[DVec3], unit: f64, watch: &mut Watch) -> Vec<DVec3> {
        let from: Vec<DVec3> = from.iter().map(|p| *p * unit).collect();
        let polish = Polish { stiffness: MEMBRANE_HOLD, is_membrane: true, ..Polish::default() };
        let polished = polish.apply(mesh, metric, &from, None, &[], watch);
        let mut end: Vec<DVec3> = polished.positions.iter().map(|p| *p / unit).collect();
        self.exchange.make_turn_symmetric(&mut end);
        end
    }
}
