//! Steps of the frames: gradient descent (Alg. 5) and quasi-Newton (Alg. 6).

use super::system::{self, System};
use super::{ConnectionLaplacian, Shell, Stiffness, gradient};
use crate::algebra::{BlockPattern, ConjugateGradient, SolveReport, quaternion};
use glam::{DMat4, DQuat, DVec4};

/// Which step to take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Alg. 5 with the midframes frozen during the step: the term g of the gradient is left out. It is of second
    /// order in the strains, and its explicit integration is unstable at the time steps that are worth taking.
    Implicit,
    /// Alg. 5 as printed: an explicit step along −g, then an implicit one.
    Gradient,
    /// Alg. 6: quasi-Newton on the constraint |λ_i| = 1, with M/Δt added to L, which is singular for rotations of
    /// the whole surface.
    Newton,
}

/// What a step is taken with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepOptions {
    /// Gradient descent or Newton.
    pub method: Method,
    /// ε of Eq. 20.
    pub stiffness: Stiffness,
    /// Stiffness of creases sharper than [`super::CREASE_ANGLE`]; 0 lets them fold over.
    pub crease: f64,
    /// Δt in units of the mean face area.
    pub dt: f64,
    /// Residual of the linear solve relative to that of standing still.
    pub solver_tolerance: f64,
}

impl StepOptions {
    /// Whether all strains cost the same, so that midframes do not matter and one matrix serves all steps.
    fn is_isotropic(&self) -> bool {
        self.method == Method::Implicit && self.stiffness == [1.0; 4] && self.crease == 0.0
    }
}

/// The stepper. Owns scratch only: pattern, matrix, factorization and solver vectors.
#[derive(Debug)]
pub struct Stepper {
    isotropic: Option<ConnectionLaplacian>,
    pattern: BlockPattern,
    system: System,
    solver: ConjugateGradient,
    solution: Vec<DVec4>,
}

impl Stepper {
    /// For frames on this shell, or another with the same connectivity.
    pub fn new(shell: &Shell) -> Stepper {
        Stepper {
            isotropic: None,
            pattern: system::pattern(shell),
            system: System::default(),
            solver: ConjugateGradient::default(),
            solution: Vec::new(),
        }
    }

    /// One step; `frames` stay unit quaternions.
    pub fn advance(&mut self, shell: &Shell, options: &StepOptions, frames: &mut [DQuat]) -> SolveReport {
        let dt = options.dt * shell.mean_face_area();
        if let Some(laplacian) = self.connection_laplacian(shell, options, dt) {
            laplacian.step(frames);
            return SolveReport::DIRECT;
        }
        if options.method == Method::Gradient {
            let g = gradient(shell, options.stiffness, frames).curved;
            for ((frame, g), area) in frames.iter_mut().zip(&g).zip(&shell.face_areas) {
                *frame -= *g * (dt / area); // forward Euler for M λ' = −g
            }
        }
        // The gauge needs unit frames; the step from frames of other lengths starts at their lengths instead of 1.
        let lengths: Vec<f64> = frames.iter().map(|q| q.length()).collect();
        normalize(frames);
        self.system.assemble(shell, options.stiffness, options.crease, dt, frames);
        self.solution.clear();
        match options.method {
            Method::Implicit => self.solution.resize(frames.len(), DVec4::W),
            Method::Gradient => {
                self.solution.extend(lengths.iter().map(|length| DVec4::W * *length));
                self.system.right_side.iter_mut().zip(&lengths).for_each(|(b, length)| *b *= *length);
            }
            Method::Newton => {
                self.solution.resize(frames.len(), DVec4::ZERO);
                self.tangent_system(shell, options.stiffness, dt, frames);
            }
        }
        let report = self.solver.solve(
            &self.pattern,
            &self.system.matrix,
            &self.system.right_side,
            &mut self.solution,
            options.solver_tolerance,
            MAX_ITERATIONS,
        );
        for (frame, y) in frames.iter_mut().zip(&self.solution) {
            let change = DQuat::from_vec4(*y);
            let factor = if options.method == Method::Newton { DQuat::IDENTITY + change } else { change };
            if let Some(next) = quaternion::normalized(*frame * factor) {
                *frame = next; // constraint projection
            }
        }
        report
    }

    /// The factorized matrix of isotropic steps, made where it is not there or another one; `None` where it does not
    /// serve.
    fn connection_laplacian(&mut self, shell: &Shell, options: &StepOptions, dt: f64) -> Option<&ConnectionLaplacian> {
        if !options.is_isotropic() || !ConnectionLaplacian::suits(shell) {
            return None;
        }
        if !self.isotropic.as_ref().is_some_and(|known| known.is_of(shell, dt)) {
            self.isotropic = ConnectionLaplacian::new(shell, dt).ok();
        }
        self.isotropic.as_ref()
    }

    /// Turns the system into that of Alg. 6: unknowns Δλ_i = λ_i δ_i with δ imaginary, which solves the
    /// constraint J Δλ = 0, and right side −(Lλ + g).
    fn tangent_system(&mut self, shell: &Shell, stiffness: Stiffness, dt: f64, frames: &[DQuat]) {
        let force = gradient(shell, stiffness, frames);
        let tangent = DMat4::from_diagonal(DVec4::new(1.0, 1.0, 1.0, 0.0));
        let radial = DMat4::from_diagonal(DVec4::W);
        let matrix = &mut self.system.matrix;
        matrix.diagonal.iter_mut().for_each(|m| *m = tangent * *m * tangent + radial);
        matrix.off_diagonal.iter_mut().for_each(|m| *m = tangent * *m * tangent);
        for (f, b) in self.system.right_side.iter_mut().enumerate() {
            let force = frames[f].conjugate() * (force.linear[f] + force.curved[f]);
            *b = tangent * DVec4::from(force) * -dt;
        }
    }
}

fn normalize(frames: &mut [DQuat]) {
    for frame in frames {
        if let Some(unit) = quaternion::normalized(*frame) {
            *frame = unit;
        }
    }
}

/// More inner iterations than any step on a mesh of ten million faces took.
const MAX_ITERATIONS: usize = 5000;
