//! Polish from beginning to end: downhill, then patch by patch.

use super::descent::Descent;
use super::energy::Energy;
use super::local_search::Patches;
use super::newton::NewtonSystem;
use super::report::{Ending, PolishReport, mean_bending};
use super::settings::{Polish, Polished, Watch};
use crate::immersion::{RigidMotion, length_error};
use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use crate::tuning::{IDLE_ROUNDS, ROUND_GAIN};
use glam::DVec3;

impl Polish {
    /// Polishes a connected surface. `positions` has its vertices, |V|, without pinch points; `rest` the bending angles at rest
    /// in radians, |E|, without any it is flat at rest. `pinned` vertices stay to the last bit. The result has no unit of its own,
    /// and the same bits on any number of threads and any processor. Where a linear system cannot be solved, it ends with what it
    /// has.
    pub fn apply(
        &self,
        mesh: &Mesh,
        metric: &Metric,
        positions: &[DVec3],
        rest: Option<&[f64]>,
        pinned: &[VertexId],
        watch: &mut Watch,
    ) -> Polished {
        let unit = metric.mean_edge_length();
        let energy = Energy::new(mesh, metric, rest, self.is_membrane, unit);
        let mut is_pinned = vec![false; positions.len()];
        pinned.iter().for_each(|v| is_pinned[v.index()] = true);
        let begin: Vec<DVec3> = positions.iter().map(|p| *p / unit).collect();
        let mut report = PolishReport::unchanged(mesh, metric, positions);
        let Ok(mut system) = NewtonSystem::new(&energy, &is_pinned) else {
            return Polished { positions: positions.to_vec(), report };
        };
        let mut descent = Descent::new(&energy, &mut system, begin, self);
        report.ending = descent.run(watch);
        let patches = (self.rounds > 0).then(|| Patches::new(&energy, &is_pinned));
        let mut idle = 0;
        for round in 0..self.rounds {
            if report.ending != Ending::BestFit || idle == IDLE_ROUNDS {
                break;
            }
            let before = descent.best_strain;
            let next = patches.as_ref().and_then(|all| all.round(&descent.best, round, self.least_barrier));
            if let Some(next) = next {
                report.ending = descent.go_on_from(next, watch);
            }
            idle += usize::from(descent.best_strain > (1.0 - ROUND_GAIN) * before);
        }
        let mut places: Vec<DVec3> = descent.best.iter().map(|p| *p * unit).collect();
        if pinned.is_empty() {
            let motion = RigidMotion::onto(positions, &places, &metric.vertex_areas(mesh));
            places.iter_mut().for_each(|p| *p = motion.point(*p));
        } else {
            pinned.iter().for_each(|v| places[v.index()] = positions[v.index()]);
        }
        report.l2_length_error = length_error(mesh, metric, &places).l2;
        report.mean_bending = mean_bending(mesh, &places).to_degrees();
        report.steps = descent.steps;
        Polished { positions: places, report }
    }
}
