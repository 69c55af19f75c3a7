//! Displacements of positions: where crumpling and deflating start.

use crate::mesh::Mesh;
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Positions displaced by smooth noise, the same for the same seed everywhere.
///
/// The noise is a field in space: isotropic, without end and without a grid, and independent of the mesh, so that a
/// finer mesh of the same surface is crumpled in the same way. Its first octave has waves of length `wavelength`; every
/// further one has waves half as long and moves points half as far. `amplitude`, in the units of the positions, is the
/// root mean square displacement of the first octave, over all of space and in all directions together; no point moves
/// by more than 16 times that, and hardly one by more than 4 times. Without octaves nothing moves.
///
/// Where the noise is steep (`amplitude` above `wavelength / 8` or so) surfaces fold over and are pinched;
/// [`noise_along_normals`] goes much further.
pub fn noise_displacement(
    positions: &[DVec3],
    amplitude: f64,
    wavelength: f64,
    octaves: usize,
    seed: u64,
) -> Vec<DVec3> {
    let waves = waves(amplitude, wavelength, octaves, seed);
    let displaced = |p: &DVec3| *p + waves.iter().map(|wave| wave.direction * wave.height(*p)).sum::<DVec3>();
    positions.par_iter().map(displaced).collect()
}

/// As [`noise_displacement`], but along the normals of the surface only: bumps and dents.
pub fn noise_along_normals(
    mesh: &Mesh,
    positions: &[DVec3],
    amplitude: f64,
    wavelength: f64,
    octaves: usize,
    seed: u64,
) -> Vec<DVec3> {
    let waves = waves(amplitude, wavelength, octaves, seed);
    let displaced = |(p, n): (&DVec3, DVec3)| *p + n * waves.iter().map(|wave| wave.height(*p)).sum::<f64>();
    positions.par_iter().zip(vertex_normals(mesh, positions)).map(displaced).collect()
}

/// Unit normals at vertices, by face area; zero where there is none.
fn vertex_normals(mesh: &Mesh, positions: &[DVec3]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; positions.len()];
    for f in mesh.faces() {
        let corners = mesh.corners(f);
        let [a, b, c] = corners.map(|v| positions[v.index()]);
        let normal = (b - a).cross(c - a);
        corners.iter().for_each(|v| normals[v.index()] += normal);
    }
    normals.into_iter().map(DVec3::normalize_or_zero).collect()
}

/// A plane wave.
struct Wave {
    /// Direction of travel, times 2π over the wavelength.
    vector: DVec3,
    phase: f64,
    height: f64,
    /// Where points are moved.
    direction: DVec3,
}

impl Wave {
    fn height(&self, p: DVec3) -> f64 {
        self.height * libm::sin(self.vector.dot(p) + self.phase)
    }
}

/// So many waves make up an octave: enough for them to have no visible order.
const WAVES: usize = 32;

fn waves(amplitude: f64, wavelength: f64, octaves: usize, seed: u64) -> Vec<Wave> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut unit = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    // A wave has half of its square as mean.
    let of_one = amplitude * (2.0 / WAVES as f64).sqrt();
    let scales = std::iter::successors(Some(1.0), |scale| Some(0.5 * scale)).take(octaves);
    scales
        .flat_map(|scale| std::iter::repeat_n(scale, WAVES))
        .map(|scale| Wave {
            vector: direction(&mut unit) * (TAU / (wavelength * scale)),
            phase: TAU * unit(),
            height: of_one * scale,
            direction: direction(&mut unit),
        })
        .collect()
}

/// Uniform on the unit sphere (Archimedes).
fn direction(unit: &mut impl FnMut() -> f64) -> DVec3 {
    let height = 2.0 * unit() - 1.0;
    let radius = (1.0 - height * height).sqrt();
    let angle = TAU * unit();
    DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), height)
}
