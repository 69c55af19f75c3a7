//! What a realized surface is worth: length error, rims, pinch points, class.

use crate::algebra::inner_product;
use crate::frames::Shell;
use crate::mesh::{EdgeId, HalfedgeId, Mesh, VertexId};
use crate::metric::Metric;
use crate::spin::Strip;
use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

/// Relative length error over all edges, `|f_e|/ℓ_e − 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthError {
    /// Root of the mean square.
    pub l2: f64,
    /// Largest absolute value.
    pub max: f64,
    /// Median of absolute values.
    pub median: f64,
    /// 95th percentile of absolute values.
    pub p95: f64,
}

/// Relative length errors of all edges, |E|, signed.
pub fn length_errors(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> Vec<f64> {
    (0..mesh.edge_count())
        .into_par_iter()
        .with_min_len(TASK)
        .map(|e| {
            let e = EdgeId::new(e);
            let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
            (b - a).length() / metric.length(e) - 1.0
        })
        .collect()
}

/// Statistics of [`length_errors`].
pub fn length_error(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> LengthError {
    let errors = length_errors(mesh, metric, positions);
    let l2 = root_mean_square(&errors);
    let mut sizes: Vec<f64> = errors.into_iter().map(f64::abs).collect();
    sizes.par_sort_unstable_by(f64::total_cmp);
    let quantile = |q: f64| sizes[((sizes.len() - 1) as f64 * q).round() as usize];
    LengthError { l2, max: quantile(1.0), median: quantile(0.5), p95: quantile(0.95) }
}

/// Root mean square of [`length_errors`], without the sorting that the other statistics take.
pub fn l2_length_error(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> f64 {
    root_mean_square(&length_errors(mesh, metric, positions))
}

fn root_mean_square(values: &[f64]) -> f64 {
    (inner_product(values, values, |a, b| a * b) / values.len() as f64).sqrt()
}

/// Edges with rim bit 1 (Def. 4.1): frames in opposite hemispheres after transport.
pub fn rims(shell: &Shell, frames: &[DQuat]) -> Vec<EdgeId> {
    let hinges = shell.hinges().par_iter().with_min_len(TASK);
    hinges.filter(|hinge| hinge.is_rim(frames)).map(|hinge| hinge.edge).collect()
}

/// q_f of a closed strip under a map given by vertex positions (Def. 2.3): true for figure-8.
///
/// Follows the definition: the product of the rotations q_e that take normal and strip tangent of
/// each face to those of the next, each with positive real part.
pub fn is_figure_8(mesh: &Mesh, positions: &[DVec3], strip: &Strip) -> bool {
    let middle = |h| 0.5 * (positions[mesh.tail(h).index()] + positions[mesh.tip(h).index()]);
    let orientation = |(entry, exit): (HalfedgeId, HalfedgeId)| {
        let [a, b, c] = mesh.corners(exit.face()).map(|v| positions[v.index()]);
        let n = (b - a).cross(c - a).normalize_or(DVec3::X);
        let t = (middle(exit) - middle(entry)).normalize_or(n.any_orthonormal_vector());
        DMat3::from_cols(n, t, n.cross(t))
    };
    let orientations: Vec<DMat3> = strip.passages(mesh).map(orientation).collect();
    let count = orientations.len();
    let product = (0..count).fold(DQuat::IDENTITY, |product, k| {
        // conj(q) n_i q = n_j and so on.
        let step = DQuat::from_mat3(&(orientations[(k + 1) % count] * orientations[k].transpose())).conjugate();
        product * if step.w < 0.0 { -step } else { step }
    });
    product.w > 0.0
}

/// Interior vertices whose star is figure-8 (Sec. 2.2). A map without any is an almost immersion (Def. 2.4).
pub fn pinch_points(mesh: &Mesh, positions: &[DVec3]) -> Vec<VertexId> {
    (0..mesh.vertex_count())
        .into_par_iter()
        .map(VertexId::new)
        .filter(|&v| Strip::around_vertex(mesh, v).is_some_and(|star| is_figure_8(mesh, positions, &star)))
        .collect()
}

/// The volume that a surface encloses, positive where its front is outside; parts that are covered several times count
/// as often. `None` for a surface with boundary.
pub fn enclosed_volume(mesh: &Mesh, positions: &[DVec3]) -> Option<f64> {
    if mesh.edges().any(|e| mesh.is_boundary_edge(e)) {
        return None;
    }
    // From a point near the surface, so that nothing cancels far from the origin.
    let origin = *positions.first()?;
    let corners = |f| mesh.corners(f).map(|v: VertexId| positions[v.index()] - origin);
    Some(mesh.faces().map(corners).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum())
}

/// Bending angles α of a map in radians, |E|, 0 on the boundary: the angle from the normal on the named side
/// of an edge to the one on the other side, with the sign of Eq. 15.
pub fn bending_angles(mesh: &Mesh, positions: &[DVec3]) -> Vec<f64> {
    let normal = |h: HalfedgeId| {
        let [a, b, c] = mesh.corners(h.face()).map(|v| positions[v.index()]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    (0..mesh.edge_count())
        .into_par_iter()
        .with_min_len(TASK)
        .map(|e| {
            let e = EdgeId::new(e);
            let Some([h, twin]) = mesh.edge_sides(e) else { return 0.0 };
            let (ni, nj) = (normal(h), normal(twin));
            let along = (positions[mesh.tip(h).index()] - positions[mesh.tail(h).index()]).normalize_or_zero();
            // n_j is n_i turned by α about v_ij (Eq. 1).
            libm::atan2(ni.cross(nj).dot(along), ni.dot(nj))
        })
        .collect()
}

/// Mean turn between two fields of unit frames in radians, weighted by area.
pub fn mean_turn(shell: &Shell, before: &[DQuat], after: &[DQuat]) -> f64 {
    // |λ' − λ| = 2 sin(α/4), since quaternions turn by half the angle.
    let turn = |(a, b): (&DQuat, &DQuat)| 4.0 * libm::asin((0.5 * (*b - *a).length()).min(1.0));
    let turns: Vec<f64> = before.par_iter().with_min_len(TASK).zip(after).map(turn).collect();
    let total = inner_product(&turns, shell.face_areas(), |turn, area| turn * area);
    total / (shell.mean_face_area() * shell.face_count() as f64)
}

/// Edges or faces that are worth a task of their own.
const TASK: usize = 1024;
