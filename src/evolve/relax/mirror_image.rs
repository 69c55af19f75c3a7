//! Which of two mirror images: lengths cannot tell them apart, and random frames end in either.

use super::relaxation::Relaxation;
use crate::evolve::program::Orientation;
use crate::immersion::{RigidMotion, enclosed_volume};
use crate::tuning::NEARER_MIRROR_IMAGE;
use glam::{DQuat, DVec3};

impl Relaxation {
    /// Takes the mirror image of a component that has come out the wrong way round: not like the mesh's positions,
    /// where their lengths are asked for, or with its back outside. A surface that neither has such positions nor
    /// encloses a volume stays as it came, and so does one that its start, its target bending angles or its pins
    /// hold in place.
    pub(super) fn turn_the_right_side_out(&mut self) {
        let is_from_nowhere = !self.placement.starts_from_shape();
        let is_bent = self.state.target_angles().is_some_and(|(angles, _)| angles.iter().any(|angle| *angle != 0.0));
        if self.orientation == Orientation::AsItComes || !is_from_nowhere || is_bent {
            return;
        }
        let Some(normal) = self.plane_of_pins() else { return };
        let positions = self.state.integrate();
        let is_wrong = match self.placement.original() {
            Some(original) => {
                let areas = self.state.metric().vertex_areas(self.state.mesh());
                let mirrored: Vec<DVec3> = positions.iter().map(|p| -*p).collect();
                distance(original, &mirrored, &areas) < NEARER_MIRROR_IMAGE * distance(original, &positions, &areas)
            }
            None => enclosed_volume(self.state.mesh(), &positions).is_some_and(|volume| volume < 0.0),
        };
        if is_wrong {
            let [i, normal] = [DVec3::X, normal].map(|v| DQuat::from_vec4(v.extend(0.0)));
            // i λ has the same normals, and opposite tangents: it is the frame of −f, in the same spin structure,
            // since i commutes with τ. A half turn makes the reflection in a point one in a plane.
            self.state.shell_and_frames().1.iter_mut().for_each(|frame| *frame = i * *frame * normal);
            self.cursor.mirrored = true;
        }
    }

    /// Normal of a plane through all pins; `None` where there is no such plane whichever way the surface lies.
    fn plane_of_pins(&self) -> Option<DVec3> {
        let Some((_, first)) = self.state.pins().first() else { return Some(DVec3::X) };
        let spokes = || self.state.pins().iter().map(|(_, place)| *place - *first);
        let longest = spokes().max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let Some(along) = longest.try_normalize() else { return Some(DVec3::X) };
        let is_on_line = |spoke: DVec3| spoke.cross(along).length() <= 1e-9 * longest.length();
        spokes().all(is_on_line).then(|| along.any_orthonormal_vector())
    }
}

/// Mean square distance of positions from others, over rigid motions.
fn distance(original: &[DVec3], positions: &[DVec3], weights: &[f64]) -> f64 {
    let motion = RigidMotion::onto(original, positions, weights);
    let squares = positions.iter().zip(original).zip(weights);
    squares.map(|((p, q), w)| w * motion.point(*p).distance_squared(*q)).sum()
}
