//! Directional lights.

use glam::{Vec3, Vec3A};

use super::RenderError;
use crate::scene::LightSection;

/// A directional light in view space.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Unit vector toward the light; x right, y up, z toward the eye.
    pub direction: Vec3A,
    /// Linear colour times strength.
    pub color: Vec3,
    /// How far the light reaches around the terminator, 0 (hard) to 1.
    pub wrap: f32,
    /// Whether it casts soft shadows.
    pub shadow: bool,
}

/// All directional lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights(pub Vec<Light>);

impl Lights {
    /// The lights a scene asks for; none means the studio's.
    ///
    /// # Errors
    /// [`RenderError::Light`] on a direction without length or a colour that is negative or not finite.
    pub fn from_scene(sections: &[LightSection]) -> Result<Self, RenderError> {
        if sections.is_empty() {
            return Ok(Self::default());
        }
        let lights = sections.iter().enumerate().map(|(index, section)| light_from_scene(index + 1, section));
        Ok(Self(lights.collect::<Result<_, _>>()?))
    }
}

fn light_from_scene(index: usize, section: &LightSection) -> Result<Light, RenderError> {
    let direction =
        Vec3A::from_array(section.direction.map(|value| value as f32)).try_normalize().ok_or(RenderError::Light {
            index,
            key: "direction",
            reason: "has no direction",
            remedy: "write a vector toward the light in view space, like [-0.5, 0.6, 0.6]",
        })?;
    if !section.color.iter().all(|&value| value >= 0.0 && value.is_finite()) {
        return Err(RenderError::Light {
            index,
            key: "color",
            reason: "has a negative or non-finite part",
            remedy: "write linear red, green and blue like [0.8, 0.78, 0.74]",
        });
    }
    let color = Vec3::from_array(section.color.map(|value| value as f32));
    Ok(Light { direction, color, wrap: if section.shadow { KEY_WRAP } else { FILL_WRAP }, shadow: section.shadow })
}

const KEY_WRAP: f32 = 0.2;
const FILL_WRAP: f32 = 0.3;

impl Default for Lights {
    /// The studio: a warm key from the upper left with soft shadows, a cool fill from the right, and a faint
    /// warm kicker from below, so that undersides keep their shape.
    fn default() -> Self {
        Self(vec![
            Light {
                direction: Vec3A::new(-0.55, 0.65, 0.55).normalize(),
                color: Vec3::new(1.0, 0.97, 0.92) * 0.80,
                wrap: KEY_WRAP,
                shadow: true,
            },
            Light {
                direction: Vec3A::new(0.85, 0.10, 0.35).normalize(),
                color: Vec3::new(0.80, 0.88, 1.0) * 0.12,
                wrap: FILL_WRAP,
                shadow: false,
            },
            Light {
                direction: Vec3A::new(0.30, -0.80, 0.35).normalize(),
                color: Vec3::new(1.0, 0.90, 0.80) * 0.09,
                wrap: FILL_WRAP,
                shadow: false,
            },
        ])
    }
}
