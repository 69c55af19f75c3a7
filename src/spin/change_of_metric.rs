//! Carrying a spin structure and frames from one metric to another (App. B.2), so that the class stays.
//!
//! The basis φ̃ of the new metric is the one with `φ̃ = φ S`, S symmetric and positive: the new triangle laid upon the
//! old one without turning it. In that basis frames stay what they are and τ changes by Eq. 32. The bases that
//! [`Metric`] keeps have their reference edge along 1 in every metric; they are turned against φ̃ by an angle per face,
//! half of which turns the frame, and both τ at its edges with it.

use super::SpinStructure;
use crate::algebra::Complex;
use crate::mesh::{FaceId, HalfedgeId, Mesh};
use crate::metric::Metric;
use glam::{DQuat, DVec2};

/// What becomes of frames and transports when the lengths change.
#[derive(Clone, Debug)]
pub struct ChangeOfMetric {
    /// The spin structure of the new metric, in the class of the old one.
    pub spin: SpinStructure,
    /// Per face, what its frame is to be multiplied with from the left.
    turns: Vec<Complex>,
}

impl ChangeOfMetric {
    /// From one metric to another on the same mesh.
    pub fn new(mesh: &Mesh, spin: &SpinStructure, before: &Metric, after: &Metric) -> ChangeOfMetric {
        let rotations: Vec<f64> = mesh.faces().map(|f| rotation(mesh, f, before, after)).collect();
        let turns: Vec<Complex> = rotations.iter().map(|angle| Complex::from_angle(0.5 * angle)).collect();
        // β of Eq. 30: how far φ̃ of a halfedge is turned against φ, in (−π/2, π/2).
        let beta = |h: HalfedgeId| {
            let turned = after.direction(h) * Complex::from_angle(-rotations[h.face().index()]);
            (turned * before.direction(h).conjugate()).angle()
        };
        let transports = mesh
            .edges()
            .map(|e| match mesh.edge_sides(e) {
                None => Complex::ONE,
                Some([h, twin]) => {
                    let carried = Complex::from_angle(0.5 * (beta(twin) - beta(h))) * spin.across(mesh, h); // Eq. 32
                    turns[twin.face().index()] * carried * turns[h.face().index()].conjugate()
                }
            })
            .collect();
        ChangeOfMetric { spin: SpinStructure::of_known(transports), turns }
    }

    /// Turns frames along: the surface they describe is deformed without being turned, face by face.
    pub fn carry(&self, frames: &mut [DQuat]) {
        for (frame, turn) in frames.iter_mut().zip(&self.turns) {
            *frame = *turn * *frame;
        }
    }
}

/// Angle of the rotation part of the linear map from the old triangle to the new one, both with their reference
/// edge along 1.
fn rotation(mesh: &Mesh, f: FaceId, before: &Metric, after: &Metric) -> f64 {
    let vector = |metric: &Metric, k: usize| {
        let h = f.halfedge(k);
        let z = metric.direction(h);
        metric.length(mesh.edge(h)) * DVec2::new(z.re, z.im)
    };
    let [a, b] = [0, 1].map(|k| vector(before, k));
    let [c, d] = [0, 1].map(|k| vector(after, k));
    // M = [c d] [a b]⁻¹ up to a positive factor; its rotation angle is that of (m₁₁ + m₂₂, m₂₁ − m₁₂).
    let m11 = c.x * b.y - d.x * a.y;
    let m12 = d.x * a.x - c.x * b.x;
    let m21 = c.y * b.y - d.y * a.y;
    let m22 = d.y * a.x - c.y * b.x;
    libm::atan2(m21 - m12, m11 + m22)
}
