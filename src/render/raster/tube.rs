//! Lines as thin tubes: round segments of a given width in pixels that take part in the depth test.

use glam::{DVec3, Vec2, Vec3A};

use crate::render::{Camera, Output};

/// A line segment on the picture with round ends.
#[derive(Clone, Debug)]
pub struct ScreenTube {
    from: Vec2,
    along: Vec2,
    inverse_length_squared: f32,
    depths: [f64; 2],
    radius: f32,
    /// Factor and summand that lift a depth by one pixel.
    lift: (f64, f64),
    /// What it is drawn as.
    pub stroke: Stroke,
}

/// Kinds of lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stroke {
    /// A flat ribbon `sink` pixels behind its axis, so that the surface it outlines hides the inner half
    /// and what the mesh has of zigzags there: silhouettes.
    Outline {
        /// How far behind.
        sink: f32,
    },
    /// A tube in flat colour: boundary and self-intersections.
    Line,
    /// A tube that is lit: rims and pinch points.
    Rim,
    /// The same in another colour: pins.
    Pin,
}

impl ScreenTube {
    /// A tube of `radius` pixels between two points in pixels and depth.
    pub fn new(ends: [DVec3; 2], radius: f32, stroke: Stroke, camera: &Camera, output: &Output) -> Self {
        let [from, to] = ends.map(|end| Vec2::new(end.x as f32, end.y as f32));
        let along = to - from;
        let inverse_length_squared = if along.length_squared() > 1e-12 { 1.0 / along.length_squared() } else { 0.0 };
        Self {
            from,
            along,
            inverse_length_squared,
            depths: ends.map(|end| end.z),
            radius,
            lift: camera.lift_per_pixel(output),
            stroke,
        }
    }

    /// First and last pixel that it may touch, in x and y.
    pub fn pixels(&self) -> [[i32; 2]; 2] {
        let [low, high] = self.bounds();
        [0, 1].map(|axis| [low[axis].floor() as i32, high[axis].floor() as i32])
    }

    /// Lower and upper corner in pixels.
    fn bounds(&self) -> [[f32; 2]; 2] {
        let to = self.from + self.along;
        [(self.from.min(to) - self.radius).to_array(), (self.from.max(to) + self.radius).to_array()]
    }

    /// Whether any of it can be in the picture.
    pub fn is_near(&self, output: &Output) -> bool {
        let [low, high] = self.bounds();
        let [x, y, width, height] = output.window().map(|value| value as f32);
        let (start, size) = ([x, y], [width, height]);
        (0..2).all(|axis| high[axis] >= start[axis] - 1.0 && low[axis] <= start[axis] + size[axis] + 1.0)
    }

    /// Part of the way along the axis, and the offset from there in radii.
    fn nearest(&self, at: Vec2) -> (f32, Vec2) {
        let part = ((at - self.from).dot(self.along) * self.inverse_length_squared).clamp(0.0, 1.0);
        (part, (at - self.from - self.along * part) / self.radius)
    }

    /// Depth at a place in pixels, if the tube covers it.
    pub fn depth_at(&self, at: [f32; 2]) -> Option<f32> {
        let (part, offset) = self.nearest(Vec2::from(at));
        let height_squared = 1.0 - offset.length_squared();
        if height_squared < 0.0 {
            return None;
        }
        let depth = self.depths[0] + (self.depths[1] - self.depths[0]) * f64::from(part);
        let height = f64::from(match self.stroke {
            Stroke::Outline { sink } => -sink,
            Stroke::Line | Stroke::Rim | Stroke::Pin => self.radius * height_squared.sqrt(),
        });
        Some((depth * (1.0 + self.lift.0 * height) + self.lift.1 * height) as f32)
    }

    /// Normal in view space at a place, as if the tube lay in the picture plane and went on beyond its
    /// ends, so that joints do not show.
    pub fn normal_at(&self, at: [f32; 2]) -> Vec3A {
        let offset = (Vec2::from(at) - self.from) / self.radius;
        let offset = offset - self.along * (offset.dot(self.along) * self.inverse_length_squared);
        let height = (1.0 - offset.length_squared()).max(0.0).sqrt();
        Vec3A::new(offset.x, -offset.y, height).normalize_or(Vec3A::Z)
    }
}
