//! The linear system of a semi-implicit step, (M + Δt L) λ' = M λ (Alg. 5), in the gauge of the current frames.
//!
//! With x_i = λ_i y_i the difference across a hinge becomes λ_j (y_j − γ y_i), γ = conj(λ_j) τ̃ λ_i, and the
//! basis of Eq. 19 becomes u μ̃ with μ̃ = (1 + γ)/|1 + γ| and u = 1, edge direction, normal, normal × edge in
//! space. The spectrum is that of the paper's matrix; the start y = 1 and the near-kernel, right
//! multiplication of all frames by one quaternion, become constant vectors. Unknown is y − start, with the pull of
//! the springs on the right: it is small, and single precision is enough for the matrix that it is solved with.

use super::energy::crease_strain;
use super::{Hinge, Shell, Stiffness};
use crate::algebra::{Block, BlockMatrix, BlockPattern, BlockVector, Complex, PairBlocks, quaternion};
use glam::{DMat4, DQuat, DVec4};

/// The matrix M + Δt L and the residual of standing still, in the gauge of the frames.
#[derive(Clone, Debug, Default)]
pub struct System<B: Block> {
    /// M + Δt L; its blocks act on (x, y, z, s) of y, as glam stores quaternions.
    pub matrix: BlockMatrix<B>,
    /// −Δt L y at the start, and the pull of sharp creases.
    pub pull: BlockVector,
}

/// Where a step starts from and what pulls at it.
#[derive(Clone, Copy)]
pub struct State<'a> {
    /// The springs.
    pub shell: &'a Shell,
    /// ε of Eq. 20.
    pub stiffness: Stiffness,
    /// Stiffness of sharp creases.
    pub crease: f64,
    /// Δt in units of length squared.
    pub dt: f64,
    /// Unit quaternions, |F|.
    pub frames: &'a [DQuat],
    /// If y starts at these lengths in place of 1, |F|.
    pub lengths: Option<&'a [f64]>,
}

/// A hinge with what is known of its two faces.
struct Ends {
    hinge: Hinge,
    frames: [DQuat; 2],
    lengths: [f64; 2],
}

/// The sparsity pattern of all systems on a shell.
pub fn pattern(shell: &Shell) -> BlockPattern {
    BlockPattern::new(shell.face_count(), shell.hinges().iter().map(|h| (h.i.index(), h.j.index())))
}

impl<B: Block> System<B> {
    /// Assembles the system.
    pub fn assemble(&mut self, pattern: &BlockPattern, state: &State) {
        let mass =
            |face: usize| (B::round(DMat4::from_diagonal(DVec4::splat(state.shell.face_areas()[face]))), DVec4::ZERO);
        let load = |hinge: usize| {
            let hinge = state.shell.hinges()[hinge];
            let of_faces = |values: &[f64]| [hinge.i, hinge.j].map(|face| values[face.index()]);
            Ends {
                hinge,
                frames: [hinge.i, hinge.j].map(|face| state.frames[face.index()]),
                lengths: state.lengths.map_or([1.0; 2], of_faces),
            }
        };
        self.matrix.assemble(pattern, &mut self.pull, mass, load, |ends| springs(state, ends));
    }
}

/// The block row of D^T W D that belongs to the hinge (App. D), times Δt, and its pull at either end.
fn springs<B: Block>(state: &State, ends: &Ends) -> (PairBlocks<B>, [DVec4; 2]) {
    let Ends { hinge, frames: [_, there], lengths } = ends;
    let (gamma, midframe) = relative_frame(hinge.transport, ends);
    let difference = DVec4::W * lengths[1] - DVec4::from(gamma) * lengths[0];

    // The axes are an orthonormal basis: all directions are as stiff as that of length, but for what some are less.
    let weight = state.dt * hinge.weight;
    let [length, bending, rotation, torsion] = state.stiffness;
    let mut at_j = B::round(DMat4::from_diagonal(DVec4::splat(weight * length)));
    let mut pull = difference * (weight * length);
    let carried = *there * midframe;
    for (axis, epsilon) in [(Axis::Edge, bending), (Axis::Normal, rotation), (Axis::Across, torsion)] {
        if epsilon != length {
            let axis = DVec4::from(there.conjugate() * axis.times(hinge.direction, carried));
            let excess = weight * (epsilon - length);
            at_j += B::outer(B::round_vector(axis * excess), B::round_vector(axis));
            pull += axis * (excess * axis.dot(difference));
        }
    }
    let back = gamma.conjugate();
    let rotation = B::left_multiplication(back);
    let across = rotation * at_j;
    let mut blocks = PairBlocks { first: across * rotation.transposed(), second: at_j, across: B::ZERO - across };
    let mut pulls = [DVec4::from(back * DQuat::from_vec4(pull)), -pull];
    if state.crease > 0.0 {
        add_crease(&mut blocks, &mut pulls, state, ends);
    }
    (blocks, pulls)
}

/// The crease energy as a spring that pulls a crease beyond the limit back to it.
fn add_crease<B: Block>(blocks: &mut PairBlocks<B>, pulls: &mut [DVec4; 2], state: &State, ends: &Ends) {
    let Ends { hinge, frames: [_, there], .. } = ends;
    let (gamma, midframe) = relative_frame(hinge.spin.quaternion(), ends);
    let axis = there.conjugate() * Axis::Edge.times(hinge.direction, *there * midframe);
    let bend = axis.dot(DQuat::IDENTITY - gamma);
    let limit = crease_strain();
    if bend.abs() > limit {
        let scale = state.dt * hinge.weight * state.crease;
        let at = [gamma.conjugate() * axis, axis].map(DVec4::from);
        let [at_i, at_j] = at.map(B::round_vector);
        let [scaled_i, scaled_j] = at.map(|at| B::round_vector(at * scale));
        blocks.first += B::outer(scaled_i, at_i);
        blocks.second += B::outer(scaled_j, at_j);
        blocks.across -= B::outer(scaled_i, at_j);
        let excess = scale * (bend - limit.copysign(bend));
        pulls[0] += at[0] * excess;
        pulls[1] -= at[1] * excess;
    }
}

/// u_1, u_2 and u_3 of App. D: edge direction z j, normal i, and i z j.
enum Axis {
    Edge,
    Normal,
    Across,
}

impl Axis {
    /// `u q`.
    #[inline]
    fn times(&self, z: Complex, q: DQuat) -> DQuat {
        match self {
            Axis::Edge => z * DQuat::from_xyzw(q.z, q.w, -q.x, -q.y),
            Axis::Normal => DQuat::from_xyzw(q.w, -q.z, q.y, -q.x),
            Axis::Across => Axis::Normal.times(z, Axis::Edge.times(z, q)),
        }
    }
}

/// γ and the midframe μ̃ for a transport across a hinge.
#[inline]
fn relative_frame(transport: DQuat, ends: &Ends) -> (DQuat, DQuat) {
    let [from, to] = ends.frames;
    let gamma = to.conjugate() * (transport * from);
    // Antipodal frames have no midframe (Eq. 18): any will do.
    (gamma, quaternion::normalized(DQuat::IDENTITY + gamma).unwrap_or(DQuat::IDENTITY))
}
