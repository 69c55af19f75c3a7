//! Steps of a shell that resists all strains alike, ε = (1, 1, 1, 1).
//!
//! Its energy (Eq. 20) is ½ Σ w |λ_j − τ λ_i|², that of the connection Laplacian (Eq. 12): midframes drop out, so the
//! matrix is the same in every step, and complex with one row a face. Factorized once, it makes steps of any length
//! cheap, where conjugate gradients take iterations in proportion to √Δt.

use super::Shell;
use crate::algebra::{CholeskyError, Complex, SparseCholesky, quaternion};
use glam::DQuat;

/// The factorized matrix M + Δt L of a shell.
#[derive(Debug)]
pub struct ConnectionLaplacian {
    dt: f64,
    face_areas: Vec<f64>,
    /// w and τ of the hinges.
    hinges: Vec<(f64, Complex)>,
    factor: SparseCholesky<Complex>,
}

impl ConnectionLaplacian {
    /// Whether the transports of a shell are complex: not where it has target bending angles.
    pub fn suits(shell: &Shell) -> bool {
        shell.hinges().iter().all(|hinge| hinge.transport == hinge.spin.quaternion())
    }

    /// `dt` in units of length squared.
    ///
    /// # Errors
    /// [`CholeskyError`] if the weights are so uneven that the factorization breaks down.
    pub fn new(shell: &Shell, dt: f64) -> Result<ConnectionLaplacian, CholeskyError> {
        let faces = shell.face_areas().iter().enumerate();
        let mut lower: Vec<(usize, usize, Complex)> = faces.map(|(f, area)| (f, f, Complex::from(*area))).collect();
        for hinge in shell.hinges() {
            let (i, j) = (hinge.i.index(), hinge.j.index());
            let w = dt * hinge.weight;
            lower.extend([(i, i, Complex::from(w)), (j, j, Complex::from(w))]);
            // The entry at (j, i) is −w τ, the one at (i, j) its conjugate.
            let tau = if j > i { hinge.spin } else { hinge.spin.conjugate() };
            lower.push((i.max(j), i.min(j), Complex { re: -w * tau.re, im: -w * tau.im }));
        }
        Ok(ConnectionLaplacian {
            dt,
            face_areas: shell.face_areas().to_vec(),
            hinges: shell.hinges().iter().map(|hinge| (hinge.weight, hinge.spin)).collect(),
            factor: SparseCholesky::new(shell.face_count(), &lower)?,
        })
    }

    /// Whether this is the matrix of the shell as it is now, and of that `dt`.
    pub fn is_of(&self, shell: &Shell, dt: f64) -> bool {
        self.dt == dt
            && self.face_areas == shell.face_areas()
            && self.hinges.iter().zip(shell.hinges()).all(|(known, hinge)| *known == (hinge.weight, hinge.spin))
    }

    /// `(M + Δt L)⁻¹ M λ`, made unit in every face.
    pub fn step(&self, frames: &mut [DQuat]) {
        let mut next: Vec<DQuat> = frames.iter().zip(&self.face_areas).map(|(q, area)| *q * *area).collect();
        self.factor.solve(&mut next);
        for (frame, next) in frames.iter_mut().zip(next) {
            *frame = quaternion::normalized(next).unwrap_or(*frame); // constraint projection
        }
    }
}
