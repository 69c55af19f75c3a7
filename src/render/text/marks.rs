//! Rings around places of space, drawn over a finished picture, so that they are seen whatever stands in front.

use glam::{DVec3, Vec2, Vec3};

use crate::render::{Camera, Look, Output, Picture, stage::Projection};

/// Radius of a ring, half the width of its line, and radius of the dot in its middle, in pixels of a picture of 1920 x 1080.
const RING: f32 = 13.0;
const HALF_LINE: f32 = 1.7;
const DOT: f32 = 2.8;
/// What is left free around both, so that they are seen on any colour, and how much shines through there.
const HALO: f32 = 1.6;
const HALO_OPACITY: f32 = 0.6;

impl Picture {
    /// Draws a ring around each place, in the colour of the look's rims, with a halo in that of the background.
    pub fn draw_marks(&mut self, places: &[DVec3], camera: &Camera, look: &Look, output: &Output) {
        let projection = Projection::new(camera, look, output);
        let [ring, half_line, dot, halo] = [RING, HALF_LINE, DOT, HALO].map(|pixels| output.line_pixels(pixels));
        let middles: Vec<Vec2> = places
            .iter()
            .map(|place| projection.projected(*place).as_vec3().truncate())
            .filter(|middle| middle.is_finite())
            .collect();
        let mut canvas = self.canvas();
        let mut draw = |wider: f32, color: Vec3, opacity: f32| {
            for &middle in &middles {
                let reach = Vec2::splat(ring + half_line + wider);
                let distance = |place: Vec2| {
                    let away = place.distance(middle);
                    ((away - ring).abs() - half_line).min(away - dot) - wider
                };
                canvas.fill([middle - reach, middle + reach], distance, |_| (color, opacity));
            }
        };
        draw(halo, look.background[0], HALO_OPACITY);
        draw(0.0, look.lines.rim_color, 1.0);
    }
}
