//! Directional lights.

use glam::{Vec3, Vec3A};

use crate::render::RenderError;

/// A directional light in view space.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    direction: Vec3A,
    color: Vec3,
    wrap: f32,
    shadow: bool,
}

/// All directional lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights(Vec<Light>);

impl Light {
    /// A light from a direction, which points toward it and may have any length; x is to the right, y up and z toward
    /// the eye. Its colour is linear light times its strength.
    ///
    /// # Errors
    /// [`RenderError::LightDirection`] on a direction without length, [`RenderError::LightColor`] on a colour that is
    /// negative or not finite.
    pub fn new(direction: Vec3, color: Vec3, shadow: bool) -> Result<Self, RenderError> {
        let toward = Vec3A::from(direction).try_normalize().ok_or(RenderError::LightDirection { direction })?;
        if !color.to_array().iter().all(|&part| part >= 0.0 && part.is_finite()) {
            return Err(RenderError::LightColor { color });
        }
        Ok(Self { direction: toward, color, wrap: if shadow { KEY_WRAP } else { FILL_WRAP }, shadow })
    }

    /// Unit vector toward the light; x is to the right, y up and z toward the eye.
    pub fn direction(&self) -> Vec3A {
        self.direction
    }

    /// Linear colour times strength.
    pub fn color(&self) -> Vec3 {
        self.color
    }

    /// How far the light reaches around the terminator, from 0 (hard) to 1.
    pub fn wrap(&self) -> f32 {
        self.wrap
    }

    /// Whether it casts soft shadows.
    pub fn casts_shadow(&self) -> bool {
        self.shadow
    }
}

impl Lights {
    /// These lights and no others; without any, a surface has ambient light only.
    pub fn new(lights: Vec<Light>) -> Self {
        Self(lights)
    }

    /// All of them in order.
    pub fn all(&self) -> &[Light] {
        &self.0
    }
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
