//! Steps of the frames: gradient descent (Alg. 5) and quasi-Newton (Alg. 6).

use super::system::{self, State, System};
use super::{ConnectionLaplacian, Shell, Stiffness, gradient};
use crate::algebra::{
    Block, BlockPattern, BlockVector, ConjugateGradient, IncompleteCholesky, SolveReport, quaternion,
};
use crate::tuning::{MAX_SOLVER_ITERATIONS, SINGLE_PRECISION_DT, SINGLE_PRECISION_TOLERANCE};
use glam::{DMat4, DQuat, DVec4, Mat4};
use rayon::prelude::*;

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
    /// Stiffness of creases sharper than [`crate::tuning::CREASE_ANGLE`]; 0 lets them fold over.
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

/// The stepper. Owns the order of elimination, which depends on the connectivity alone, the
/// factorization of isotropic steps, and scratch.
#[derive(Debug)]
pub struct Stepper {
    isotropic: Option<ConnectionLaplacian>,
    pattern: BlockPattern,
    single: Solver<Mat4>,
    double: Solver<DMat4>,
    solution: BlockVector,
}

/// What a solve needs in one precision.
#[derive(Clone, Debug, Default)]
struct Solver<B: Block> {
    system: System<B>,
    factor: IncompleteCholesky<B>,
    iteration: ConjugateGradient<B>,
}

impl Stepper {
    /// For frames on this shell, or another with the same connectivity.
    pub fn new(shell: &Shell) -> Stepper {
        Stepper {
            isotropic: None,
            pattern: system::pattern(shell),
            single: Solver::default(),
            double: Solver::default(),
            solution: BlockVector::default(),
        }
    }

    /// Makes what the first such step would have to make.
    pub fn prepare(&mut self, shell: &Shell, options: &StepOptions) {
        let _ = self.connection_laplacian(shell, options);
    }

    /// One step; `frames` stay unit quaternions.
    pub fn advance(&mut self, shell: &Shell, options: &StepOptions, frames: &mut [DQuat]) -> SolveReport {
        // On a thread of the pool, so that its many short tasks need not be handed over one by one.
        rayon::scope(|_| self.advance_on_pool(shell, options, frames))
    }

    fn advance_on_pool(&mut self, shell: &Shell, options: &StepOptions, frames: &mut [DQuat]) -> SolveReport {
        let dt = options.dt * shell.mean_face_area();
        if let Some(laplacian) = self.connection_laplacian(shell, options) {
            laplacian.step(frames);
            return SolveReport::DIRECT;
        }
        // The gauge needs unit frames; the step from frames of other lengths starts at their lengths instead of 1.
        let mut lengths = None;
        if options.method == Method::Gradient {
            let g = gradient(shell, options.stiffness, frames).curved;
            for ((frame, g), area) in frames.iter_mut().zip(&g).zip(shell.face_areas()) {
                *frame -= *g * (dt / area); // forward Euler for M λ' = −g
            }
            lengths = Some(frames.iter().map(|q| q.length()).collect::<Vec<f64>>());
        }
        normalize(frames);
        let state = State {
            shell,
            stiffness: options.stiffness,
            crease: options.crease,
            dt,
            frames,
            lengths: lengths.as_deref(),
        };
        let Self { pattern, single, double, solution, .. } = self;
        let newton = options.method == Method::Newton;
        let tolerance = options.solver_tolerance;
        let is_single_enough = tolerance >= SINGLE_PRECISION_TOLERANCE && options.dt <= SINGLE_PRECISION_DT;
        let report = is_single_enough
            .then(|| single.solve(pattern, &state, newton, tolerance, solution))
            .filter(|report| report.residual <= tolerance)
            .unwrap_or_else(|| double.solve(pattern, &state, newton, tolerance, solution));
        frames.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, frames)| {
            for (k, frame) in frames.iter_mut().enumerate() {
                let face = chunk * CHUNK + k;
                let start = lengths.as_ref().map_or(1.0, |lengths| lengths[face]);
                let change = DQuat::from_vec4(solution.at(pattern, face) + DVec4::W * start);
                if let Some(next) = quaternion::normalized(*frame * change) {
                    *frame = next; // constraint projection
                }
            }
        });
        report
    }

    /// The factorized matrix of isotropic steps, made where it is not there or another one; `None` where it does not
    /// serve.
    fn connection_laplacian(&mut self, shell: &Shell, options: &StepOptions) -> Option<&ConnectionLaplacian> {
        let dt = options.dt * shell.mean_face_area();
        if !options.is_isotropic() || !ConnectionLaplacian::suits(shell) {
            return None;
        }
        if !self.isotropic.as_ref().is_some_and(|known| known.is_of(shell, dt)) {
            self.isotropic = ConnectionLaplacian::new(shell, dt).ok();
        }
        self.isotropic.as_ref()
    }
}

impl<B: Block> Solver<B> {
    fn solve(
        &mut self,
        pattern: &BlockPattern,
        state: &State,
        newton: bool,
        tolerance: f64,
        solution: &mut BlockVector,
    ) -> SolveReport {
        let Self { system, factor, iteration } = self;
        system.assemble(pattern, state);
        if newton {
            restrict_to_tangents(system, pattern, state);
        }
        factor.factorize(pattern, &system.matrix);
        iteration.solve(pattern, &system.matrix, factor, &system.pull, solution, tolerance, MAX_SOLVER_ITERATIONS)
    }
}

/// Turns the system into that of Alg. 6: unknowns Δλ_i = λ_i δ_i with δ imaginary, which solves the
/// constraint J Δλ = 0, and right side −(Lλ + g).
fn restrict_to_tangents<B: Block>(system: &mut System<B>, pattern: &BlockPattern, state: &State) {
    let force = gradient(state.shell, state.stiffness, state.frames);
    let tangent = B::round(DMat4::from_diagonal(DVec4::new(1.0, 1.0, 1.0, 0.0)));
    let radial = B::round(DMat4::from_diagonal(DVec4::W));
    let restricted = |block| tangent * block * tangent;
    system.matrix.transform(|block| restricted(block) + radial, restricted);
    system.pull.set(pattern, |f| {
        let force = state.frames[f].conjugate() * (force.linear[f] + force.curved[f]);
        DVec4::new(force.x, force.y, force.z, 0.0) * -state.dt
    });
}

fn normalize(frames: &mut [DQuat]) {
    frames.par_chunks_mut(CHUNK).flatten_iter().for_each(|frame| {
        if let Some(unit) = quaternion::normalized(*frame) {
            *frame = unit;
        }
    });
}

/// Faces that one task takes.
const CHUNK: usize = 4096;
