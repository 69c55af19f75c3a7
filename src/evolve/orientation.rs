//! Which of two mirror images: lengths cannot tell them apart, and random frames end in either.

use super::relaxation::Relaxation;
use crate::immersion::{RigidMotion, enclosed_volume};
use crate::scene::Orientation;
use glam::{DQuat, DVec3};

impl Relaxation {
    /// Takes the mirror image of a component that has come out the wrong way round: not like the mesh's positions,
    /// where their lengths are asked for, or with its back outside. A surface that neither has such positions nor
    /// encloses a volume stays as it came, and so does one that its start, its target bending angles or its pins
    /// hold in place.
    pub(super) fn turn_the_right_side_out(&mut self) {
        let is_from_nowhere = self.shape.is_none();
        let is_bent = self.angles.as_ref().is_some_and(|angles| angles.iter().any(|angle| *angle != 0.0));
        if self.orientation == Orientation::AsItComes || !is_from_nowhere || is_bent {
            return;
        }
        let Some(normal) = self.plane_of_pins() else { return };
        let positions = self.integrate();
        let is_wrong = match &self.original {
            Some(original) => {
                let areas = self.metric.vertex_areas(&self.component.mesh);
                let mirrored: Vec<DVec3> = positions.iter().map(|p| -*p).collect();
                distance(original, &mirrored, &areas) < WRONG * distance(original, &positions, &areas)
            }
            None => enclosed_volume(&self.component.mesh, &positions).is_some_and(|volume| volume < 0.0),
        };
        if is_wrong {
            let [i, normal] = [DVec3::X, normal].map(|v| DQuat::from_vec4(v.extend(0.0)));
            // i λ has the same normals, and opposite tangents: it is the frame of −f, in the same spin structure,
            // since i commutes with τ. A half turn makes the reflection in a point one in a plane.
            self.face_frames.iter_mut().for_each(|frame| *frame = i * *frame * normal);
            self.cursor.mirrored = true;
        }
    }

    /// Normal of a plane through all pins; `None` where there is no such plane whichever way the surface lies.
    fn plane_of_pins(&self) -> Option<DVec3> {
        let Some((_, first)) = self.places.first() else { return Some(DVec3::X) };
        let spokes = || self.places.iter().map(|(_, place)| *place - *first);
        let longest = spokes().max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let Some(along) = longest.try_normalize() else { return Some(DVec3::X) };
        let is_on_line = |spoke: DVec3| spoke.cross(along).length() <= 1e-9 * longest.length();
        spokes().all(is_on_line).then(|| along.any_orthonormal_vector())
    }
}

/// How much nearer a mirror image has to be: for a flat surface both are the same.
const WRONG: f64 = 0.999;

/// Mean square distance of positions from others, over rigid motions.
fn distance(original: &[DVec3], positions: &[DVec3], weights: &[f64]) -> f64 {
    let motion = RigidMotion::onto(original, positions, weights);
    let squares = positions.iter().zip(original).zip(weights);
    squares.map(|((p, q), w)| w * motion.point(*p).distance_squared(*q)).sum()
}
