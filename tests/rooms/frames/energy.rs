//! Energies of frames: every term's gradient against finite differences, and what they measure.

use crate::support::{Random, random_metric, surface};
use glam::DQuat;
use immerse::frames::{Gradient, Shell, crease_energy, crease_gradient, energy, gradient, strains};
use immerse::immersion::{bending_angles, rimless_frames, spin_of_immersion};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::spin::{Homology, SpinStructure};

/// Compares with central differences in random directions of all frames at once, and of single components.
fn check(name: &str, frames: &[DQuat], value: impl Fn(&[DQuat]) -> f64, gradient: &Gradient, random: &mut Random) {
    for _ in 0..10 {
        let direction: Vec<DQuat> = frames.iter().map(|_| random.frame()).collect();
        let h = 1e-5;
        let at = |t: f64| {
            let moved: Vec<DQuat> = frames.iter().zip(&direction).map(|(q, d)| *q + *d * t).collect();
            value(&moved)
        };
        // Fourth-order central difference.
        let numeric = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let exact: f64 = (0..frames.len()).map(|f| (gradient.linear[f] + gradient.curved[f]).dot(direction[f])).sum();
        let scale: f64 =
            (0..frames.len()).map(|f| (gradient.linear[f] + gradient.curved[f]).length_squared()).sum::<f64>().sqrt();
        assert!(scale > 1e-3, "{name}: the gradient vanishes, nothing is tested");
        assert!((numeric - exact).abs() < 1e-6 * scale, "{name}: {numeric} against {exact}, scale {scale}");
    }
}

#[test]
fn gradients_match_finite_differences() {
    let mut random = Random::new(1);
    for (genus, boundaries) in [(0, 0), (1, 0), (0, 2)] {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let spin = SpinStructure::new(&mesh, &metric, &Homology::new(&mesh, &metric));
        let angles: Vec<f64> = (0..mesh.edge_count()).map(|_| 2.0 * random.unit() - 1.0).collect();
        for bending in [None, Some(&angles[..])] {
            let shell = Shell::new(&mesh, &metric, &spin, bending).expect("a shell");
            // Lengths other than 1 make the length term count.
            let frames: Vec<DQuat> =
                (0..mesh.face_count()).map(|_| random.frame() * (0.7 + 0.6 * random.unit())).collect();
            for k in 0..4 {
                let mut stiffness = [0.0; 4];
                stiffness[k] = 1.0;
                let exact = gradient(&shell, stiffness, &frames);
                check(&format!("term {k}"), &frames, |q| energy(&shell, stiffness, q), &exact, &mut random);
            }
            let exact = crease_gradient(&shell, 1.0, &frames);
            check("crease", &frames, |q| crease_energy(&shell, 1.0, q), &exact, &mut random);
        }
    }
}

/// On the frames of a surface with its own metric there is bending only, 2 sin(α/4) of it (Eq. 15); with the
/// surface's bending angles as targets there is nothing (Sec. 6.3).
#[test]
fn strains_of_a_known_surface() {
    let (mesh, mut positions) = surface(2, 1);
    let mut random = Random::new(2);
    positions.iter_mut().for_each(|p| *p += 0.05 * random.vector());
    let metric = Metric::new(&mesh, lengths_of_positions(&mesh, &positions)).unwrap();
    let spin = spin_of_immersion(&mesh, &metric, &positions).unwrap();
    let flat = Shell::new(&mesh, &metric, &spin, None).expect("a shell");
    let frames = rimless_frames(&mesh, &metric, &flat, &positions);
    let angles = bending_angles(&mesh, &positions);
    for (hinge, [bending, rotation, torsion]) in flat.hinges().iter().zip(strains(&flat, &frames)) {
        assert!((bending - 2.0 * (0.25 * angles[hinge.edge.index()]).sin()).abs() < 1e-12);
        assert!(rotation.abs() < 1e-12 && torsion.abs() < 1e-12);
    }
    let bent = Shell::new(&mesh, &metric, &spin, Some(&angles)).expect("a shell");
    assert!(energy(&bent, [1.0; 4], &frames) < 1e-20);
}
