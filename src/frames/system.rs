//! The matrix M + Δt L of a semi-implicit step (Alg. 5), in the gauge of the current frames.
//!
//! With x_i = λ_i y_i the difference across a hinge becomes λ_j (y_j − γ y_i), γ = conj(λ_j) τ̃ λ_i, and the
//! basis of Eq. 19 becomes u μ̃ with μ̃ = (1 + γ)/|1 + γ| and u = 1, edge direction, normal, normal × edge in
//! space. The spectrum is that of the paper's matrix; the start y = 1 and the near-kernel, right
//! multiplication of all frames by one quaternion, become constant vectors.

use super::energy::crease_strain;
use super::{Hinge, Shell, Stiffness};
use crate::algebra::{BlockMatrix, BlockPattern, quaternion};
use glam::{DMat4, DQuat, DVec3, DVec4};
use rayon::prelude::*;

/// What one hinge adds: to the matrix at (i, i), (j, j) and (i, j), to the right side at i and j.
struct HingeTerms {
    at_i: DMat4,
    at_j: DMat4,
    across: DMat4,
    pull: [DVec4; 2],
}

/// The linear system of a step: matrix M + Δt L and right side M 1, in the gauge of the frames.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// M + Δt L; its blocks act on (x, y, z, s) of y, as glam stores quaternions.
    pub matrix: BlockMatrix,
    /// M 1, and the pull of sharp creases.
    pub right_side: Vec<DVec4>,
}

/// The sparsity pattern of all systems on a shell.
pub fn pattern(shell: &Shell) -> BlockPattern {
    BlockPattern::new(shell.face_count(), shell.hinges.iter().map(|h| (h.i.index(), h.j.index())))
}

impl System {
    /// Assembles the system; `dt` in units of length squared, `crease` the stiffness of sharp creases.
    pub fn assemble(&mut self, shell: &Shell, stiffness: Stiffness, crease: f64, dt: f64, frames: &[DQuat]) {
        let terms: Vec<HingeTerms> = shell
            .hinges
            .par_iter()
            .map(|hinge| {
                let mut terms = strain_terms(hinge, stiffness, dt, frames);
                add_crease(&mut terms, hinge, crease, dt, frames);
                terms
            })
            .collect();
        let gather = |f: usize, term: fn(&HingeTerms, bool) -> DMat4| -> DMat4 {
            let hinges = shell.face_hinges[f].iter().flatten();
            hinges.map(|&(hinge, is_i)| term(&terms[hinge as usize], is_i)).fold(DMat4::ZERO, |sum, m| sum + m)
        };
        let Self { matrix, right_side } = self;
        matrix.diagonal.resize(shell.face_count(), DMat4::ZERO);
        matrix.diagonal.par_iter_mut().enumerate().for_each(|(f, diagonal)| {
            let mass = DMat4::from_diagonal(DVec4::splat(shell.face_areas[f]));
            *diagonal = mass + gather(f, |term, is_i| if is_i { term.at_i } else { term.at_j });
        });
        matrix.off_diagonal.clear();
        matrix.off_diagonal.extend(terms.iter().map(|t| t.across));
        right_side.clear();
        right_side.extend(shell.face_areas.iter().map(|&area| DVec4::new(0.0, 0.0, 0.0, area)));
        for (hinge, term) in shell.hinges.iter().zip(&terms) {
            right_side[hinge.i.index()] += term.pull[0];
            right_side[hinge.j.index()] += term.pull[1];
        }
    }
}

/// γ and the midframe μ̃ for a transport across a hinge.
fn relative_frame(hinge: &Hinge, transport: DQuat, frames: &[DQuat]) -> (DQuat, DQuat) {
    let gamma = frames[hinge.j.index()].conjugate() * (transport * frames[hinge.i.index()]);
    // Antipodal frames have no midframe (Eq. 18): any will do.
    (gamma, quaternion::normalized(DQuat::IDENTITY + gamma).unwrap_or(DQuat::IDENTITY))
}

/// The direction of the edge in space, as the frame at `j` sees it.
fn edge_direction(hinge: &Hinge, frames: &[DQuat]) -> DVec3 {
    quaternion::rotate(frames[hinge.j.index()], DVec3::new(0.0, hinge.direction.re, hinge.direction.im))
}

/// The block row of D^T W D that belongs to the hinge (App. D), times dt.
fn strain_terms(hinge: &Hinge, stiffness: Stiffness, dt: f64, frames: &[DQuat]) -> HingeTerms {
    let (gamma, midframe) = relative_frame(hinge, hinge.transport, frames);
    let edge = edge_direction(hinge, frames);
    let normal = quaternion::rotate(frames[hinge.j.index()], DVec3::X);
    let axes = [
        midframe,
        quaternion::imaginary(edge) * midframe,
        quaternion::imaginary(normal) * midframe,
        quaternion::imaginary(normal.cross(edge)) * midframe,
    ];
    let back = gamma.conjugate();
    let mut terms = HingeTerms { at_i: DMat4::ZERO, at_j: DMat4::ZERO, across: DMat4::ZERO, pull: [DVec4::ZERO; 2] };
    for (axis, epsilon) in axes.into_iter().zip(stiffness) {
        add_spring(&mut terms, dt * hinge.weight * epsilon, DVec4::from(back * axis), DVec4::from(axis));
    }
    terms
}

/// Adds the quadratic form `scale (⟨at_j, y_j⟩ − ⟨at_i, y_i⟩)²/2`.
#[inline]
fn add_spring(terms: &mut HingeTerms, scale: f64, at_i: DVec4, at_j: DVec4) {
    terms.at_j += outer(at_j * scale, at_j);
    terms.at_i += outer(at_i * scale, at_i);
    terms.across -= outer(at_i * scale, at_j);
}

/// The crease energy as a spring that pulls a crease beyond the limit back to it.
fn add_crease(terms: &mut HingeTerms, hinge: &Hinge, crease: f64, dt: f64, frames: &[DQuat]) {
    let (gamma, midframe) = relative_frame(hinge, hinge.spin.quaternion(), frames);
    let axis = quaternion::imaginary(edge_direction(hinge, frames)) * midframe;
    let bend = axis.dot(DQuat::IDENTITY - gamma);
    let limit = crease_strain();
    if crease > 0.0 && bend.abs() > limit {
        let scale = dt * hinge.weight * crease;
        let (at_i, at_j) = (DVec4::from(gamma.conjugate() * axis), DVec4::from(axis));
        add_spring(terms, scale, at_i, at_j);
        let target = scale * limit.copysign(bend);
        terms.pull = [-target * at_i, target * at_j];
    }
}

/// `a bᵀ`.
#[inline]
fn outer(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}
