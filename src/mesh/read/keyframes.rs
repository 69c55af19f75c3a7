//! What a file says of a mesh at one moment or at several: a FOLD file has as many as it has frames.

use std::path::Path;

use glam::DVec3;

use super::content;
use super::file::in_range;
use super::format::FileFormat;
use super::formats::fold;
use super::lengths::{angles_of, lengths_of, read_bending_angles, read_lengths};
use super::positions::{positions_of, read_positions};
use super::problem::{Problem, read_bytes};
use super::soup::Soup;
use crate::mesh::{Mesh, MeshError};

/// What a file says of the edges of a mesh at one moment.
#[derive(Clone, Debug, PartialEq)]
pub enum Keyframe<T> {
    /// Numbers that it decrees, one for each edge.
    Decreed(T),
    /// None, but positions that have them; |V|.
    Positions(Vec<DVec3>),
}

/// Reads the lengths that a file says for the edges of a mesh: of a FOLD file those of every frame from the first one that has
/// faces, of any other file one keyframe. A frame inherits from its parent whatever it does not say, as FOLD 1.2 has it.
///
/// # Errors
/// Those of [`read_lengths`] and [`read_positions`], which name the frame, and [`MeshError::File`] for frames in different units.
pub fn read_length_keyframes(path: &Path, mesh: &Mesh) -> Result<Vec<Keyframe<Vec<f64>>>, MeshError> {
    keyframes(path, mesh, read_lengths, lengths_of)
}

/// Reads the bending angles that a file says for the edges of a mesh, in radians, as [`read_bending_angles`] does, and keyframes as
/// [`read_length_keyframes`] does.
///
/// # Errors
/// Those of [`read_bending_angles`] and [`read_positions`], which name the frame, and [`MeshError::File`] for frames in different
/// units.
pub fn read_bending_keyframes(path: &Path, mesh: &Mesh) -> Result<Vec<Keyframe<Vec<Option<f64>>>>, MeshError> {
    keyframes(path, mesh, read_bending_angles, angles_of)
}

fn keyframes<T>(
    path: &Path,
    mesh: &Mesh,
    of_file: fn(&Path, &Mesh) -> Result<Option<T>, MeshError>,
    of_frame: fn(&Soup, &Mesh) -> Result<Option<T>, Problem>,
) -> Result<Vec<Keyframe<T>>, MeshError> {
    if FileFormat::of(path) != Some(FileFormat::Fold) {
        let decreed = of_file(path, mesh)?.map(Keyframe::Decreed);
        return Ok(vec![decreed.map_or_else(|| read_positions(path, mesh).map(Keyframe::Positions), Ok)?]);
    }
    let read = |soup: Soup| {
        let soup = in_range(soup, FileFormat::Fold)?;
        if let Some(decreed) = of_frame(&soup, mesh)? {
            return Ok(Keyframe::Decreed(decreed));
        }
        let positions = positions_of(&soup, mesh)?;
        positions.map(Keyframe::Positions).ok_or_else(|| {
            Problem::new("it has neither what is asked of its edges nor positions", "add `vertices_coords`")
        })
    };
    let bytes = read_bytes(path)?;
    let frames = content::check(&bytes, FileFormat::Fold).and_then(|()| fold::each_frame(&bytes, read));
    frames.map_err(|problem| problem.in_file(path))
}
