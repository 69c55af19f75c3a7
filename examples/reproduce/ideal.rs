//! Comparison with a surface that is known.

use glam::DVec3;
use immerse::Metric;
use immerse::immersion::{RigidMotion, bending_angles, mirrored};
use immerse::mesh::Mesh;

/// How far positions are from known ones after the best rigid motion.
#[derive(Clone, Copy, Debug)]
pub struct Distance {
    /// Root mean square over the area, as a share of the diameter of the known surface.
    pub mean: f64,
    /// The largest, as a share of it.
    pub max: f64,
}

/// From the known surface, or from its mirror image if that is nearer: lengths cannot tell them apart.
pub fn distance(mesh: &Mesh, metric: &Metric, known: &[DVec3], positions: &[DVec3]) -> Distance {
    let [plain, mirror] = [positions.to_vec(), mirrored(positions)].map(|p| rigid_distance(mesh, metric, known, &p));
    if mirror.mean < plain.mean { mirror } else { plain }
}

fn rigid_distance(mesh: &Mesh, metric: &Metric, known: &[DVec3], positions: &[DVec3]) -> Distance {
    let areas = metric.vertex_areas(mesh);
    let motion = RigidMotion::onto(known, positions, &areas);
    let distances: Vec<f64> = positions.iter().zip(known).map(|(p, q)| motion.point(*p).distance(*q)).collect();
    let squares: f64 = distances.iter().zip(&areas).map(|(d, a)| a * d * d).sum();
    let [low, high] = [DVec3::min, DVec3::max].map(|pick| known.iter().copied().reduce(pick).unwrap_or_default());
    let diameter = (high - low).max_element();
    Distance {
        mean: (squares / areas.iter().sum::<f64>()).sqrt() / diameter,
        max: distances.into_iter().fold(0.0, f64::max) / diameter,
    }
}

/// Bending angles in degrees, positive where hinges are convex seen from the side on which most of them are.
pub fn convexities(mesh: &Mesh, positions: &[DVec3]) -> Vec<f64> {
    let angles: Vec<f64> = bending_angles(mesh, positions).into_iter().map(f64::to_degrees).collect();
    let sign = angles.iter().sum::<f64>().signum();
    angles.into_iter().map(|angle| sign * angle).collect()
}

/// Order of convergence between two resolutions: by which power of the edge length an error falls.
pub fn order([coarse, fine]: [f64; 2], [long, short]: [f64; 2]) -> f64 {
    libm::log(coarse / fine) / libm::log(long / short)
}
