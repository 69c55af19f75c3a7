//! Sets of vertices and of edges, described by numbers, loops or regions of space.

use super::boundary_loops::{longest_loops, outer_loops};
use super::{EdgeId, Mesh, UnknownVertex, VertexId};
use crate::advice::Advice;
use glam::DVec3;

/// A set of vertices.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection {
    /// Vertices by their numbers in the file, counted from 0.
    Vertices(Vec<usize>),
    /// All vertices of these boundary loops, in the order of [`Mesh::boundary_loops`].
    Boundary(Vec<usize>),
    /// Of each component that has a boundary, the loop around all its others. Where there is none, or nothing is known of
    /// positions, it is the longest loop.
    OuterBoundary,
    /// Of each component that has a boundary, its longest loop by the positions of its vertices. Where there are none,
    /// it is the loop with the most edges.
    LongestBoundary,
    /// Vertices inside the box with these opposite corners or on its sides.
    Box([[f64; 3]; 2]),
    /// Vertices in the ball `[x, y, z, radius]`.
    Ball([f64; 4]),
    /// The vertex nearest to each of these points.
    Nearest(Vec<[f64; 3]>),
}

/// A set of edges.
#[derive(Clone, Debug, PartialEq)]
pub enum EdgeSelection {
    /// Edges by the numbers of their ends in the file. None may be on the boundary.
    Edges(Vec<[usize; 2]>),
    /// The interior edges with both ends selected.
    Between(Selection),
}

/// Why nothing is selected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SelectionError {
    #[error("nothing is selected; {}", self.remedy())]
    Nothing,
    #[error("there is no vertex {vertex}, the mesh has {vertices} vertices; {}", self.remedy())]
    NoSuchVertex { vertex: usize, vertices: usize },
    #[error("vertex {vertex} belongs to no face of the file; {}", self.remedy())]
    DroppedVertex { vertex: usize },
    #[error("there is no boundary loop {loop_index}, the mesh has {loops}; {}", self.remedy())]
    NoSuchLoop { loop_index: usize, loops: usize },
    #[error("the mesh has no boundary; {}", self.remedy())]
    NoBoundary,
    #[error("there is no edge between vertices {ends:?}; {}", self.remedy())]
    NoSuchEdge { ends: [usize; 2] },
    #[error("the edge {ends:?} is on the boundary, where nothing bends; {}", self.remedy())]
    BoundaryEdge { ends: [usize; 2] },
    #[error("the mesh has no positions to select by; {}", self.remedy())]
    NoPositions,
}

impl Advice for SelectionError {
    fn remedy(&self) -> String {
        match self {
            SelectionError::Nothing => "choose a larger region, or name vertices by index".to_owned(),
            SelectionError::NoSuchVertex { vertices, .. } => format!("use indices below {vertices}"),
            SelectionError::DroppedVertex { .. } => "name another one".to_owned(),
            SelectionError::NoSuchLoop { .. } => "count them from 0".to_owned(),
            SelectionError::NoBoundary => "name vertices by index, box, ball or nearest point".to_owned(),
            SelectionError::NoSuchEdge { .. } => "name two neighbours".to_owned(),
            SelectionError::BoundaryEdge { .. } => "leave it out".to_owned(),
            SelectionError::NoPositions => "name vertices by index or boundary loop".to_owned(),
        }
    }
}

