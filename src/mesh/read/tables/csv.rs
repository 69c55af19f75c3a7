//! Edge lengths from lines `u,v,length`, and numbers of vertices from lines `v,number`.

use std::path::Path;

use super::header::Columns;
use super::table::Table;
use crate::mesh::read::edges::EdgeFinder;
use crate::mesh::read::problem::{Problem, read_bytes};
use crate::mesh::{EdgeId, Mesh, MeshError, UnknownVertex, VertexId};

/// Reads one length per edge, in edge order, from lines `u,v,length`.
///
/// `u` and `v` are vertices by their numbers in the mesh file, counted from 0, in any order; of a welded vertex any of its
/// numbers. Every edge is given once; giving it again with the same length is allowed. The first line may be a header, which
/// says the order of columns, `u,v,length` by these or other usual names; what else it names is left out. `#` starts a
/// comment; columns may also be separated by `;` (then a decimal comma is understood), tabs or blanks.
///
/// # Errors
/// [`MeshError::FileLine`] for a line that is malformed, names no edge, contradicts an earlier one or
/// gives a length that is not positive and finite; [`MeshError::File`] if edges are missing.
pub fn read_edge_lengths(path: &Path, mesh: &Mesh) -> Result<Vec<f64>, MeshError> {
    parse(&read_bytes(path)?, mesh).map_err(|problem| problem.in_file(path))
}

fn parse(bytes: &[u8], mesh: &Mesh) -> Result<Vec<f64>, Problem> {
    let finder = EdgeFinder::new(mesh);
    let mut given: Vec<Option<(f64, usize)>> = vec![None; mesh.edge_count()];
    Table::decode(bytes, "write lines `u,v,length`")?.rows(&Columns::Edges, |marks, row| {
        let line = row.line;
        let u = row.index(0, "vertex u")?;
        let v = row.index(1, "vertex v")?;
        let length = row.number(2, "the length", marks)?;
        if row.columns() > 3 {
            return Err(Problem::at(
                line,
                "there are more than three columns",
                "write `u,v,length`, and decimals with a point",
            ));
        }
        if length <= 0.0 {
            return Err(Problem::at(line, format!("the length {length} is not positive"), "give a length above 0"));
        }
        let no_edge = || {
            Problem::at(
                line,
                format!("the mesh has no edge from vertex {u} to vertex {v}"),
                "vertices count from 0; remove the line or correct it",
            )
        };
        if [u, v].iter().any(|&end| end as usize >= mesh.file_vertex_count()) {
            return Err(no_edge());
        }
        let edge = finder.between([vertex(u, line, mesh)?, vertex(v, line, mesh)?]).ok_or_else(no_edge)?;
        match &mut given[edge.index()] {
            Some((earlier, first)) if *earlier != length => {
                return Err(Problem::at(
                    line,
                    format!("edge {u},{v} has length {length} here and {earlier} on line {first}"),
                    "give every edge one length",
                ));
            }
            slot => *slot = slot.or(Some((length, line))),
        }
        Ok(())
    })?;
    let missing = given.iter().filter(|g| g.is_none()).count();
    if let Some(first) = given.iter().position(Option::is_none) {
        let [u, v] = mesh.file_ends(EdgeId::new(first));
        return Err(Problem::new(
            format!("{missing} of {} edges have no length, the first is {u},{v}", given.len()),
            "give every edge of the mesh a line `u,v,length`",
        ));
    }
    Ok(given.into_iter().flatten().map(|(length, _)| length).collect())
}

/// Reads numbers of some vertices, in order of vertices, from lines `v,number`.
///
/// `v` is the number of the vertex in the mesh file, counted from 0; no vertex is given twice, but a welded one by several of
/// its numbers if they agree. Lines are as in [`read_edge_lengths`]; a header names `v` and `degrees`.
///
/// # Errors
/// [`MeshError::FileLine`] for a line that is malformed, names no vertex or one that was named before;
/// [`MeshError::File`] if there are none.
pub fn read_vertex_numbers(path: &Path, mesh: &Mesh) -> Result<Vec<(VertexId, f64)>, MeshError> {
    parse_vertex_numbers(&read_bytes(path)?, mesh).map_err(|problem| problem.in_file(path))
}

fn parse_vertex_numbers(bytes: &[u8], mesh: &Mesh) -> Result<Vec<(VertexId, f64)>, Problem> {
    let mut given: Vec<Option<(f64, usize, u32)>> = vec![None; mesh.vertex_count()];
    Table::decode(bytes, "write lines `v,number`")?.rows(&Columns::Vertices, |marks, row| {
        let line = row.line;
        let number = row.index(0, "the vertex")?;
        let value = row.number(1, "the number", marks)?;
        if row.columns() > 2 {
            return Err(Problem::at(
                line,
                "there are more than two columns",
                "write `v,number`, and decimals with a point",
            ));
        }
        let v = vertex(number, line, mesh)?;
        match &mut given[v.index()] {
            Some((earlier, first, other)) if *other == number || *earlier != value => {
                let reason = match *other == number {
                    true => format!("vertex {number} was given on line {first}"),
                    false => format!("vertex {number} is welded to {other}, which has {earlier} on line {first}"),
                };
                return Err(Problem::at(line, reason, "give every vertex once"));
            }
            slot => *slot = slot.or(Some((value, line, number))),
        }
        Ok(())
    })?;
    let numbers: Vec<_> = mesh.vertices().filter_map(|v| given[v.index()].map(|(value, ..)| (v, value))).collect();
    if numbers.is_empty() {
        return Err(Problem::new("it has no lines", "write lines `v,number`"));
    }
    Ok(numbers)
}

/// The vertex that has a number in the file.
fn vertex(number: u32, line: usize, mesh: &Mesh) -> Result<VertexId, Problem> {
    mesh.vertex_of_file(number as usize).map_err(|unknown| match unknown {
        UnknownVertex::Dropped => {
            let reason = format!("vertex {number} belongs to no face of the file");
            Problem::at(line, reason, "remove the line, or name another vertex; they count from 0")
        }
        UnknownVertex::Beyond(count) => {
            Problem::at(line, format!("there is no vertex {number}, the mesh has {count}"), "count vertices from 0")
        }
    })
}
