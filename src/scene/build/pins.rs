//! `[[pin]]` as point constraints.

use std::sync::Arc;

use glam::DVec3;

use crate::immersion::{PinError, PinGroup, Pins};
use crate::mesh::{Surface, VertexId, select_vertices};
use crate::scene::{MotionSection, PinSection, Scene, SceneError};
use crate::timeline::{Extrapolation, Keyframes, Parameters};

impl Scene {
    /// The pins of a surface.
    ///
    /// # Errors
    /// At the pin that is at fault.
    pub fn pins(&self, surface: &Surface, parameters: &Arc<Parameters>) -> Result<Pins, SceneError> {
        let group = |(k, section)| self.pin_group(&format!("pin[{k}]"), section, surface, parameters);
        let groups = self.pins.iter().enumerate().map(group).collect::<Result<_, _>>()?;
        Ok(Pins::new(&surface.mesh, groups))
    }

    fn pin_group(
        &self,
        key: &str,
        section: &PinSection,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<PinGroup, SceneError> {
        let vertices = select_vertices(&section.vertices, &surface.mesh, surface.places())
            .map_err(|error| self.complain_about(key, &error))?;
        let complain = |error: PinError| self.complain_about(key, &error);
        let places = match (section.positions.as_slice(), &surface.positions) {
            ([], None) => return Err(complain(PinError::NoPositions)),
            ([], Some(positions)) => vertices.iter().map(|v: &VertexId| positions[v.index()]).collect(),
            (given, _) => given.iter().copied().map(DVec3::from_array).collect(),
        };
        let mut group = PinGroup::new(vertices, places).map_err(complain)?;
        if let Some(texts) = &section.formula {
            group = group.led_by(self.point_formula(key, texts, parameters)?);
        }
        if let Some(MotionSection { times, translations, rotations, ease }) = &section.motion {
            let keyframes = |values: &[[f64; 3]]| {
                let values = values.iter().copied().map(DVec3::from_array).collect();
                Keyframes::new(times.clone(), values, *ease, Extrapolation::Hold)
                    .map_err(|error| self.complain_about(key, &error))
            };
            group = group.moved_by(keyframes(translations)?, keyframes(rotations)?);
        }
        Ok(group)
    }
}
