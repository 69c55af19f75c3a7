//! How much the pins, regions and tables of a scene select.

use std::collections::HashSet;

use glam::DVec3;

use crate::mesh::{
    EdgeId, EdgeSelection, Mesh, Selection, VertexId, read_vertex_numbers, select_edges, select_vertices,
};
use crate::scene::{ChangeKind, Scene};

/// A line for each selection of a scene that is valid for the mesh.
pub(super) fn selection_notes(scene: &Scene, mesh: &Mesh, places: Option<&[DVec3]>) -> Vec<String> {
    let mut notes = Vec::new();
    let by_vertices = |section: &Selection| select_vertices(section, mesh, places).unwrap_or_default();
    for (k, pin) in scene.pins.iter().enumerate() {
        notes.push(format!("pin[{k}]: {}", caught(mesh, &by_vertices(&pin.vertices), None)));
    }
    for (k, change) in scene.metric.changes.iter().enumerate() {
        let ChangeKind::Ricci(ricci) = &change.kind else { continue };
        for (n, region) in ricci.regions.iter().enumerate() {
            let vertices = by_vertices(&region.vertices);
            notes.push(format!("metric.change[{k}].region[{n}]: {}", caught(mesh, &vertices, None)));
        }
        if let Some(path) = &ricci.csv {
            let named = read_vertex_numbers(&scene.resolve(path), mesh).unwrap_or_default();
            let vertices: Vec<VertexId> = named.into_iter().map(|(v, _)| v).collect();
            notes.push(format!("metric.change[{k}].csv: {}", caught(mesh, &vertices, None)));
        }
    }
    for (k, region) in scene.bending.iter().flat_map(|bending| bending.regions.iter().enumerate()) {
        let edges = select_edges(&region.edges, mesh, places).unwrap_or_default();
        let vertices = match &region.edges {
            EdgeSelection::Edges(_) => edges.iter().flat_map(|&e| mesh.edge_vertices(e)).collect(),
            EdgeSelection::Between(section) => by_vertices(section),
        };
        notes.push(format!("bending.region[{k}]: {}", caught(mesh, &vertices, Some(&edges))));
    }
    notes
}

/// Vertices, the edges among them or those that are given, and the faces among them.
fn caught(mesh: &Mesh, vertices: &[VertexId], edges: Option<&[EdgeId]>) -> String {
    let chosen: HashSet<VertexId> = vertices.iter().copied().collect();
    let among = |ends: &[VertexId]| ends.iter().all(|v| chosen.contains(v));
    let edge_count = match edges {
        Some(edges) => edges.iter().collect::<HashSet<_>>().len(),
        None => mesh.edges().filter(|&e| among(&mesh.edge_vertices(e))).count(),
    };
    let faces = mesh.faces().filter(|&f| among(&mesh.corners(f))).count();
    let count = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    format!(
        "{}, {}, {}",
        count(chosen.len(), "vertex", "vertices"),
        count(edge_count, "edge", "edges"),
        count(faces, "face", "faces")
    )
}
