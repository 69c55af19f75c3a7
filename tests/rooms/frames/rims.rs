//! Rims that are only signs go by signs, and patches around others get frames without them.

use crate::support::{Random, surface};
use glam::DQuat;
use immerse::frames::{Shell, flip_along_rims, random_frames, smooth_patch};
use immerse::immersion::{rimless_frames, rims, spin_of_immersion};
use immerse::mesh::{EdgeId, Mesh, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use std::collections::BTreeSet;

/// Shell, edge lengths and frames without rims of a surface at its positions.
fn immersed(mesh: &Mesh, positions: &[glam::DVec3]) -> (Shell, Vec<f64>, Vec<DQuat>) {
    let metric = Metric::new(mesh, lengths_of_positions(mesh, positions)).expect("a metric");
    let spin = spin_of_immersion(mesh, &metric, positions).expect("an immersion");
    let shell = Shell::new(mesh, &metric, &spin, None).expect("a shell");
    let frames = rimless_frames(mesh, &metric, &shell, positions);
    assert!(rims(&shell, &frames).is_empty());
    (shell, metric.edge_lengths().to_vec(), frames)
}

/// The first `count` faces that a walk from a face comes to.
fn region(mesh: &Mesh, from: usize, count: usize) -> BTreeSet<usize> {
    let mut seen = BTreeSet::from([from]);
    let mut queue = std::collections::VecDeque::from([from]);
    while let Some(face) = queue.pop_front() {
        for k in 0..3 {
            let beyond = mesh.twin(immerse::mesh::HalfedgeId::new(3 * face + k)).map(|twin| twin.face().index());
            if let Some(next) = beyond.filter(|next| seen.len() < count && !seen.contains(next)) {
                seen.insert(next);
                queue.push_back(next);
            }
        }
    }
    seen
}

#[test]
fn outlines_of_regions_with_other_signs_go() {
    for (genus, boundaries) in [(0, 0), (1, 0), (2, 0), (0, 2)] {
        let (mesh, positions) = surface(genus, boundaries);
        let (shell, lengths, whole) = immersed(&mesh, &positions);
        // One region within another, and one aside.
        let faces = mesh.face_count();
        let mut frames = whole.clone();
        for region in [region(&mesh, 0, faces / 3), region(&mesh, 0, faces / 8), region(&mesh, faces - 1, faces / 9)] {
            region.into_iter().for_each(|face| frames[face] = -frames[face]);
        }
        let outlines = rims(&shell, &frames);
        assert!(outlines.len() > 10, "{}", outlines.len());
        let turned = flip_along_rims(&shell, &lengths, &mut frames);
        assert!(turned > 0 && rims(&shell, &frames).is_empty(), "genus {genus}: {:?}", rims(&shell, &frames));
        let same = frames.iter().zip(&whole).all(|(a, b)| *a == *b);
        let opposite = frames.iter().zip(&whole).all(|(a, b)| *a == -*b);
        assert!(same || opposite, "genus {genus}");
        assert_eq!(flip_along_rims(&shell, &lengths, &mut frames), 0);
    }
}

/// Signs bring no rims, and end no more than those between regions: what random frames have goes down, and no rim is new.
#[test]
fn signs_make_no_rims() {
    let (mesh, positions) = surface(2, 0);
    let (shell, lengths, _) = immersed(&mesh, &positions);
    for seed in 0..5 {
        let mut frames = random_frames(mesh.face_count(), seed);
        let before: BTreeSet<EdgeId> = rims(&shell, &frames).into_iter().collect();
        flip_along_rims(&shell, &lengths, &mut frames);
        let after: BTreeSet<EdgeId> = rims(&shell, &frames).into_iter().collect();
        assert!(after.is_subset(&before) && after.len() < before.len(), "{} of {}", after.len(), before.len());
    }
}

/// Frames of a patch that are lost come back from those around it, and no other frame changes.
#[test]
fn patches_are_as_smooth_as_what_is_around_them() {
    let surface = shapes::torus(1.0, 0.4, 40, 20).expect("a torus");
    let positions = surface.positions.as_deref().expect("positions");
    let mesh = &surface.mesh;
    let (shell, _, whole) = immersed(mesh, positions);
    let mut frames = whole.clone();
    let lost = region(mesh, 700, 12);
    let mut random = Random::new(3);
    lost.iter().for_each(|&face| frames[face] = random.frame());
    let broken = rims(&shell, &frames);
    assert!(broken.len() > 3, "{}", broken.len());
    let before = frames.clone();
    smooth_patch(&shell, &broken, 4, &mut frames);
    assert!(rims(&shell, &frames).is_empty());
    let changed = (0..frames.len()).filter(|&face| frames[face] != before[face]).count();
    assert!(changed >= 12 && changed < mesh.face_count() / 4, "{changed}");
    for &face in &lost {
        let turn = 2.0 * frames[face].dot(whole[face]).abs().min(1.0).acos().to_degrees();
        assert!(turn < 20.0, "face {face}: {turn} degrees");
    }
    let mut untouched = whole.clone();
    smooth_patch(&shell, &[], 4, &mut untouched);
    assert_eq!(untouched, whole);
}
