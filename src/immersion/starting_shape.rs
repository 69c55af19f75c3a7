//! The positions that frames start from, deformed.

use super::deform::{noise_along_normals, noise_displacement};
use crate::advice::Advice;
use crate::mesh::{LARGEST_COORDINATE, Mesh, VertexId, is_in_reach};
use crate::timeline::PointFormula;
use glam::DVec3;

/// Where a formula moves a vertex to no place.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("vertex {vertex} would be moved to {place:?}; {}", self.remedy())]
pub struct LostVertex {
    /// Its number in the mesh file.
    pub vertex: usize,
    /// Not finite, or too far away to compute with.
    pub place: [f64; 3],
}

impl Advice for LostVertex {
    fn remedy(&self) -> String {
        format!("correct the formula there; coordinates must be finite and at most {LARGEST_COORDINATE:e}")
    }
}

/// Smooth random displacement of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Root mean square displacement of the first layer.
    pub amplitude: f64,
    /// Length of the waves of the first layer.
    pub wavelength: f64,
    /// Number of layers, each of half the wavelength and half the amplitude of the one before.
    pub octaves: usize,
    /// Which of the many.
    pub seed: u64,
    /// Whether vertices move along their normals only.
    pub along_normals: bool,
}

impl Noise {
    /// Positions with this noise, |V|.
    pub fn displaced(&self, mesh: &Mesh, positions: &[DVec3]) -> Vec<DVec3> {
        let Noise { amplitude, wavelength, octaves, seed, along_normals } = *self;
        if along_normals {
            noise_along_normals(mesh, positions, amplitude, wavelength, octaves, seed)
        } else {
            noise_displacement(positions, amplitude, wavelength, octaves, seed)
        }
    }
}

/// Positions in a mirror, |V|: x changes its sign.
pub fn mirrored(positions: &[DVec3]) -> Vec<DVec3> {
    positions.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect()
}

/// Positions moved by a formula at a time, |V|.
///
/// # Errors
/// [`LostVertex`] where it has no value.
pub fn moved(mesh: &Mesh, positions: &[DVec3], formula: &PointFormula, time: f64) -> Result<Vec<DVec3>, LostVertex> {
    let formula = formula.at(time);
    let moved: Vec<DVec3> = positions.iter().map(|&place| formula.point(place)).collect();
    match moved.iter().position(|place| !is_in_reach(*place)) {
        None => Ok(moved),
        Some(v) => Err(LostVertex { vertex: mesh.file_vertex(VertexId::new(v)), place: moved[v].to_array() }),
    }
}
