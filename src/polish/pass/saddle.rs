//! A halfway model takes on lengths, as slowly as it takes.

use super::error::PassError;
use super::flow::{Flow, Shape};
use super::halfway::Pass;
use crate::mesh::Mesh;
use crate::metric::{Metric, lengths_of_positions};
use crate::polish::energy::{Energy, Stiffness};
use crate::tuning::{PARTS_TO_A_PASS, SOFT_ON_A_PASS, STEPS_ON_A_PASS, STEPS_TO_A_PASS};
use glam::DVec3;

impl Pass {
    /// The halfway model with the lengths of the energy, in mean edge lengths: at rest within its symmetry, or nearly so.
    pub(super) fn saddle(&self, mesh: &Mesh, energy: &Energy, flow: &mut Flow) -> Result<Vec<DVec3>, PassError> {
        let symmetric = |vectors: &mut [DVec3]| self.make_symmetric(vectors);
        let begin = self.of_area(mesh, energy);
        let own = lengths_of_positions(mesh, &begin);
        let mut shape = Shape::new(energy, begin);
        let [soft, ..] = SOFT_ON_A_PASS.map(|share| Stiffness::of(share * self.stiffness));
        flow.announce(PARTS_TO_A_PASS * STEPS_TO_A_PASS + SOFT_ON_A_PASS.len() * STEPS_ON_A_PASS);
        for part in 1..=PARTS_TO_A_PASS {
            let share = part as f64 / PARTS_TO_A_PASS as f64;
            let between = |(own, asked): (&f64, &f64)| own * libm::pow(asked / own, share);
            let lengths = own.iter().zip(&energy.lengths).map(between).collect();
            let metric = Metric::new(mesh, lengths)?;
            let there = Energy::new(mesh, &metric, None, false, 1.0).with_uncrushed_faces();
            for _ in 0..STEPS_TO_A_PASS {
                flow.step(&there, &mut shape, soft, f64::INFINITY, None, &symmetric)?;
            }
        }
        for share in SOFT_ON_A_PASS {
            for _ in 0..STEPS_ON_A_PASS {
                let stiffness = Stiffness::of(share * self.stiffness);
                if flow.step(energy, &mut shape, stiffness, f64::INFINITY, None, &symmetric)?.is_none() {
                    break;
                }
            }
        }
        Ok(shape.positions)
    }

    /// The halfway model as large as the surface that is asked for, and symmetric to rounding.
    fn of_area(&self, mesh: &Mesh, energy: &Energy) -> Vec<DVec3> {
        let area: f64 = mesh
            .triangles()
            .iter()
            .map(|face| {
                let [a, b, c] = face.map(|v| self.halfway[v as usize]);
                0.5 * (b - a).cross(c - a).length()
            })
            .sum();
        let scale = (energy.area() / area).sqrt();
        let mut places: Vec<DVec3> = self.halfway.iter().map(|p| *p * scale).collect();
        self.make_symmetric(&mut places);
        places
    }
}
