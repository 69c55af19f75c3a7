//! Halfedge connectivity of an oriented triangle mesh with or without boundary.
//!
//! There are no positions here: everything downstream of this type is intrinsic.

use super::limits::check_size;
use super::numbering::Numbering;
use super::{EdgeId, FaceId, HalfedgeId, MeshError, VertexId};
use std::sync::Arc;

const NONE: u32 = u32::MAX;

/// An oriented, edge- and vertex-manifold triangle mesh. Every vertex belongs to a face.
///
/// Built by [`Mesh::from_faces`], which refuses anything else, or by [`crate::mesh::repair`],
/// which first orients, compacts and reports. Immutable afterwards.
#[derive(Clone, Debug)]
pub struct Mesh {
    faces: Vec<[VertexId; 3]>,
    /// Per halfedge: the halfedge on the other side, or `NONE` on the boundary.
    twins: Vec<u32>,
    /// Per halfedge: its edge.
    halfedge_edges: Vec<EdgeId>,
    /// Per edge: the halfedge that names it, the one of smaller index. Edge direction is its direction.
    edge_halfedges: Vec<HalfedgeId>,
    /// Per vertex: an outgoing halfedge; for a boundary vertex the one from which a counterclockwise
    /// walk visits the whole star, that is, the outgoing boundary halfedge.
    vertex_halfedges: Vec<HalfedgeId>,
    /// What the file calls vertices and faces; `None` where it counts as the mesh does.
    pub(super) numbering: Option<Arc<Numbering>>,
}

impl Mesh {
    /// Builds connectivity from counterclockwise vertex triples.
    ///
    /// # Errors
    /// [`MeshError`] naming the first element that is degenerate, duplicate, non-manifold,
    /// inconsistently oriented, unreferenced or out of range.
    pub fn from_faces(vertex_count: usize, faces: &[[u32; 3]]) -> Result<Mesh, MeshError> {
        check_size(vertex_count, faces.len())?;
        for (f, &[a, b, c]) in faces.iter().enumerate() {
            for vertex in [a, b, c] {
                if vertex as usize >= vertex_count {
                    return Err(MeshError::VertexOutOfRange { face: f, vertex: vertex as u64, vertex_count });
                }
            }
            if a == b || b == c || c == a {
                return Err(MeshError::DegenerateFace { face: f, corners: [a, b, c] });
            }
        }
        let faces: Vec<[VertexId; 3]> = faces.iter().map(|f| f.map(VertexId)).collect();
        let tip = |h: usize| faces[h / 3][(h % 3 + 1) % 3];
        let tail = |h: usize| faces[h / 3][h % 3];

        // Halfedges sorted by undirected edge: equal keys are neighbours.
        let mut order: Vec<u32> = (0..3 * faces.len() as u32).collect();
        let key = |h: u32| {
            let (a, b) = (tail(h as usize).0, tip(h as usize).0);
            (a.min(b), a.max(b), h)
        };
        order.sort_unstable_by_key(|&h| key(h));
        let mut twins = vec![NONE; order.len()];
        let mut start = 0;
        while start < order.len() {
            let (a, b, _) = key(order[start]);
            let mut end = start + 1;
            while end < order.len() && key(order[end]).0 == a && key(order[end]).1 == b {
                end += 1;
            }
            let group = &order[start..end];
            match *group {
                [_] => {}
                [g, h] => {
                    if tail(g as usize) == tail(h as usize) {
                        return Err(MeshError::InconsistentOrientation {
                            edge: [a, b],
                            faces: [g as usize / 3, h as usize / 3],
                        });
                    }
                    twins[g as usize] = h;
                    twins[h as usize] = g;
                }
                _ => {
                    let faces = group.iter().map(|&h| h as usize / 3).collect();
                    return Err(MeshError::NonManifoldEdge { edge: [a, b], faces });
                }
            }
            start = end;
        }

        // Edges are numbered in the order in which halfedges first meet them.
        let mut halfedge_edges = vec![EdgeId(0); twins.len()];
        let mut edge_halfedges = Vec::with_capacity(twins.len() / 2 + 1);
        for (h, &twin) in twins.iter().enumerate() {
            if twin == NONE || (h as u32) < twin {
                halfedge_edges[h] = EdgeId::new(edge_halfedges.len());
                edge_halfedges.push(HalfedgeId::new(h));
            } else {
                halfedge_edges[h] = halfedge_edges[twin as usize];
            }
        }

        let mut first = vec![NONE; vertex_count];
        let mut degree = vec![0u32; vertex_count];
        for (h, &twin) in twins.iter().enumerate() {
            let v = tail(h).index();
            degree[v] += 1;
            if first[v] == NONE || twin == NONE {
                first[v] = h as u32;
            }
        }
        if let Some(vertex) = first.iter().position(|&h| h == NONE) {
            return Err(MeshError::UnreferencedVertex { vertex });
        }
        let mesh = Mesh {
            faces,
            twins,
            halfedge_edges,
            edge_halfedges,
            vertex_halfedges: first.into_iter().map(HalfedgeId).collect(),
            numbering: None,
        };
        for v in mesh.vertices() {
            if mesh.outgoing(v).count() as u32 != degree[v.index()] {
                return Err(MeshError::NonManifoldVertex { vertex: v.index() });
            }
        }
        Ok(mesh)
    }

