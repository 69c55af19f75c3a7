//! From a path to a surface.

use std::path::Path;

use super::content;
use super::format::FileFormat;
use super::formats::{arrays, fold, obj, off, ply, stl};
use super::problem::{Problem, read_bytes};
use super::soup::Soup;
use crate::mesh::limits::{LARGEST_COORDINATE, check_size};
use crate::mesh::repair::Unrepairable;
use crate::mesh::surface::first_out_of_reach;
use crate::mesh::{MeshError, Surface, Weld};

/// Reads an OBJ, PLY (ascii or binary), OFF, STL (ascii or binary) or FOLD file, or arrays of NumPy (`.npz` with `faces`, `.npy`
/// of faces), chosen by the file's ending.
///
/// Polygons are cut into triangles, also concave ones. Seams are welded where coordinates are equal, and in STL files
/// also within the rounding of single precision. The result is oriented and compacted by [`crate::mesh::repair`].
/// [`Surface::repairs`] says what all that changed, and [`crate::mesh::Mesh::file_vertex`] what the file calls each
/// vertex. A file whose vertices all lie in one point is purely intrinsic and has no positions, and so is one that lists
/// faces but no vertices. Lengths that a FOLD or `.npz` file decrees are [`Surface::edge_lengths`].
///
/// # Errors
/// [`MeshError::File`] and [`MeshError::FileLine`] for files that cannot be read or parsed,
/// [`MeshError::InFile`] for faces that do not form an oriented surface.
pub fn read(path: &Path) -> Result<Surface, MeshError> {
    read_welded(path, None)
}

/// Reads a file as [`read`] does, but welds its seams as `weld` says, where that is given.
///
/// # Errors
/// The errors of [`read`].
pub fn read_welded(path: &Path, weld: Option<Weld>) -> Result<Surface, MeshError> {
    let (soup, format) = read_soup(path)?;
    let surface = soup.surface(format, weld).map_err(|unrepairable| match unrepairable {
        Unrepairable::Size(error) => Problem::of_size(&error).in_file(path),
        Unrepairable::Faults(mut faults) => {
            let counted_from = format.counts_from();
            for fault in &mut faults.listed {
                fault.lines = soup.lines_of(&fault.faces);
                let face = |f| soup.polygon(f) + counted_from as usize;
                fault.error = fault.error.clone().renumbered(face, counted_from);
            }
            let lines = if let [only] = &*faults.listed { only.lines.clone() } else { Vec::new() };
            MeshError::InFile { path: path.to_owned(), lines, counted_from, error: Box::new(faults.into_error()) }
        }
    })?;
    let lengths = soup.lengths.map(|lengths| lengths.lengths_on(&surface.mesh, surface.positions.as_deref()));
    let edge_lengths = lengths.transpose().map_err(|problem| problem.in_file(path))?;
    Ok(Surface { edge_lengths, ..surface })
}

/// What a file says, and its format. Its numbers of vertices and of triangles are such that 32 bits hold them.
pub(super) fn read_soup(path: &Path) -> Result<(Soup, FileFormat), MeshError> {
    let format = FileFormat::of(path).ok_or_else(|| {
        let remedy = format!("use a file that ends in {}", FileFormat::endings());
        Problem::new("the file's ending names no known mesh format", remedy).in_file(path)
    })?;
    let parse = match format {
        FileFormat::Obj => obj::parse,
        FileFormat::Ply => ply::parse,
        FileFormat::Off => off::parse,
        FileFormat::Stl => stl::parse,
        FileFormat::Fold => fold::parse,
        FileFormat::Npz => arrays::parse_npz,
        FileFormat::Npy => arrays::parse_npy,
    };
    let bytes = read_bytes(path)?;
    let soup = content::check(&bytes, format).and_then(|()| parse(&bytes));
    let soup = soup.and_then(|soup| in_range(soup, format)).map_err(|problem| problem.in_file(path))?;
    Ok((soup, format))
}

/// What a file says, if 32 bits can count it and no vertex is too far away.
pub(super) fn in_range(soup: Soup, format: FileFormat) -> Result<Soup, Problem> {
    check_size(soup.vertex_count, soup.triangles.len()).map_err(|error| Problem::of_size(&error))?;
    if let Some((index, place)) = soup.positions.as_deref().and_then(first_out_of_reach) {
        let counted_from = format.counts_from();
        let number = index + counted_from as usize;
        let reason = format!("vertex {number} (counted from {counted_from}) is at {place:?}, which is too far away");
        let remedy = format!("coordinates may be at most {LARGEST_COORDINATE:e}; use another unit");
        return Err(Problem::new(reason, remedy));
    }
    Ok(soup)
}
