//! The thin shell: faces with mass, joined by hinges.

use crate::advice::Advice;
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

/// Something that is not of the mesh that it is said to be of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there are {found} {what} for the {edges} edges of the mesh; {}", self.remedy())]
pub struct ShellError {
    /// What there is one of per edge.
    pub what: &'static str,
    /// How many there are.
    pub found: usize,
    /// How many there must be.
    pub edges: usize,
}

impl Advice for ShellError {
    fn remedy(&self) -> String {
        "take all of them from the same mesh".into()
    }
}

/// All that the evolution of frames depends on besides the frames themselves.
#[derive(Clone, Debug)]
pub struct Shell {
    hinges: Vec<Hinge>,
    face_areas: Vec<f64>,
    face_hinges: Vec<[Option<(u32, bool)>; 3]>,
    mean_face_area: f64,
}

impl Shell {
    /// Joins metric and spin structure; `bending_angles` are the targets α̂ in radians, one per edge
    /// (boundary entries are ignored), or `None` for a shell that is flat at rest.
    ///
    /// # Errors
    /// [`ShellError`] if one of them belongs to a mesh with another number of edges.
    pub fn new(
        mesh: &Mesh,
        metric: &Metric,
        spin: &SpinStructure,
        bending_angles: Option<&[f64]>,
    ) -> Result<Shell, ShellError> {
        let edges = mesh.edge_count();
        let counts = [
            ("edge lengths", metric.edge_lengths().len()),
            ("transports", spin.transports().len()),
            ("target bending angles", bending_angles.map_or(edges, <[f64]>::len)),
        ];
        if let Some((what, found)) = counts.into_iter().find(|(_, found)| *found != edges) {
            return Err(ShellError { what, found, edges });
        }
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
        Ok(Shell { hinges, face_areas: metric.face_areas().to_vec(), face_hinges, mean_face_area })
    }

    /// One hinge per interior edge, in edge order.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// Areas of the faces, |F|: the mass matrix M (Eq. 40).
    pub fn face_areas(&self) -> &[f64] {
        &self.face_areas
    }

    /// Per face its up to three hinges in halfedge order, and whether the face is side `i` of it.
    pub fn face_hinges(&self) -> &[[Option<(u32, bool)>; 3]] {
        &self.face_hinges
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
