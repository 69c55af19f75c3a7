//! Numbers that a file gives to edges by their ends, brought to the edges of a mesh.

use std::collections::HashSet;

use glam::DVec3;

use super::problem::Problem;
use crate::mesh::{EdgeId, Mesh, UnknownVertex, VertexId};

/// The edges of a mesh by their ends.
pub(super) struct EdgeFinder(Vec<([VertexId; 2], EdgeId)>);

impl EdgeFinder {
    pub fn new(mesh: &Mesh) -> EdgeFinder {
        let mut edges: Vec<_> = mesh.edges().map(|e| (sorted(mesh.edge_vertices(e)), e)).collect();
        edges.sort_unstable();
        EdgeFinder(edges)
    }

    pub fn between(&self, ends: [VertexId; 2]) -> Option<EdgeId> {
        let found = self.0.binary_search_by_key(&sorted(ends), |edge| edge.0);
        Some(self.0[found.ok()?].1)
    }
}

fn sorted([u, v]: [VertexId; 2]) -> [VertexId; 2] {
    [u.min(v), u.max(v)]
}

/// Numbers of edges, as a file lists them.
pub(super) struct EdgeNumbers {
    /// What they are, in the singular.
    pub what: &'static str,
    pub listed: Listed,
    /// The ends of each edge by their numbers in the file.
    pub ends: Vec<[u32; 2]>,
    /// One number for each; none where the file says that it is not known.
    pub values: Vec<Option<f64>>,
}

/// By what the file counts them.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Listed {
    /// Rows of a table.
    Rows,
    /// Edges, of which some may belong to no face.
    Edges,
    /// Rows are faces, columns their halfedges.
    Halfedges,
}

/// Two halves of an edge agree if they differ by no more than this share, the rounding of single precision and a little more.
const ROUNDING: f64 = 1e-6;

impl EdgeNumbers {
    /// The place of an entry in the file.
    fn place(&self, k: usize) -> String {
        match self.listed {
            Listed::Rows => format!("row {k}"),
            Listed::Edges => format!("edge {k}"),
            Listed::Halfedges => format!("face {}, column {}", k / 3, k % 3),
        }
    }

    /// The number of each edge of a mesh, |E|; none where the file says none.
    ///
    /// # Errors
    /// [`Problem`] for ends that are no vertices or not of an edge, and for two numbers of one edge.
    pub fn on(&self, mesh: &Mesh) -> Result<Vec<Option<f64>>, Problem> {
        let finder = EdgeFinder::new(mesh);
        let mut given: Vec<Option<(f64, usize)>> = vec![None; mesh.edge_count()];
        let from_zero = "vertices count from 0; correct the row or leave it out";
        for (k, (&[u, v], value)) in self.ends.iter().zip(&self.values).enumerate() {
            let mut ends = [VertexId::new(0); 2];
            let mut is_dropped = false;
            for (end, number) in ends.iter_mut().zip([u, v]) {
                match mesh.vertex_of_file(number as usize) {
                    Ok(vertex) => *end = vertex,
                    Err(UnknownVertex::Dropped) => is_dropped = true,
                    Err(UnknownVertex::Beyond(count)) => {
                        let reason = format!("{} names vertex {number}, the mesh has {count}", self.place(k));
                        return Err(Problem::new(reason, from_zero));
                    }
                }
            }
            let edge = if is_dropped { None } else { finder.between(ends) };
            let Some(edge) = edge else {
                if self.listed == Listed::Edges {
                    continue;
                }
                let reason = format!("{} is from vertex {u} to vertex {v}, where the mesh has no edge", self.place(k));
                return Err(Problem::new(reason, from_zero));
            };
            let Some(value) = *value else { continue };
            match given[edge.index()] {
                Some((other, first)) if (other - value).abs() > ROUNDING * other.abs().max(value.abs()) => {
                    let (here, there) = (self.place(k), self.place(first));
                    let what = self.what;
                    let reason = format!("edge {u},{v} has {what} {value} in {here} and {other} in {there}");
                    let remedy = match self.listed {
                        Listed::Halfedges => {
                            "column k is the side from corner k to corner k + 1; of sides opposite to corner k write \
                             numpy.roll(lengths, 1, axis=1)"
                                .to_owned()
                        }
                        _ => format!("give every edge one {what}"),
                    };
                    return Err(Problem::new(reason, remedy));
                }
                Some(_) => {}
                None => given[edge.index()] = Some((value, k)),
            }
        }
        Ok(given.into_iter().map(|given| Some(given?.0)).collect())
    }

