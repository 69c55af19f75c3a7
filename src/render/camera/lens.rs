//! How an eye maps directions to a picture.

/// How rays of sight leave the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Tangent of half the vertical field of view.
    Perspective { tangent: f64 },
    /// Half the height of the picture in world units.
    Orthographic { half_height: f64 },
}

impl Lens {
    /// Half the height of what is seen at a distance from the eye.
    pub fn half_height_at(self, distance: f64) -> f64 {
        match self {
            Lens::Perspective { tangent } => tangent * distance,
            Lens::Orthographic { half_height } => half_height,
        }
    }
}
