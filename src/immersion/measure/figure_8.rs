//! The class of strips of a realized surface: figure-0 or figure-8.

use crate::mesh::{HalfedgeId, Mesh, VertexId};
use crate::spin::{Class, Homology, Strip};
use glam::{DMat3, DQuat, DVec3};
use rayon::prelude::*;

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

/// The class of a map given by vertex positions: q_f on every generator. Means nothing where it has pinch points.
pub fn class_of_positions(mesh: &Mesh, homology: &Homology, positions: &[DVec3]) -> Class {
    Class::new(homology.generators().iter().map(|g| is_figure_8(mesh, positions, &g.strip)).collect())
}

/// Interior vertices whose star is figure-8 (Sec. 2.2). A map without any is an almost immersion (Def. 2.4).
pub fn pinch_points(mesh: &Mesh, positions: &[DVec3]) -> Vec<VertexId> {
    (0..mesh.vertex_count())
        .into_par_iter()
        .map(VertexId::new)
        .filter(|&v| Strip::around_vertex(mesh, v).is_some_and(|star| is_figure_8(mesh, positions, &star)))
        .collect()
}
