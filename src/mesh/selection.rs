//! Sets of vertices and edges that a scene selects.

use super::{EdgeId, Mesh, VertexId};
use crate::scene::{EdgeSelection, SelectionSection};
use glam::DVec3;

/// Why nothing is selected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SelectionError {
    #[error("nothing is selected; choose a larger region, or name vertices by index")]
    Nothing,
    #[error("there is no vertex {vertex}, the mesh has {vertices} vertices; use indices below {vertices}")]
    NoSuchVertex { vertex: usize, vertices: usize },
    #[error("there is no boundary loop {loop_index}, the mesh has {loops}; count them from 0")]
    NoSuchLoop { loop_index: usize, loops: usize },
    #[error("there is no edge between vertices {ends:?}; name two neighbours")]
    NoSuchEdge { ends: [usize; 2] },
    #[error("the edge {ends:?} is on the boundary, where nothing bends; leave it out")]
    BoundaryEdge { ends: [usize; 2] },
    #[error("the mesh has no positions to select by; name vertices by index or boundary loop")]
    NoPositions,
}

/// The selected vertices: in the order of a list where the scene gives one, as often as it names them; else by index,
/// each once.
///
/// # Errors
/// [`SelectionError`]
pub fn select_vertices(
    section: &SelectionSection,
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Vec<VertexId>, SelectionError> {
    let located = || positions.ok_or(SelectionError::NoPositions);
    let inside = |contains: &dyn Fn(DVec3) -> bool| -> Result<Vec<VertexId>, SelectionError> {
        let positions = located()?;
        Ok(mesh.vertices().filter(|v| contains(positions[v.index()])).collect())
    };
    let selected = match section {
        SelectionSection::Vertices(vertices) => vertices
            .iter()
            .map(|&vertex| match mesh.vertex_count() {
                vertices if vertex >= vertices => Err(SelectionError::NoSuchVertex { vertex, vertices }),
                _ => Ok(VertexId::new(vertex)),
            })
            .collect::<Result<_, _>>()?,
        SelectionSection::Boundary(indices) => {
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
        SelectionSection::Box([a, b]) => {
            let (a, b) = (DVec3::from_array(*a), DVec3::from_array(*b));
            let (low, high) = (a.min(b), a.max(b));
            inside(&|p| p.cmpge(low).all() && p.cmple(high).all())?
        }
        SelectionSection::Ball([x, y, z, radius]) => {
            let center = DVec3::new(*x, *y, *z);
            inside(&|p| p.distance(center) <= *radius)?
        }
        SelectionSection::Nearest(points) => {
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
    section: &EdgeSelection,
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Vec<EdgeId>, SelectionError> {
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let ends = |e: EdgeId| sorted(mesh.edge_vertices(e).map(|v| v.index()));
    let selected: Vec<EdgeId> = match section {
        EdgeSelection::Edges(named) => {
            let mut edges: Vec<([usize; 2], EdgeId)> = mesh.edges().map(|e| (ends(e), e)).collect();
            edges.sort_unstable();
            let find = |&ends: &[usize; 2]| {
                let at = edges
                    .binary_search_by_key(&sorted(ends), |(ends, _)| *ends)
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
