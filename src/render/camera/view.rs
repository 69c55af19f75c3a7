//! What is asked of a camera before there is a surface.

use glam::DVec3;

use crate::{
    render::{RenderError, ViewElement},
    timeline::{Ease, Extrapolation, Keyframes},
};

/// From where and how a film is looked at. What is left open is chosen so that it suits the surface.
///
/// Directions are unit vectors, and every number is finite and in its range, because the constructors refuse others.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    direction: Option<DVec3>,
    up: Option<DVec3>,
    field_of_view: f64,
    fill: f64,
    target: Option<DVec3>,
    turntable: f64,
    keys: Option<Keyframes<ViewKey>>,
}

/// A place of the eye at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewKey {
    /// When it is there, in the units of the clock.
    pub time: f64,
    /// How far it has gone round the upward direction, in radians.
    pub orbit: f64,
    /// How far it has risen from there, in radians.
    pub rise: f64,
    /// Factor on its distance (perspective) or on the height of the picture (orthographic), above 0.
    pub dolly: f64,
    /// What is in the middle of the picture then; left out, what is there without keys.
    pub target: Option<DVec3>,
}

impl Default for View {
    fn default() -> Self {
        Self {
            direction: None,
            up: None,
            field_of_view: 30_f64.to_radians(),
            fill: 0.85,
            target: None,
            turntable: 0.0,
            keys: None,
        }
    }
}

impl View {
    /// The widest field of view in degrees. Wider ones show little more than their own distortion.
    pub const WIDEST_DEGREES: f64 = 150.0;
    /// Least and greatest share of the picture that a surface can fill.
    pub const FILLS: [f64; 2] = [0.05, 1.0];

    /// The same view from this direction, which points from the surface to the eye and may have any length.
    ///
    /// # Errors
    /// [`RenderError::NoDirection`] if it is zero or not finite, [`RenderError::UpAlongView`] if it is parallel to the
    /// upward direction.
    pub fn with_direction(self, direction: DVec3) -> Result<Self, RenderError> {
        Self { direction: Some(unit(ViewElement::Direction, direction)?), ..self }.upright()
    }

    /// The same view with this direction upward in the picture. It may have any length.
    ///
    /// # Errors
    /// [`RenderError::NoDirection`] if it is zero or not finite, [`RenderError::UpAlongView`] if it is parallel to the
    /// direction of view.
    pub fn with_up(self, up: DVec3) -> Result<Self, RenderError> {
        Self { up: Some(unit(ViewElement::Up, up)?), ..self }.upright()
    }

    /// The same view with a vertical field of view in radians. A field of view of 0 is orthographic.
    ///
    /// # Errors
    /// [`RenderError::ViewRange`] if it is negative or wider than [`View::WIDEST_DEGREES`].
    pub fn with_field_of_view(self, field_of_view: f64) -> Result<Self, RenderError> {
        Ok(Self { field_of_view: angle_of_view(field_of_view, 0.0)?, ..self })
    }

    /// The same view of a surface that fills this share of the picture.
    ///
    /// # Errors
    /// [`RenderError::ViewRange`] if it is not in [`View::FILLS`].
    pub fn with_fill(self, fill: f64) -> Result<Self, RenderError> {
        Ok(Self { fill: in_range(ViewElement::Fill, fill, Self::FILLS)?, ..self })
    }

    /// The same view with this point of the world in the middle of the picture.
    ///
    /// # Errors
    /// [`RenderError::ViewNotFinite`]
    pub fn with_target(self, target: DVec3) -> Result<Self, RenderError> {
        let is_finite = target.is_finite();
        finite(ViewElement::Target, is_finite).map(|()| Self { target: Some(target), ..self })
    }

    /// The same view from a turntable that goes on by this angle, in radians, from the first frame to one past the last.
    ///
    /// # Errors
    /// [`RenderError::ViewNotFinite`]
    pub fn with_turntable(self, angle: f64) -> Result<Self, RenderError> {
        finite(ViewElement::Turntable, angle.is_finite()).map(|()| Self { turntable: angle, ..self })
    }

