//! The positions that frames start from: the mesh, its mirror image or a file, deformed as the scene says.

use super::{noise_along_normals, noise_displacement};
use crate::mesh::{MeshError, Surface, VertexId, read_positions};
use crate::scene::{AtKey, NoiseSection, StartFrom, StartSection};
use crate::timeline::{Parameters, PointFormula, TimelineError};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// Why there is nothing to start from.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum StartError {
    #[error(
        "the frames are to start from positions, but the mesh has none; write `random = 0`, name a `file`, or use a mesh that has them"
    )]
    NoPositions,
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error(transparent)]
    Timeline(#[from] TimelineError),
    #[error("vertex {vertex} would be moved to {place:?}; correct the formula there")]
    NotFinite { vertex: usize, place: [f64; 3] },
}

/// Where the surface starts, |V|; `None` where frames come from no positions.
///
/// # Errors
/// [`StartError`] with the key of the scene that is at fault.
pub fn initial_positions(
    section: &StartSection,
    folder: &Path,
    surface: &Surface,
    parameters: &Arc<Parameters>,
    time: f64,
) -> Result<Option<Vec<DVec3>>, AtKey<StartError>> {
    let mesh = &surface.mesh;
    // Coordinates are no shape by themselves.
    let given = if section.formula.is_some() { surface.places() } else { surface.positions.as_deref() };
    let of_mesh = || match given {
        Some(positions) => Ok(positions.to_vec()),
        None => Err(AtKey { key: "start.from".into(), error: StartError::NoPositions }),
    };
    let mut shape = match &section.from {
        StartFrom::Random(_) | StartFrom::Spectral => return Ok(None),
        StartFrom::Mesh => of_mesh()?,
        StartFrom::Mirror => of_mesh()?.into_iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect(),
        StartFrom::File(path) => read_positions(&folder.join(path), mesh).map_err(AtKey::of("start.file"))?,
    };
    if let Some(texts) = &section.formula {
        let formula = PointFormula::parse(texts, parameters).map_err(AtKey::of("start.formula"))?;
        let formula = formula.at(time);
        for (vertex, place) in shape.iter_mut().enumerate() {
            *place = formula.point(*place);
            if !place.is_finite() {
                let vertex = mesh.file_vertex(VertexId::new(vertex));
                let error = StartError::NotFinite { vertex, place: place.to_array() };
                return Err(AtKey { key: "start.formula".into(), error });
            }
        }
    }
    if let Some(noise) = &section.noise {
        let NoiseSection { amplitude, wavelength, octaves, seed, along_normals } = *noise;
        shape = if along_normals {
            noise_along_normals(mesh, &shape, amplitude, wavelength, octaves, seed)
        } else {
            noise_displacement(&shape, amplitude, wavelength, octaves, seed)
        };
    }
    Ok(Some(shape))
}
