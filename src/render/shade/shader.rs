//! The colour of one triangle, or one line, in one pixel.

use glam::{Vec2, Vec3, Vec3A};

use super::{
    directions::side_normal,
    reflection::{Leaving, Lit},
    visibility::{Shade, Visibility},
};
use crate::render::{
    Camera, Light, Lights, Look, Material, Output, Paint, Scenery,
    look::{Mark, Spread},
    raster::{ScreenTube, Stroke},
    stage::Stage,
};

/// All that shading reads.
#[derive(Clone, Copy)]
pub struct Shader<'a> {
    pub scenery: &'a Scenery<'a>,
    pub stage: &'a Stage,
    pub visibility: &'a Visibility,
    pub camera: &'a Camera,
    pub lights: &'a Lights,
    pub look: &'a Look,
    pub output: &'a Output,
}

/// Result of shading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shaded {
    /// Linear light, before the tone curve, not multiplied by the opacity.
    pub color: Vec3,
    /// Share of what is behind that it hides.
    pub opacity: f32,
}

/// Edges shorter than these many pixels fade, and are not drawn.
const WIRE_FADE: [f32; 2] = [3.0, 6.0];
/// How dark the dark fields of a checker are.
const CHECKER_SHADE: f32 = 0.55;

impl Shader<'_> {
    /// Shades a face at a place in pixels.
    pub fn face(&self, face: usize, at: [f32; 2]) -> Shaded {
        let stage = self.stage;
        let corners = stage.faces[face];
        let (toward_eye, weights) = stage.sight(face, at);
        let mix = |values: [Vec3A; 3]| values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2];
        let side = usize::from(!stage.shows_front[face]);
        let points = corners.map(|vertex| stage.positions[vertex as usize]);
        let normals = corners.map(|vertex| side_normal(stage.normals[vertex as usize], side));
        let flat = side_normal(stage.face_normals[face], side);
        let normal = turned_to_eye(mix(normals).try_normalize().unwrap_or(flat), flat, toward_eye);
        let albedo = self.patterned(self.albedo(face, side, weights), face, at);

        let leaving = if self.look.material == Material::Flat {
            Leaving { body: albedo, ..Leaving::default() }
        } else {
            let seen = |index: usize, light: &Light| match self.visibility.shade(index, face) {
                Shade::Lit => 1.0,
                Shade::Dark => 0.0,
                Shade::Mixed => {
                    let point = raised(mix(points), points, normals, weights);
                    self.visibility.light_seen(light, point, normal, pixel_turn(at))
                }
            };
            let sky = self.visibility.sky_seen(side, corners, weights);
            let sky = 1.0 - self.look.occlusion * (1.0 - sky);
            let lit = Lit { albedo, normal, toward_eye, sky, lights: self.lights, look: self.look };
            lit.leaving(&self.look.material, seen)
        };
        if self.look.is_opaque() && self.look.wireframe == 0.0 {
            return Shaded { color: leaving.body + leaving.highlight, opacity: 1.0 };
        }
        // A thin sheet lets its own colour through, not its highlights.
        let sheet = self.opacity(side, normal.dot(toward_eye));
        let opacity = sheet + (1.0 - sheet) * leaving.cover;
        let color = (leaving.body * sheet + leaving.highlight) / opacity.max(1e-6);
        let (color, opacity) = self.with_wires(color, opacity, corners, at);
        Shaded { color, opacity }
    }

    /// Shades a line at a place in pixels.
    pub fn tube(&self, tube: &ScreenTube, at: [f32; 2]) -> Shaded {
        let normal = tube.normal_at(at);
        let color = match tube.stroke {
            Stroke::Outline { .. } | Stroke::Line => self.look.lines.color,
            Stroke::Rim => self.raised_line(self.look.lines.rim_color, normal),
            Stroke::Pin => self.raised_line(self.look.lines.pin_color, normal),
        };
        Shaded { color, opacity: 1.0 }
    }

    /// A lit tube.
    fn raised_line(&self, albedo: Vec3, normal: Vec3A) -> Vec3 {
        let lit = Lit { albedo, normal, toward_eye: Vec3A::Z, sky: 1.0, lights: self.lights, look: self.look };
        let leaving = lit.leaving(&Material::Studio { gloss: 1.0 }, |_, _| 1.0);
        leaving.body + leaving.highlight
    }

    fn albedo(&self, face: usize, side: usize, weights: [f32; 3]) -> Vec3 {
        match (self.look.paint, self.scenery.color) {
            (Paint::Sides(colors), _) => colors[side],
            (Paint::Map { map, range }, Some(field)) => {
                let corners = field.at_corners(self.stage.triangles[face] as usize, self.stage.faces[face]);
                let value: f32 = (0..3).map(|k| corners[k] * weights[k]).sum();
                map.color(value, range)
            }
            (Paint::Map { map, .. }, None) => map.at(0.0),
        }
    }

    /// The colour with checkers, grids and iso-lines.
    fn patterned(&self, albedo: Vec3, face: usize, at: [f32; 2]) -> Vec3 {
        let Some(pattern) = &self.look.pattern else { return albedo };
        let [along, across] = self.stage.along.each_ref().map(|values| {
            let corners = values.get(face)?;
            let value = |at: [f32; 2]| {
                let weights = self.stage.weights_in_plane(face, at);
                (0..3).map(|k| corners[k] * weights[k]).sum::<f32>()
            };
            let here = value(at);
            let step = Vec2::new(value([at[0] + 0.5, at[1]]) - here, value([at[0], at[1] + 0.5]) - here);
            let per_pixel = 2.0 * step.length();
            (here + per_pixel).is_finite().then_some(Spread { value: here, per_pixel })
        });
        match pattern.mark(along, across) {
            Mark::Plain => albedo,
            Mark::Shade(share) => albedo * (1.0 - share * CHECKER_SHADE),
            Mark::Ink(share) => albedo.lerp(self.look.lines.color, share),
        }
    }

    /// Opacity of a sheet seen under an angle with this cosine.
    fn opacity(&self, side: usize, cosine: f32) -> f32 {
        let face_on = self.look.opacity[side];
        if face_on == 1.0 && self.look.edge_opacity == 1.0 {
            return 1.0;
        }
        let grazing = (1.0 - cosine.clamp(0.0, 1.0)).powi(2);
        face_on + (self.look.edge_opacity - face_on) * grazing
    }

    /// Mesh edges one pixel wide, each half drawn by the face on its side; they are opaque on thin sheets too.
    fn with_wires(&self, color: Vec3, opacity: f32, corners: [u32; 3], at: [f32; 2]) -> (Vec3, f32) {
        if self.look.wireframe == 0.0 {
            return (color, opacity);
        }
        let pixels = corners.map(|vertex| self.stage.pixels[vertex as usize]);
        let cover = (0..3)
            .map(|k| {
                let (from, edge) = (pixels[k], pixels[(k + 1) % 3] - pixels[k]);
                let length = edge.length();
                let distance = edge.perp_dot(Vec2::from(at) - from).abs() / length;
                let fade = ((length - WIRE_FADE[0]) / (WIRE_FADE[1] - WIRE_FADE[0])).clamp(0.0, 1.0);
                let cover = fade * (1.0 - distance).clamp(0.0, 1.0);
                if cover.is_finite() { cover } else { 0.0 }
            })
            .fold(0.0, f32::max)
            * self.look.wireframe;
        let total = cover + (1.0 - cover) * opacity;
        ((self.look.lines.color * cover + color * ((1.0 - cover) * opacity)) / total.max(1e-6), total)
    }
}

