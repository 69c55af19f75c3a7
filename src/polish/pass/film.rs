//! From a halfway model to the film of an eversion.

use super::error::PassError;
use super::flow::{Flow, Progress};
use super::halfway::Pass;
use super::way::Way;
use crate::immersion::enclosed_volume;
use crate::mesh::Mesh;
use crate::metric::Metric;
use crate::polish::energy::Energy;
use crate::polish::newton::NewtonSystem;
use crate::polish::settings::{Polish, Watch};
use crate::tuning::MEMBRANE_HOLD;
use glam::DVec3;

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
        let unit = metric.mean_edge_length();
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
