//! Two faces that share an edge, and the angle between them.

use crate::mesh::Mesh;
use crate::metric::Metric;
use glam::DVec3;

/// An inner edge with the four vertices around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hinge {
    /// Those of [`Mesh::hinge_vertices`].
    pub corners: [usize; 4],
    /// What a bending angle costs: the length of the edge over that of its dual.
    pub weight: f64,
    /// Its edge.
    pub edge: usize,
}

/// A bending angle and its gradient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// In radians, with the sign of Eq. 15.
    pub angle: f64,
    /// By the places of the four corners.
    pub gradient: [DVec3; 4],
}

/// All inner edges, in order.
pub(super) fn hinges(mesh: &Mesh, metric: &Metric) -> Vec<Hinge> {
    let hinge = |e| {
        let corners = mesh.hinge_vertices(e)?.map(|v| v.index());
        Some(Hinge { corners, weight: metric.dual_weight(e), edge: e.index() })
    };
    mesh.edges().filter_map(hinge).collect()
}

impl Hinge {
    /// The bending angle alone, in radians.
    pub fn angle(&self, positions: &[DVec3]) -> f64 {
        let (along, n, m) = self.normals(positions);
        angle_between(along, n, m)
    }

    /// The bending angle and its gradient.
    pub fn bend(&self, positions: &[DVec3]) -> Bend {
        let (along, n, m) = self.normals(positions);
        let (angle, length) = (angle_between(along, n, m), along.length());
        let [a, _, c, d] = self.corners.map(|v| positions[v]);
        // A corner turns its face about the edge; the ends take up what is left, so that nothing turns or moves as a whole.
        let [across, across_twin] = [n, m].map(|normal| normal * (-length / normal.length_squared()));
        let [at, at_twin] = [c, d].map(|corner| (corner - a).dot(along) / (length * length));
        let tail = -(across * (1.0 - at) + across_twin * (1.0 - at_twin));
        let tip = -(across * at + across_twin * at_twin);
        Bend { angle, gradient: [tail, tip, across, across_twin] }
    }

    /// The edge from its tail to its tip, and normals of the two faces, as long as twice their areas.
    fn normals(&self, positions: &[DVec3]) -> (DVec3, DVec3, DVec3) {
        let [a, b, c, d] = self.corners.map(|v| positions[v]);
        let along = b - a;
        (along, along.cross(c - a), (d - a).cross(along))
    }
}

/// From one normal to the other about an edge.
fn angle_between(along: DVec3, n: DVec3, m: DVec3) -> f64 {
    libm::atan2(n.cross(m).dot(along) / along.length(), n.dot(m))
}
