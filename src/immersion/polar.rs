//! Frames from edge vectors: the rotation part of the linear map of every face (Eq. 11).

use crate::algebra::quaternion;
use crate::mesh::{FaceId, Mesh};
use crate::metric::Metric;
use glam::{DQuat, DVec3};
use rayon::prelude::*;

/// λ* of positions, with ⟨λ*, λ⟩ ≥ 0; a degenerate face keeps its frame λ.
pub fn frames_of_positions(mesh: &Mesh, metric: &Metric, positions: &[DVec3], frames: &[DQuat]) -> Vec<DQuat> {
    fit(frames, |face| {
        // Two sides determine the map: p along the first of the chart's axes, and q from the same corner.
        let [a, b, c] = mesh.corners(face).map(|v| positions[v.index()]);
        let [first, _, last] = face.halfedges();
        let (p, length, z) = (metric.length(mesh.edge(first)), metric.length(mesh.edge(last)), metric.direction(last));
        let (x, y) = (-length * z.re, -length * z.im);
        [(b - a) * y, (c - a) * p - (b - a) * x]
    })
}

/// λ* of edge vectors that need not be closed, with ⟨λ*, λ⟩ ≥ 0.
pub fn frames_of_edge_vectors(mesh: &Mesh, metric: &Metric, vectors: &[DVec3], frames: &[DQuat]) -> Vec<DQuat> {
    fit(frames, |face| {
        // Normal equations of the fit: df = (Σ v pᵀ)(Σ p pᵀ)⁻¹ with p = ℓ z the intrinsic vectors.
        let (mut vx, mut vy) = (DVec3::ZERO, DVec3::ZERO);
        let (mut pxx, mut pxy, mut pyy) = (0.0, 0.0, 0.0);
        for h in face.halfedges() {
            let e = mesh.edge(h);
            let v = if mesh.edge_halfedge(e) == h { vectors[e.index()] } else { -vectors[e.index()] };
            let (z, length) = (metric.direction(h), metric.length(e));
            let (x, y) = (length * z.re, length * z.im);
            vx += x * v;
            vy += y * v;
            pxx += x * x;
            pxy += x * y;
            pyy += y * y;
        }
        [pyy * vx - pxy * vy, pxx * vy - pxy * vx]
    })
}

/// Frames of the linear maps df of all faces, each given by its columns up to one positive factor.
fn fit(frames: &[DQuat], columns: impl Fn(FaceId) -> [DVec3; 2] + Sync) -> Vec<DQuat> {
    let frame = |(f, frame): (usize, &DQuat)| rotation_part(columns(FaceId::new(f)), *frame);
    frames.par_iter().with_min_len(1024).enumerate().map(frame).collect()
}

/// The rotation part of the map with columns a and b, in the least-squares sense, with the sign that brings it nearer
/// to `frame`; `frame` itself where the map has rank below two and no rotation part.
#[inline(always)]
fn rotation_part([a, b]: [DVec3; 2], frame: DQuat) -> DQuat {
    // df = ω S with S = √(dfᵀ df), for 2×2 by Cayley–Hamilton: S = (dfᵀdf + √det 1)/√(tr + 2 √det).
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let normal = a.cross(b);
    let root = normal.length();
    // ω ∝ df adj(S); the scale drops out when the columns are normalized.
    let tangent = (bb + root) * a - ab * b;
    let length = tangent.length();
    if root > 1e-12 * (aa + bb) && length > 0.0 {
        let (n, t) = (normal * (1.0 / root), tangent * (1.0 / length));
        quaternion::from_frame_near(n, t, n.cross(t), frame)
    } else {
        frame
    }
}
