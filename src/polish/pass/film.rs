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
        let saddle = self.saddle(mesh, &energy, &mut flow)?;
        let sides: &[f64] = if self.exchange.is_some() { &[1.0] } else { &[1.0, -1.0] };
        let mut ways = Vec::new();
        for side in sides {
            let mut way = Way::new(saddle.clone());
            self.descend(&energy, *side, &mut way, &mut flow)?;
            ways.push(way);
        }
        drop(flow);
        for way in &mut ways {
            let end = self.end(mesh, metric, way.end(), unit, watch);
            way.push(end);
        }
        let frame = |k: usize| {
            let last = frames.saturating_sub(1).max(1) as f64;
            let side = 2.0 * k as f64 / last - 1.0;
            let places = match (&self.exchange, ways.as_slice()) {
                (Some(exchange), [way]) if side < 0.0 => exchange.exchanged(&way.at(-side)),
                (None, [_, way]) if side < 0.0 => way.at(-side),
                (_, [way, ..]) => way.at(side),
                _ => Vec::new(),
            };
            places.into_iter().map(|p| p * unit).collect()
        };
        let mut film: Vec<Vec<DVec3>> = (0..frames).map(frame).collect();
        let volume = film.last().and_then(|end| enclosed_volume(mesh, end));
        if volume.is_some_and(|volume| volume < 0.0) {
            film.reverse();
        }
        Ok(film)
    }

    /// The end of the way with the lengths of the metric.
    fn end(&self, mesh: &Mesh, metric: &Metric, from: &[DVec3], unit: f64, watch: &mut Watch) -> Vec<DVec3> {
        let from: Vec<DVec3> = from.iter().map(|p| *p * unit).collect();
        let polish = match mesh.betti() {
            // Rigid, and smooth without being held.
            0 => Polish { stiffness: MEMBRANE_HOLD, is_membrane: true, ..Polish::default() },
            _ => Polish::default(),
        };
        let polished = polish.apply(mesh, metric, &from, None, &[], watch);
        let mut end: Vec<DVec3> = polished.positions.iter().map(|p| *p / unit).collect();
        self.make_turn_symmetric(&mut end);
        end
    }
}