/// The selected vertices: in the order of a list where the selection is one, and as often as it names them; otherwise
/// by index, each once.
///
/// # Errors
/// [`SelectionError`]
pub fn select_vertices(
    selection: &Selection,
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Vec<VertexId>, SelectionError> {
    let located = || positions.ok_or(SelectionError::NoPositions);
    let inside = |contains: &dyn Fn(DVec3) -> bool| -> Result<Vec<VertexId>, SelectionError> {
        let positions = located()?;
        Ok(mesh.vertices().filter(|v| contains(positions[v.index()])).collect())
    };
    let selected = match selection {
        Selection::Vertices(vertices) => vertices
            .iter()
            .map(|&vertex| {
                mesh.vertex_of_file(vertex).map_err(|unknown| match unknown {
                    UnknownVertex::Beyond(vertices) => SelectionError::NoSuchVertex { vertex, vertices },
                    UnknownVertex::Dropped => SelectionError::DroppedVertex { vertex },
                })
            })
            .collect::<Result<_, _>>()?,
        Selection::Boundary(indices) => {
            let loops = mesh.boundary_loops();
            let mut vertices = Vec::new();
            for &loop_index in indices {
                let cycle =
                    loops.get(loop_index).ok_or(SelectionError::NoSuchLoop { loop_index, loops: loops.len() })?;
                vertices.extend(cycle.iter().map(|&h| mesh.tail(h)));
            }
            vertices.sort_unstable();
            vertices
        }
        Selection::OuterBoundary | Selection::LongestBoundary => {
            let chosen = match selection {
                Selection::OuterBoundary => outer_loops(mesh, positions),
                _ => longest_loops(mesh, positions),
            };
            let loops = mesh.boundary_loops();
            let mut vertices: Vec<VertexId> =
                chosen.into_iter().flat_map(|k| &loops[k]).map(|&h| mesh.tail(h)).collect();
            if vertices.is_empty() {
                return Err(SelectionError::NoBoundary);
            }
            vertices.sort_unstable();
            vertices
        }
        Selection::Box([a, b]) => {
            let (a, b) = (DVec3::from_array(*a), DVec3::from_array(*b));
            let (low, high) = (a.min(b), a.max(b));
            inside(&|p| p.cmpge(low).all() && p.cmple(high).all())?
        }
        Selection::Ball([x, y, z, radius]) => {
            let center = DVec3::new(*x, *y, *z);
            inside(&|p| p.distance(center) <= *radius)?
        }
        Selection::Nearest(points) => {
            let positions = located()?;
            let nearest = |point: &[f64; 3]| {
                let distance = |v: &VertexId| positions[v.index()].distance_squared(DVec3::from_array(*point));
                mesh.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b)))
            };
            points.iter().filter_map(nearest).collect()
        }
    };
    if selected.is_empty() { Err(SelectionError::Nothing) } else { Ok(selected) }
}

/// The selected interior edges.
///
/// # Errors
/// [`SelectionError`]; an edge on the boundary is refused only where it is named.
pub fn select_edges(
    selection: &EdgeSelection,
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Vec<EdgeId>, SelectionError> {
    let sorted = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
    let ends = |e: EdgeId| sorted(mesh.edge_vertices(e));
    let selected: Vec<EdgeId> = match selection {
        EdgeSelection::Edges(named) => {
            let mut edges: Vec<([VertexId; 2], EdgeId)> = mesh.edges().map(|e| (ends(e), e)).collect();
            edges.sort_unstable();
            let find = |&ends: &[usize; 2]| {
                let vertex = |vertex: usize| {
                    mesh.vertex_of_file(vertex).map_err(|unknown| match unknown {
                        UnknownVertex::Beyond(_) => SelectionError::NoSuchEdge { ends },
                        UnknownVertex::Dropped => SelectionError::DroppedVertex { vertex },
                    })
                };
                let at = edges
                    .binary_search_by_key(&sorted([vertex(ends[0])?, vertex(ends[1])?]), |(ends, _)| *ends)
                    .map_err(|_| SelectionError::NoSuchEdge { ends })?;
                let edge = edges[at].1;
                if mesh.is_boundary_edge(edge) { Err(SelectionError::BoundaryEdge { ends }) } else { Ok(edge) }
            };
            named.iter().map(find).collect::<Result<_, _>>()?
        }
        EdgeSelection::Between(vertices) => {
            let mut chosen = vec![false; mesh.vertex_count()];
            select_vertices(vertices, mesh, positions)?.into_iter().for_each(|v| chosen[v.index()] = true);
            mesh.interior_edges().filter(|&e| mesh.edge_vertices(e).iter().all(|v| chosen[v.index()])).collect()
        }
    };
    if selected.is_empty() { Err(SelectionError::Nothing) } else { Ok(selected) }
}
