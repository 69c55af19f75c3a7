//! The thin shell: faces with mass, joined by hinges.

use crate::algebra::{Complex, quaternion};
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::metric::Metric;
use crate::spin::SpinStructure;
use glam::{DQuat, DVec3};

/// What the frame energy knows of an interior edge `ij`.
#[derive(Clone, Copy, Debug)]
pub struct Hinge {
    /// The edge.
    pub edge: EdgeId,
    /// Face on the side of the edge's named halfedge.
    pub i: FaceId,
    /// Face on the other side.
    pub j: FaceId,
    /// τ̃_ij: frames agree across the hinge when `λ_j = τ̃_ij λ_i`. The spin connection, or, with a target
    /// bending angle α̂, `exp(α̂/2 z_ji j) τ_ij` (Sec. 6.3).
    pub transport: DQuat,
    /// τ_ij itself, which rim bits and creases are measured with.
    pub spin: Complex,
    /// z_ji, the direction of the edge in the coordinates of `j` (Eq. 14).
    pub direction: Complex,
    /// w_ij, the weight of the dual edge (Eq. 20).
    pub weight: f64,
}

impl Hinge {
    /// The rim bit 𝔰 (Def. 4.1): whether frames are in opposite hemispheres after transport by τ.
    #[inline]
    pub fn is_rim(&self, frames: &[DQuat]) -> bool {
        frames[self.j.index()].dot(self.spin * frames[self.i.index()]) < 0.0
    }
}

/// All that the evolution of frames depends on besides the frames themselves.
#[derive(Clone, Debug)]
pub struct Shell {
    /// One hinge per interior edge, in edge order.
    pub hinges: Vec<Hinge>,
    /// Areas of the faces, the mass matrix M (Eq. 40).
    pub face_areas: Vec<f64>,
    /// Per face: its up to three hinges in halfedge order, and whether the face is side `i` of it.
    pub face_hinges: Vec<[Option<(u32, bool)>; 3]>,
    mean_face_area: f64,
}

impl Shell {
    /// Joins metric and spin structure; `bending_angles` are the targets α̂ in radians, one per edge
    /// (boundary entries are ignored), or `None` for a shell that is flat at rest.
    pub fn new(mesh: &Mesh, metric: &Metric, spin: &SpinStructure, bending_angles: Option<&[f64]>) -> Shell {
        let mut face_hinges = vec![[None; 3]; mesh.face_count()];
        let mut hinges = Vec::with_capacity(mesh.edge_count());
        for e in mesh.edges() {
            let Some([h, twin]) = mesh.edge_sides(e) else { continue };
            let direction = metric.direction(twin);
            let spin = spin.across(mesh, h);
            let tau = spin.quaternion();
            let transport = match bending_angles {
                None => tau,
                Some(angles) => {
                    let axis = DVec3::new(0.0, direction.re, direction.im); // z_ji j
                    quaternion::exp(0.5 * angles[e.index()], axis) * tau
                }
            };
            let index = hinges.len() as u32;
            face_hinges[h.face().index()][h.corner()] = Some((index, true));
            face_hinges[twin.face().index()][twin.corner()] = Some((index, false));
            hinges.push(Hinge {
                edge: e,
                i: h.face(),
                j: twin.face(),
                transport,
                spin,
                direction,
                weight: metric.dual_weight(e),
            });
        }
        let mean_face_area = metric.mean_face_area();
        Shell { hinges, face_areas: metric.face_areas().to_vec(), face_hinges, mean_face_area }
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.face_areas.len()
    }

    /// Mean face area, the unit of time steps.
    pub fn mean_face_area(&self) -> f64 {
        self.mean_face_area
    }
}
