//! Closed triangle strips (Sec. 2.1), the dual cycles on which figure-0 and figure-8 are told apart.

use crate::algebra::Complex;
use crate::mesh::{HalfedgeId, Mesh, VertexId};
use crate::metric::Metric;

/// A closed triangle strip: the halfedges through which it leaves each of its faces, in order.
///
/// `halfedges[k + 1]` lies in the face of the twin of `halfedges[k]`, cyclically.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Strip {
    halfedges: Vec<HalfedgeId>,
}

impl Strip {
    /// Checks that the halfedges form a closed strip.
    pub fn new(mesh: &Mesh, halfedges: Vec<HalfedgeId>) -> Option<Strip> {
        let follows = |k: usize| {
            let next = halfedges[(k + 1) % halfedges.len()];
            mesh.twin(halfedges[k]).is_some_and(|twin| twin.face() == next.face() && twin != next)
        };
        (!halfedges.is_empty() && (0..halfedges.len()).all(follows)).then_some(Strip { halfedges })
    }

    /// The faces around an interior vertex, counterclockwise; `None` on the boundary.
    pub fn around_vertex(mesh: &Mesh, v: VertexId) -> Option<Strip> {
        if mesh.is_boundary_vertex(v) {
            return None;
        }
        Some(Strip { halfedges: mesh.outgoing(v).map(HalfedgeId::previous).collect() })
    }

    /// The halfedges through which the strip leaves each face.
    pub fn exits(&self) -> &[HalfedgeId] {
        &self.halfedges
    }

    /// Pairs (entry, exit) of halfedges of each face of the strip, in order.
    pub fn passages<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = (HalfedgeId, HalfedgeId)> + 'a {
        let n = self.halfedges.len();
        (0..n).filter_map(move |k| Some((mesh.twin(self.halfedges[(k + n - 1) % n])?, self.halfedges[k])))
    }

    /// Σ κ over the strip (App. B.2): the sum of the signed angles at the corners that the strip
    /// passes on its left (negative) and right (positive), so 2π − Ω around a vertex.
    pub fn total_geodesic_curvature(&self, mesh: &Mesh, metric: &Metric) -> f64 {
        self.passages(mesh)
            .map(|(entry, exit)| {
                if exit == entry.next() {
                    -metric.corner_angle(exit.face(), exit.corner())
                } else {
                    metric.corner_angle(entry.face(), entry.corner())
                }
            })
            .sum()
    }

    /// Π τ along the strip, for one value of τ per halfedge crossed.
    pub fn transport(&self, tau: impl Fn(HalfedgeId) -> Complex) -> Complex {
        self.halfedges.iter().fold(Complex::ONE, |product, &h| product * tau(h))
    }
}