    /// Number of vertices |V|.
    pub fn vertex_count(&self) -> usize {
        self.vertex_halfedges.len()
    }
    /// Number of edges |E|.
    pub fn edge_count(&self) -> usize {
        self.edge_halfedges.len()
    }
    /// Number of faces |F|.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }
    /// Number of halfedges, 3 |F|. There are none outside the boundary.
    pub fn halfedge_count(&self) -> usize {
        self.twins.len()
    }

    /// All vertices in index order.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count()).map(VertexId::new)
    }
    /// All edges in index order.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        (0..self.edge_count()).map(EdgeId::new)
    }
    /// All faces in index order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::new)
    }
    /// All halfedges in index order.
    pub fn halfedges(&self) -> impl ExactSizeIterator<Item = HalfedgeId> + use<> {
        (0..self.halfedge_count()).map(HalfedgeId::new)
    }

    /// The corners of a face, counterclockwise.
    #[inline]
    pub fn corners(&self, face: FaceId) -> [VertexId; 3] {
        self.faces[face.index()]
    }
    /// All faces as vertex triples, in index order.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        self.faces.iter().map(|f| f.map(|v| v.0)).collect()
    }
    /// The vertex where a halfedge starts.
    #[inline]
    pub fn tail(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face().index()][h.corner()]
    }
    /// The vertex where a halfedge ends.
    #[inline]
    pub fn tip(&self, h: HalfedgeId) -> VertexId {
        self.faces[h.face().index()][(h.corner() + 1) % 3]
    }
    /// The halfedge on the other side of the edge; `None` on the boundary.
    #[inline]
    pub fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        let twin = self.twins[h.index()];
        (twin != NONE).then_some(HalfedgeId(twin))
    }
    /// The edge a halfedge lies on.
    #[inline]
    pub fn edge(&self, h: HalfedgeId) -> EdgeId {
        self.halfedge_edges[h.index()]
    }
    /// The halfedge that gives an edge its direction: the one of smaller index.
    #[inline]
    pub fn edge_halfedge(&self, e: EdgeId) -> HalfedgeId {
        self.edge_halfedges[e.index()]
    }
    /// Source and destination of an edge in the direction of [`Mesh::edge_halfedge`].
    #[inline]
    pub fn edge_vertices(&self, e: EdgeId) -> [VertexId; 2] {
        let h = self.edge_halfedge(e);
        [self.tail(h), self.tip(h)]
    }
    /// Both halfedges of an interior edge, the one that names it first; `None` on the boundary.
    #[inline]
    pub fn edge_sides(&self, e: EdgeId) -> Option<[HalfedgeId; 2]> {
        let h = self.edge_halfedge(e);
        self.twin(h).map(|twin| [h, twin])
    }
    /// The four vertices around an interior edge: its tail and tip, the corner across from it, and the one across from the twin.
    /// Its faces are (a, b, c) and (b, a, d). `None` on the boundary.
    pub fn hinge_vertices(&self, e: EdgeId) -> Option<[VertexId; 4]> {
        let [h, twin] = self.edge_sides(e)?;
        Some([self.tail(h), self.tip(h), self.tip(h.next()), self.tip(twin.next())])
    }
    /// The one or two halfedges of an edge, the one that names it first.
    pub fn halfedges_of(&self, e: EdgeId) -> impl Iterator<Item = HalfedgeId> + use<> {
        let h = self.edge_halfedge(e);
        std::iter::once(h).chain(self.twin(h))
    }
    /// Whether an edge has a face on one side only.
    #[inline]
    pub fn is_boundary_edge(&self, e: EdgeId) -> bool {
        self.twin(self.edge_halfedge(e)).is_none()
    }
    /// Whether a vertex lies on the boundary.
    #[inline]
    pub fn is_boundary_vertex(&self, v: VertexId) -> bool {
        self.twin(self.vertex_halfedges[v.index()]).is_none()
    }
    /// Interior edges in index order.
    pub fn interior_edges(&self) -> impl Iterator<Item = EdgeId> + '_ {
        self.edges().filter(|&e| !self.is_boundary_edge(e))
    }

    /// The halfedges leaving a vertex, counterclockwise. For a boundary vertex the walk starts at
    /// the outgoing boundary halfedge and ends with the last face of the star.
    pub fn outgoing(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let start = self.vertex_halfedges[v.index()];
        let mut current = Some(start);
        std::iter::from_fn(move || {
            let h = current?;
            current = self.twin(h.previous()).filter(|&next| next != start);
            Some(h)
        })
    }

    /// Connected components as sorted lists of faces, ordered by their first face.
    pub fn components(&self) -> Vec<Vec<FaceId>> {
        let mut seen = vec![false; self.face_count()];
        let mut components = Vec::new();
        for seed in self.faces() {
            if seen[seed.index()] {
                continue;
            }
            seen[seed.index()] = true;
            let mut component = vec![seed];
            let mut next = 0;
            while next < component.len() {
                for h in component[next].halfedges() {
                    if let Some(g) = self.twin(h).map(HalfedgeId::face)
                        && !std::mem::replace(&mut seen[g.index()], true)
                    {
                        component.push(g);
                    }
                }
                next += 1;
            }
            component.sort_unstable();
            components.push(component);
        }
        components
    }

    /// Boundary loops as cycles of boundary halfedges, each with the surface on its left,
    /// ordered by their smallest halfedge.
    pub fn boundary_loops(&self) -> Vec<Vec<HalfedgeId>> {
        let mut seen = vec![false; self.halfedge_count()];
        let mut loops = Vec::new();
        for seed in self.halfedges() {
            if self.twin(seed).is_some() || seen[seed.index()] {
                continue;
            }
            let mut cycle = Vec::new();
            let mut h = seed;
            while !std::mem::replace(&mut seen[h.index()], true) {
                cycle.push(h);
                // The boundary halfedge that leaves the tip.
                h = self.vertex_halfedges[self.tip(h).index()];
            }
            loops.push(cycle);
        }
        loops
    }

    /// Euler characteristic |V| − |E| + |F|.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// First Betti number, that of generators: twice the genus of each component and its boundary loops but one.
    pub fn betti(&self) -> usize {
        let components = self.components();
        let has_boundary =
            |faces: &&Vec<FaceId>| faces.iter().any(|f| f.halfedges().iter().any(|h| self.twin(*h).is_none()));
        2 * self.genus() + self.boundary_loops().len() - components.iter().filter(has_boundary).count()
    }

    /// Sum of the genera of all components.
    pub fn genus(&self) -> usize {
        let components = self.components().len() as i64;
        let boundaries = self.boundary_loops().len() as i64;
        ((2 * components - boundaries - self.euler_characteristic()) / 2) as usize
    }
}