/// A smooth normal may point away from an eye that sees the face; bend it back.
fn turned_to_eye(normal: Vec3A, flat: Vec3A, toward_eye: Vec3A) -> Vec3A {
    // At a fold the average normal can lie on the wrong side altogether.
    let normal = if normal.dot(flat) < 0.0 { flat } else { normal };
    let facing = normal.dot(toward_eye);
    if facing >= 0.0 { normal } else { (normal - toward_eye * facing).normalize_or(flat) }
}

/// The point lifted from the flat face onto the rounded surface that its normals describe, so that
/// shadow rays start outside (Hanika, "Hacking the Shadow Terminator", 2021).
fn raised(point: Vec3A, corners: [Vec3A; 3], normals: [Vec3A; 3], weights: [f32; 3]) -> Vec3A {
    (0..3).fold(point, |raised, k| {
        let below = (point - corners[k]).dot(normals[k]).min(0.0);
        raised - normals[k] * (below * weights[k])
    })
}

/// A turn per pixel whose errors are spread finely (interleaved gradient noise, Jimenez 2014).
fn pixel_turn([x, y]: [f32; 2]) -> [f32; 2] {
    let (x, y) = (x.floor(), y.floor());
    let noise = (52.982_918 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract();
    let angle = noise * std::f32::consts::TAU;
    [libm::cosf(angle), libm::sinf(angle)]
}
