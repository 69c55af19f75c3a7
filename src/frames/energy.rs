//! The anisotropic Dirichlet energy of frames and its gradient (Eq. 20, 39, App. D).

use super::{Hinge, Shell};
use crate::algebra::quaternion;
use crate::tuning::CREASE_ANGLE;
use glam::DQuat;
use rayon::prelude::*;

/// Weights (ε_0, ε_1, ε_2, ε_3) of length, bending, rotation about the normal, and torsion (Eq. 20).
pub type Stiffness = [f64; 4];

/// The state of one hinge under a transport: difference of frames and midframe (Eq. 18).
struct Strain {
    transport: DQuat,
    difference: DQuat,
    midframe: DQuat,
    /// |τ λ_i + λ_j|, 2 for equal frames and 0 for antipodal ones.
    sum_length: f64,
}

impl Strain {
    fn new(hinge: &Hinge, transport: DQuat, frames: &[DQuat]) -> Strain {
        let carried = transport * frames[hinge.i.index()];
        let there = frames[hinge.j.index()];
        let sum = carried + there;
        // Antipodal frames have no midframe; any choice serves, the energy is dominated by ε_0 there.
        let midframe = quaternion::normalized(sum).unwrap_or(there);
        Strain { transport, difference: there - carried, midframe, sum_length: sum.length() }
    }

    /// ⟨u μ, d⟩, the amount of strain along an axis u.
    fn along(&self, axis: DQuat) -> f64 {
        (axis * self.midframe).dot(self.difference)
    }
}

/// u_k of App. D for the hinge: 1, z_ji j, i, i z_ji j.
fn axes(hinge: &Hinge) -> [DQuat; 4] {
    let z = hinge.direction;
    [
        DQuat::IDENTITY,
        DQuat::from_xyzw(0.0, z.re, z.im, 0.0),
        DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0),
        DQuat::from_xyzw(0.0, -z.im, z.re, 0.0),
    ]
}

/// ℰ_ε(λ) (Eq. 39), every interior edge once. Includes the length term ε_0, which vanishes on unit frames.
pub fn energy(shell: &Shell, stiffness: Stiffness, frames: &[DQuat]) -> f64 {
    hinge_energies(shell, stiffness, frames).iter().sum()
}

/// The terms of [`energy`], in hinge order.
pub fn hinge_energies(shell: &Shell, stiffness: Stiffness, frames: &[DQuat]) -> Vec<f64> {
    let of_hinge = |hinge: &Hinge| {
        let strain = Strain::new(hinge, hinge.transport, frames);
        let terms = axes(hinge).map(|u| strain.along(u).powi(2));
        0.5 * hinge.weight * (0..4).map(|k| stiffness[k] * terms[k]).sum::<f64>()
    };
    shell.hinges().par_iter().with_min_len(256).map(of_hinge).collect()
}

/// How far a crease is beyond [`crate::tuning::CREASE_ANGLE`], as a bending strain with sign; 0 if it is not.
fn overfold(hinge: &Hinge, strain: &Strain) -> f64 {
    let bend = strain.along(axes(hinge)[1]);
    (bend.abs() - crease_strain()).max(0.0).copysign(bend)
}

/// ζ at [`crate::tuning::CREASE_ANGLE`]: ζ = 2 sin(α/4) by Eq. 15.
pub(super) fn crease_strain() -> f64 {
    2.0 * libm::sin(CREASE_ANGLE / 4.0)
}

/// Energy of creases that are about to fold over: `Σ w c (|ζ| − ζ₀)²/2` over those with |ζ| > ζ₀, where ζ is the
/// bending strain of Sec. 5.2.1 with respect to τ, whatever the target bending angle is.
///
/// Without bending stiffness (ε₁ → 0) nothing else keeps a fold from closing beyond 180°, where it turns into a
/// rim with a pinch point at each end.
pub fn crease_energy(shell: &Shell, crease: f64, frames: &[DQuat]) -> f64 {
    let of_hinge = |hinge: &Hinge| {
        0.5 * hinge.weight * crease * overfold(hinge, &Strain::new(hinge, hinge.spin.quaternion(), frames)).powi(2)
    };
    shell.hinges().iter().map(of_hinge).sum()
}

/// Bending ζ, rotation η and torsion σ of every hinge (Sec. 5.2.1), in hinge order.
pub fn strains(shell: &Shell, frames: &[DQuat]) -> Vec<[f64; 3]> {
    let of_hinge = |hinge: &Hinge| {
        let strain = Strain::new(hinge, hinge.transport, frames);
        let [_, bending, rotation, torsion] = axes(hinge).map(|u| strain.along(u));
        [bending, rotation, torsion]
    };
    shell.hinges().par_iter().with_min_len(256).map(of_hinge).collect()
}

/// A gradient in ℝ⁴ per face, in two parts.
#[derive(Clone, Debug)]
pub struct Gradient {
    /// Lλ, from the dependence of strains on the frames.
    pub linear: Vec<DQuat>,
    /// g, from the dependence of the midframes on the frames (App. D).
    pub curved: Vec<DQuat>,
}

impl Gradient {
    fn zero(faces: usize) -> Gradient {
        let zero = vec![DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0); faces];
        Gradient { linear: zero.clone(), curved: zero }
    }

    /// Adds the gradient of a function of ⟨u μ, d⟩ whose derivative is `force`.
    ///
    /// With d = λ_j − τ λ_i the curved part is `g_j = (1 − μμᵀ)/|τλ_i + λ_j| force conj(u) d`, and the same
    /// vector times conj(τ) for g_i.
    fn add(&mut self, hinge: &Hinge, strain: &Strain, axis: DQuat, force: f64) {
        let (i, j) = (hinge.i.index(), hinge.j.index());
        let back = strain.transport.conjugate();
        let push = axis * strain.midframe * force;
        self.linear[j] += push;
        self.linear[i] -= back * push;
        if strain.sum_length > f64::MIN_POSITIVE {
            let turn = axis.conjugate() * strain.difference * force;
            let tangent = (turn - strain.midframe * strain.midframe.dot(turn)) * (1.0 / strain.sum_length);
            self.curved[j] += tangent;
            self.curved[i] += back * tangent;
        }
    }
}

/// Gradient of [`energy`] (App. D).
pub fn gradient(shell: &Shell, stiffness: Stiffness, frames: &[DQuat]) -> Gradient {
    let mut sum = Gradient::zero(frames.len());
    for hinge in shell.hinges() {
        let strain = Strain::new(hinge, hinge.transport, frames);
        for (axis, epsilon) in axes(hinge).into_iter().zip(stiffness) {
            sum.add(hinge, &strain, axis, hinge.weight * epsilon * strain.along(axis));
        }
    }
    sum
}

/// Gradient of [`crease_energy`].
pub fn crease_gradient(shell: &Shell, crease: f64, frames: &[DQuat]) -> Gradient {
    let mut sum = Gradient::zero(frames.len());
    for hinge in shell.hinges() {
        let strain = Strain::new(hinge, hinge.spin.quaternion(), frames);
        sum.add(hinge, &strain, axes(hinge)[1], hinge.weight * crease * overfold(hinge, &strain));
    }
    sum
}
