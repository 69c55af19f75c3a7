//! Frames from edge vectors: the rotation part of the linear map of every face (Eq. 11).

use crate::algebra::quaternion;
use crate::mesh::{FaceId, Mesh};
use crate::metric::Metric;
use glam::{DQuat, DVec3};
use rayon::prelude::*;

/// The frame λ*, up to sign, of the linear map that takes the face's intrinsic halfedge vectors to `vectors`
/// (in the order and direction of its halfedges) in the least-squares sense; `None` where the map has rank
/// below two and no rotation part.
pub fn rotation_part(mesh: &Mesh, metric: &Metric, face: FaceId, vectors: [DVec3; 3]) -> Option<DQuat> {
    // Normal equations of the fit: df = (Σ v pᵀ)(Σ p pᵀ)⁻¹ with p = ℓ z the intrinsic vectors.
    let (mut vx, mut vy) = (DVec3::ZERO, DVec3::ZERO);
    let (mut pxx, mut pxy, mut pyy) = (0.0, 0.0, 0.0);
    for (h, v) in face.halfedges().into_iter().zip(vectors) {
        let (z, length) = (metric.direction(h), metric.length(mesh.edge(h)));
        let (x, y) = (length * z.re, length * z.im);
        vx += x * v;
        vy += y * v;
        pxx += x * x;
        pxy += x * y;
        pyy += y * y;
    }
    let det = pxx * pyy - pxy * pxy;
    let a = (pyy * vx - pxy * vy) / det;
    let b = (pxx * vy - pxy * vx) / det;
    // df = ω S with S = √(dfᵀ df), for 2×2 by Cayley–Hamilton: S = (dfᵀdf + √det 1)/√(tr + 2 √det).
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let root = a.cross(b).length();
    let (sxx, sxy, syy) = (aa + root, ab, bb + root);
    // ω ∝ df adj(S); the scale drops out when the columns are normalized.
    let t = syy * a - sxy * b;
    let n = a.cross(b);
    if root.is_nan() || root <= 1e-12 * (aa + bb) || root == 0.0 || t.length_squared() == 0.0 || sxx.is_nan() {
        return None;
    }
    let (n, t) = (n.normalize(), t.normalize());
    Some(quaternion::from_frame(n, t, n.cross(t)))
}

/// λ* of positions, with ⟨λ*, λ⟩ ≥ 0; a degenerate face keeps its frame λ.
pub fn frames_of_positions(mesh: &Mesh, metric: &Metric, positions: &[DVec3], frames: &[DQuat]) -> Vec<DQuat> {
    fit(mesh, metric, frames, |f| {
        f.halfedges().map(|h| positions[mesh.tip(h).index()] - positions[mesh.tail(h).index()])
    })
}

/// λ* of edge vectors that need not be closed, with ⟨λ*, λ⟩ ≥ 0.
pub fn frames_of_edge_vectors(mesh: &Mesh, metric: &Metric, vectors: &[DVec3], frames: &[DQuat]) -> Vec<DQuat> {
    fit(mesh, metric, frames, |f| {
        f.halfedges().map(|h| {
            let e = mesh.edge(h);
            if mesh.edge_halfedge(e) == h { vectors[e.index()] } else { -vectors[e.index()] }
        })
    })
}

fn fit(mesh: &Mesh, metric: &Metric, frames: &[DQuat], vectors: impl Fn(FaceId) -> [DVec3; 3] + Sync) -> Vec<DQuat> {
    frames
        .par_iter()
        .enumerate()
        .map(|(f, &frame)| {
            let face = FaceId::new(f);
            match rotation_part(mesh, metric, face, vectors(face)) {
                Some(star) if star.dot(frame) < 0.0 => -star,
                Some(star) => star,
                None => frame,
            }
        })
        .collect()
}
