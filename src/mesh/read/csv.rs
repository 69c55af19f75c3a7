//! Edge lengths from lines `u,v,length`, and numbers of vertices from lines `v,number`.

use std::path::Path;

use super::{Problem, index, lines, number, read_bytes};
use crate::mesh::{EdgeId, Mesh, MeshError, VertexId};

/// Reads one length per edge, in edge order, from lines `u,v,length`.
///
/// `u` and `v` are vertices of the mesh, counted from 0, in any order. Every edge is given once; giving
/// it again with the same length is allowed. The first line may be a header, `#` starts a comment.
///
/// # Errors
/// [`MeshError::FileLine`] for a line that is malformed, names no edge, contradicts an earlier one or
/// gives a length that is not positive and finite; [`MeshError::File`] if edges are missing.
pub fn read_edge_lengths(path: &Path, mesh: &Mesh) -> Result<Vec<f64>, MeshError> {
    parse(&read_bytes(path)?, mesh).map_err(|problem| problem.in_file(path))
}

fn parse(bytes: &[u8], mesh: &Mesh) -> Result<Vec<f64>, Problem> {
    let text =
        std::str::from_utf8(bytes).map_err(|_| Problem::new("the file is not text", "write lines `u,v,length`"))?;
    let mut edges: Vec<([u32; 2], EdgeId)> =
        mesh.edges().map(|e| (sorted(mesh.edge_vertices(e).map(|v| v.0)), e)).collect();
    edges.sort_unstable();
    let mut given: Vec<Option<(f64, usize)>> = vec![None; edges.len()];
    for (n, (line, content)) in lines(text).enumerate() {
        let mut words = content.split(',').map(str::trim);
        let is_header = n == 0 && content.starts_with(|c: char| c.is_alphabetic() || c == '"');
        if is_header {
            continue;
        }
        let u = index(words.next(), line, "vertex u")?;
        let v = index(words.next(), line, "vertex v")?;
        let length = number(words.next(), line, "the length")?;
        if words.next().is_some() {
            return Err(Problem::at(line, "there are more than three columns", "write `u,v,length`"));
        }
        if length <= 0.0 {
            return Err(Problem::at(line, format!("the length {length} is not positive"), "give a length above 0"));
        }
        let Ok(found) = edges.binary_search_by_key(&sorted([u, v]), |edge| edge.0) else {
            return Err(Problem::at(
                line,
                format!("the mesh has no edge from vertex {u} to vertex {v}"),
                "vertices count from 0; remove the line or correct it",
            ));
        };
        match &mut given[edges[found].1.index()] {
            Some((earlier, first)) if *earlier != length => {
                return Err(Problem::at(
                    line,
                    format!("edge {u},{v} has length {length} here and {earlier} on line {first}"),
                    "give every edge one length",
                ));
            }
            slot => *slot = slot.or(Some((length, line))),
        }
    }
    let missing = given.iter().filter(|g| g.is_none()).count();
    if let Some(first) = given.iter().position(Option::is_none) {
        let [u, v] = mesh.edge_vertices(EdgeId::new(first));
        return Err(Problem::new(
            format!("{missing} of {} edges have no length, the first is {},{}", given.len(), u.0, v.0),
            "give every edge of the mesh a line `u,v,length`",
        ));
    }
    Ok(given.into_iter().flatten().map(|(length, _)| length).collect())
}

/// Reads numbers of some vertices, in order of vertices, from lines `v,number`.
///
/// `v` counts from 0; no vertex is given twice. The first line may be a header, `#` starts a comment.
///
/// # Errors
/// [`MeshError::FileLine`] for a line that is malformed, names no vertex or one that was named before;
/// [`MeshError::File`] if there are none.
pub fn read_vertex_numbers(path: &Path, mesh: &Mesh) -> Result<Vec<(VertexId, f64)>, MeshError> {
    parse_vertex_numbers(&read_bytes(path)?, mesh).map_err(|problem| problem.in_file(path))
}

fn parse_vertex_numbers(bytes: &[u8], mesh: &Mesh) -> Result<Vec<(VertexId, f64)>, Problem> {
    let text =
        std::str::from_utf8(bytes).map_err(|_| Problem::new("the file is not text", "write lines `v,number`"))?;
    let mut given: Vec<Option<(f64, usize)>> = vec![None; mesh.vertex_count()];
    for (n, (line, content)) in lines(text).enumerate() {
        let mut words = content.split(',').map(str::trim);
        if n == 0 && content.starts_with(|c: char| c.is_alphabetic() || c == '"') {
            continue;
        }
        let vertex = index(words.next(), line, "the vertex")?;
        let value = number(words.next(), line, "the number")?;
        if words.next().is_some() {
            return Err(Problem::at(line, "there are more than two columns", "write `v,number`"));
        }
        match given.get_mut(vertex as usize) {
            None => {
                let reason = format!("there is no vertex {vertex}, the mesh has {}", mesh.vertex_count());
                return Err(Problem::at(line, reason, "count vertices from 0"));
            }
            Some(Some((_, first))) => {
                let reason = format!("vertex {vertex} was given on line {first}");
                return Err(Problem::at(line, reason, "give every vertex once"));
            }
            Some(slot) => *slot = Some((value, line)),
        }
    }
    let numbers: Vec<_> = mesh.vertices().filter_map(|v| given[v.index()].map(|(value, _)| (v, value))).collect();
    if numbers.is_empty() {
        return Err(Problem::new("it has no lines", "write lines `v,number`"));
    }
    Ok(numbers)
}

fn sorted([u, v]: [u32; 2]) -> [u32; 2] {
    [u.min(v), u.max(v)]
}