    /// The same view with an eye that goes from key to key, the times of which grow.
    ///
    /// # Errors
    /// [`RenderError::ViewNotFinite`] and [`RenderError::ViewRange`] for the numbers of a key,
    /// [`RenderError::ViewKeyOrder`] if times do not grow.
    pub fn with_keys(self, keys: Vec<ViewKey>, ease: Ease) -> Result<Self, RenderError> {
        for (index, key) in keys.iter().enumerate() {
            let numbers = [key.time, key.orbit, key.rise, key.dolly];
            let is_finite = numbers.iter().all(|number| number.is_finite()) && key.target.is_none_or(DVec3::is_finite);
            finite(ViewElement::Key(index), is_finite)?;
            in_range(ViewElement::Key(index), key.dolly, [f64::MIN_POSITIVE, f64::MAX])?;
        }
        let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
        if let Some(&[earlier, later]) = times.array_windows().find(|[earlier, later]| later <= earlier) {
            return Err(RenderError::ViewKeyOrder { earlier, later });
        }
        // Finite times that grow are always keyframes, except that none at all are not.
        Ok(Self { keys: Keyframes::new(times, keys, ease, Extrapolation::Hold).ok(), ..self })
    }

    /// The same view at rest: without a turntable and without keys.
    pub fn still(&self) -> Self {
        Self { turntable: 0.0, keys: None, ..self.clone() }
    }

    /// Unit vector from the surface to the eye, if it is not left open.
    pub fn direction(&self) -> Option<DVec3> {
        self.direction
    }

    /// Unit vector upward in the picture, if it is not left open.
    pub fn up(&self) -> Option<DVec3> {
        self.up
    }

    /// Vertical field of view in radians, 0 for an orthographic view.
    pub fn field_of_view(&self) -> f64 {
        self.field_of_view
    }

    /// Share of the picture that the surface fills.
    pub fn fill(&self) -> f64 {
        self.fill
    }

    /// What is in the middle of the picture, if it is not left open.
    pub fn target(&self) -> Option<DVec3> {
        self.target
    }

    /// Radians that the turntable goes on by over the whole film.
    pub fn turntable(&self) -> f64 {
        self.turntable
    }

    /// The keys that the eye goes through, if there are any.
    pub fn keys(&self) -> Option<&Keyframes<ViewKey>> {
        self.keys.as_ref()
    }

    fn upright(self) -> Result<Self, RenderError> {
        if let (Some(up), Some(toward_eye)) = (self.up, self.direction) {
            check_upright(up, toward_eye)?;
        }
        Ok(self)
    }
}

/// A vector with length 1.
pub fn unit(element: ViewElement, vector: DVec3) -> Result<DVec3, RenderError> {
    vector.try_normalize().ok_or(RenderError::NoDirection { element, vector })
}

/// That `up` can be upward in a picture that is seen from a direction; both are unit vectors.
pub fn check_upright(up: DVec3, toward_eye: DVec3) -> Result<(), RenderError> {
    if up.cross(toward_eye).length() > 1e-6 { Ok(()) } else { Err(RenderError::UpAlongView { up }) }
}

/// A field of view in radians that is at least `least` degrees wide.
pub fn angle_of_view(angle: f64, least: f64) -> Result<f64, RenderError> {
    if (least.to_radians()..=View::WIDEST_DEGREES.to_radians()).contains(&angle) {
        return Ok(angle);
    }
    let (element, range) = (ViewElement::FieldOfView, [least, View::WIDEST_DEGREES]);
    Err(RenderError::ViewRange { element, value: angle.to_degrees(), range })
}

fn in_range(element: ViewElement, value: f64, range: [f64; 2]) -> Result<f64, RenderError> {
    if (range[0]..=range[1]).contains(&value) {
        return Ok(value);
    }
    Err(RenderError::ViewRange { element, value, range })
}

fn finite(element: ViewElement, is_finite: bool) -> Result<(), RenderError> {
    if is_finite { Ok(()) } else { Err(RenderError::ViewNotFinite { element }) }
}