    /// Refuses numbers that are no lengths.
    pub fn check_lengths(&self) -> Result<(), Problem> {
        let is_wrong = |value: &Option<f64>| value.is_none_or(|length| !(length > 0.0 && length.is_finite()));
        match self.values.iter().position(is_wrong) {
            Some(k) => {
                let [u, v] = self.ends[k];
                let length = self.values[k].unwrap_or(f64::NAN);
                let reason = format!("edge {u},{v} has length {length} ({})", self.place(k));
                Err(Problem::new(reason, "every length must be a number above 0"))
            }
            None => Ok(()),
        }
    }

    /// The length of every edge, |E|. Where a polygon was cut, those of its sides say nothing of the cuts; they are taken
    /// from positions, if these have the lengths that its sides are given.
    pub fn lengths_on(&self, mesh: &Mesh, positions: Option<&[DVec3]>) -> Result<Vec<f64>, Problem> {
        self.check_lengths()?;
        let given = self.on(mesh)?;
        let is_cut = |e: EdgeId| mesh.edge_sides(e).is_some_and(|[a, b]| polygon(mesh, a) == polygon(mesh, b));
        let distance = |e: EdgeId| {
            let [a, b] = mesh.edge_vertices(e).map(|v| positions.map(|positions| positions[v.index()]));
            Some(a?.distance(b?))
        };
        let mut changed: HashSet<usize> = HashSet::new();
        for e in mesh.edges().filter(|e| !is_cut(*e)) {
            let agrees = |length: f64| distance(e).is_some_and(|d| (d - length).abs() <= DRAWN * length);
            if !given[e.index()].is_some_and(agrees) {
                changed.extend(mesh.halfedges_of(e).map(|h| polygon(mesh, h)));
            }
        }
        let missing = mesh.edges().filter(|e| given[e.index()].is_none() && !is_cut(*e));
        let (count, first) = missing.fold((0, None), |(count, first), e| (count + 1, first.or(Some(e))));
        if let Some(first) = first {
            let [u, v] = mesh.file_ends(first);
            let reason = format!("{count} of {} edges have no length, the first is {u},{v}", mesh.edge_count());
            return Err(Problem::new(reason, "give every edge of the mesh a length"));
        }
        let length = |e: EdgeId| match (given[e.index()], distance(e)) {
            (Some(length), _) => Ok(length),
            (None, Some(distance)) if !mesh.halfedges_of(e).any(|h| changed.contains(&polygon(mesh, h))) => {
                Ok(distance)
            }
            _ => {
                let face = polygon(mesh, mesh.edge_halfedge(e));
                let reason = format!(
                    "face {face} has more than three corners, and the lengths of its sides, which are not those of its \
                     positions, leave its shape open"
                );
                Err(Problem::new(reason, "cut it into triangles, and give their sides lengths, too"))
            }
        };
        mesh.edges().map(length).collect()
    }
}

/// Lengths that were computed from the positions of a file, some of whose digits were left out, differ by less than this
/// share from those that they have.
const DRAWN: f64 = 1e-4;

/// The polygon of the file that the face of a halfedge was cut from.
fn polygon(mesh: &Mesh, h: crate::mesh::HalfedgeId) -> usize {
    mesh.file_face(h.face())
}
