//! Wavefront OBJ: a `v` line for each vertex and an `f` line for each face.

use std::fmt::Write;
use std::path::Path;

use glam::DVec3;

use super::error::WriteError;
use crate::mesh::Mesh;
use crate::whole_file;

/// Writes a mesh with the positions of its vertices, |V|, as an OBJ file.
///
/// Vertices and faces stand in the order of the mesh, which is that of the file it was read from without the vertices
/// that belong to no face, so that vertex `v` has the number `v + 1` in the file. Coordinates have as many digits as it
/// takes to read the same numbers back. The file is written under another name first, so it is whole or absent.
///
/// # Errors
/// [`WriteError`] if there is not one finite position for each vertex, or the file cannot be written.
pub fn write_obj(path: &Path, mesh: &Mesh, positions: &[DVec3]) -> Result<(), WriteError> {
    let vertices = mesh.vertex_count();
    if positions.len() != vertices {
        return Err(WriteError::Count { path: path.to_owned(), positions: positions.len(), vertices });
    }
    if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
        let position = positions[vertex].to_array();
        return Err(WriteError::NotFinite { path: path.to_owned(), vertex, position });
    }
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        return Err(WriteError::NoFolder { path: path.to_owned(), folder: folder.to_owned() });
    }
    let mut text = String::new();
    for DVec3 { x, y, z } in positions {
        // This form has an exponent where the number is very large or very small. Writing to a string does not fail.
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}");
    }
    for face in mesh.faces() {
        let [a, b, c] = mesh.corners(face).map(|v| v.index() + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    whole_file::write(path, text.as_bytes())
        .map_err(|error| WriteError::Io { path: path.to_owned(), reason: error.to_string() })
}
