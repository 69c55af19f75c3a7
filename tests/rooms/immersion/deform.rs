//! Seeded noise: the same everywhere, as large and as wavy as asked for.

use crate::support::Random;
use glam::DVec3;
use immerse::immersion::{noise_along_normals, noise_displacement};
use immerse::mesh::shapes;

fn points(count: usize, size: f64) -> Vec<DVec3> {
    let mut random = Random::new(3);
    (0..count).map(|_| random.vector() * size).collect()
}

fn displacements(points: &[DVec3], amplitude: f64, wavelength: f64, octaves: usize, seed: u64) -> Vec<DVec3> {
    let moved = noise_displacement(points, amplitude, wavelength, octaves, seed);
    moved.iter().zip(points).map(|(a, b)| *a - *b).collect()
}

fn root_mean_square(vectors: &[DVec3]) -> f64 {
    (vectors.iter().map(|v| v.length_squared()).sum::<f64>() / vectors.len() as f64).sqrt()
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let points = points(5000, 4.0);
    let noise = noise_displacement(&points, 0.1, 0.5, 3, 7);
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    assert!(alone.install(|| noise_displacement(&points, 0.1, 0.5, 3, 7)) == noise);
    // A point does not know of the others.
    let some: Vec<DVec3> = points.iter().step_by(7).copied().collect();
    let some_noise: Vec<DVec3> = noise.iter().step_by(7).copied().collect();
    assert!(noise_displacement(&some, 0.1, 0.5, 3, 7) == some_noise);
    let other = noise_displacement(&points, 0.1, 0.5, 3, 8);
    let distance = other.iter().zip(&noise).map(|(a, b)| a.distance(*b)).sum::<f64>() / points.len() as f64;
    assert!(distance > 0.05, "{distance}");
}

/// Over many wavelengths: the root mean square of one octave is the amplitude, of octaves with halved amplitudes
/// √(1 + 1/4 + 1/16) of it, the same in every direction.
#[test]
fn amplitude_is_root_mean_square() {
    let points = points(20_000, 50.0);
    for seed in 0..3 {
        for (octaves, factor) in [(0, 0.0f64), (1, 1.0), (2, 1.25), (3, 1.3125)] {
            let noise = displacements(&points, 0.3, 1.0, octaves, seed);
            let expected = 0.3 * factor.sqrt();
            assert!((root_mean_square(&noise) - expected).abs() <= 0.02 * expected, "{}", root_mean_square(&noise));
            assert!(noise.iter().all(|v| v.length() <= 16.0 * 0.3));
            let far = noise.iter().filter(|v| v.length() > 4.0 * 0.3).count();
            assert!(far <= points.len() / 100, "{far}");
            let mean = noise.iter().sum::<DVec3>() / points.len() as f64;
            assert!(mean.length() <= 0.03 * expected, "{mean}");
            for axis in 0..3 {
                let part: Vec<DVec3> = noise.iter().map(|v| DVec3::X * v[axis]).collect();
                let share = root_mean_square(&part).powi(2) * 3.0;
                assert!(octaves == 0 || (0.6..1.4).contains(&(share / expected.powi(2))), "{share}");
            }
        }
    }
}

/// A wave of length L has derivative 2π/L times its own size: finite differences in any direction measure it.
#[test]
fn wavelength_is_the_length_of_waves() {
    let points = points(20_000, 50.0);
    for wavelength in [0.5, 2.0] {
        let noise = displacements(&points, 1.0, wavelength, 1, 1);
        let step = 1e-4 * wavelength;
        // Over all directions the mean square derivative is that of the three axes together.
        let slope: f64 = DVec3::AXES
            .iter()
            .map(|axis| {
                let shifted: Vec<DVec3> = points.iter().map(|p| *p + *axis * step).collect();
                let there = displacements(&shifted, 1.0, wavelength, 1, 1);
                let change: Vec<DVec3> = there.iter().zip(&noise).map(|(a, b)| (*a - *b) / step).collect();
                root_mean_square(&change).powi(2)
            })
            .sum::<f64>()
            .sqrt();
        let found = std::f64::consts::TAU * root_mean_square(&noise) / slope;
        assert!((found / wavelength - 1.0).abs() < 0.01, "{found} instead of {wavelength}");
    }
}

#[test]
fn noise_along_normals_moves_along_normals() {
    let sphere = shapes::sphere(1.0, 20).expect("a sphere");
    let positions = sphere.positions.expect("positions");
    let moved = noise_along_normals(&sphere.mesh, &positions, 0.05, 0.4, 2, 1);
    let mut sum = 0.0;
    for (p, q) in positions.iter().zip(&moved) {
        let shift = *q - *p;
        assert!(shift.cross(*p).length() <= 0.02 * shift.length() + 1e-12, "{shift} at {p}");
        sum += shift.length_squared();
    }
    let size = (sum / moved.len() as f64).sqrt();
    assert!((0.04..0.075).contains(&size), "{size}");
}
