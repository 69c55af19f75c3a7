//! Sets of vertices and edges that a scene selects.

use super::{EdgeId, HalfedgeId, Mesh, UnknownVertex, VertexId};
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
    #[error("vertex {vertex} belongs to no face of the file; name another one")]
    DroppedVertex { vertex: usize },
    #[error("there is no boundary loop {loop_index}, the mesh has {loops}; count them from 0")]
    NoSuchLoop { loop_index: usize, loops: usize },
    #[error("the mesh has no boundary; name vertices by index, box, ball or nearest point")]
    NoBoundary,
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
            .map(|&vertex| {
                mesh.vertex_of_file(vertex).map_err(|unknown| match unknown {
                    UnknownVertex::Beyond(vertices) => SelectionError::NoSuchVertex { vertex, vertices },
                    UnknownVertex::Dropped => SelectionError::DroppedVertex { vertex },
                })
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
        SelectionSection::OuterBoundary | SelectionSection::LongestBoundary => {
            let chosen = match section {
                SelectionSection::OuterBoundary => outer_loops(mesh, positions),
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

/// Of each component that has a boundary its longest loop, as indices into [`Mesh::boundary_loops`]: by the lengths of
/// edges between `places`, or where there are none by their number. Of equally long ones the first.
pub fn longest_loops(mesh: &Mesh, places: Option<&[DVec3]>) -> Vec<usize> {
    chosen_loops(mesh, places, |_| true)
}

/// Of each component that has a boundary the loop around all its others, as indices into [`Mesh::boundary_loops`]: the
/// one whose box contains theirs. Where there is none, or there are no `places`, the longest.
pub fn outer_loops(mesh: &Mesh, places: Option<&[DVec3]>) -> Vec<usize> {
    let Some(places) = places else { return longest_loops(mesh, None) };
    let boxes: Vec<[DVec3; 2]> = mesh
        .boundary_loops()
        .iter()
        .map(|cycle| {
            let points = || cycle.iter().map(|&h| places[mesh.tail(h).index()]);
            [points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max)]
        })
        .collect();
    let contains = |a: usize, b: usize| {
        let ([low, high], slack) = (boxes[a], 1e-9 * boxes[a][0].distance(boxes[a][1]));
        boxes[b][0].cmpge(low - slack).all() && boxes[b][1].cmple(high + slack).all()
    };
    let others = loops_of_components(mesh);
    let of = |k: usize| others.iter().find(|of| of.contains(&k)).into_iter().flatten();
    chosen_loops(mesh, Some(places), |k| of(k).all(|&other| contains(k, other)))
}

/// Boundary loops of each component that has any.
fn loops_of_components(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut component = vec![0; mesh.face_count()];
    let components = mesh.components();
    for (k, faces) in components.iter().enumerate() {
        faces.iter().for_each(|f| component[f.index()] = k);
    }
    let mut of = vec![Vec::new(); components.len()];
    for (k, cycle) in mesh.boundary_loops().iter().enumerate() {
        of[component[cycle[0].face().index()]].push(k);
    }
    of.retain(|loops| !loops.is_empty());
    of
}

/// The longest loop of each component among those preferred or, if none is, among all.
fn chosen_loops(mesh: &Mesh, places: Option<&[DVec3]>, preferred: impl Fn(usize) -> bool) -> Vec<usize> {
    let loops = mesh.boundary_loops();
    let length = |k: usize| -> f64 {
        let side = |&h: &HalfedgeId| places.map_or(1.0, |p| p[mesh.tail(h).index()].distance(p[mesh.tip(h).index()]));
        loops[k].iter().map(side).sum()
    };
    let longest = |of: &[usize]| {
        // Up to rounding, so that the first of two equal ones is meant.
        let most = of.iter().map(|&k| length(k)).fold(0.0, f64::max);
        of.iter().copied().find(|&k| length(k) >= most * (1.0 - 1e-9))
    };
    let choose = |of: Vec<usize>| {
        let first: Vec<usize> = of.iter().copied().filter(|&k| preferred(k)).collect();
        longest(if first.is_empty() { &of } else { &first })
    };
    loops_of_components(mesh).into_iter().filter_map(choose).collect()
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
    let sorted = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
    let ends = |e: EdgeId| sorted(mesh.edge_vertices(e));
    let selected: Vec<EdgeId> = match section {
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
