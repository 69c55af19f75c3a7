//! Perceptual colour maps.

use glam::Vec3;

use super::color::linear_from_srgb;
use crate::scene::ColorMapName;

/// Colours over the interval from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorMap(pub ColorMapName);

impl ColorMap {
    /// Linear light at a place from 0 to 1; places outside are those of the nearer end.
    pub fn at(self, place: f32) -> Vec3 {
        let place = f64::from(if place.is_nan() { 0.0 } else { place.clamp(0.0, 1.0) });
        let gradient = match self.0 {
            ColorMapName::Viridis => colorous::VIRIDIS,
            ColorMapName::Inferno => colorous::INFERNO,
            ColorMapName::Cividis => colorous::CIVIDIS,
            ColorMapName::Diverging => colorous::RED_BLUE,
            ColorMapName::Cyclic => colorous::SINEBOW,
            ColorMapName::Categorical => colorous::VIRIDIS,
        };
        let color = gradient.eval_continuous(place);
        linear_from_srgb([color.r, color.g, color.b])
    }
}
