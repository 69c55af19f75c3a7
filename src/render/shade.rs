//! The colour of one triangle, or one line, in one pixel.

use glam::{Vec2, Vec3, Vec3A};

use super::{
    Camera, Light, Lights, Look, Material, Output, Paint,
    stage::Stage,
    tube::{ScreenTube, Stroke},
    visibility::{Shade, Visibility, side_normal},
};

/// All that shading reads.
pub struct Shader<'a> {
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
    /// Unit normal in view space, on the front of the surface.
    pub normal: Vec3A,
}

/// Share of the key light that still comes through in a full shadow.
const SHADOW_LEAK: f32 = 0.1;
/// Edges shorter than these many pixels fade, and are not drawn.
const WIRE_FADE: [f32; 2] = [3.0, 6.0];

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
        let point = raised(mix(points), points, normals, weights);

        let albedo = self.albedo(side);
        let sky = (0..3).map(|k| self.visibility.sky(side, corners[k]) * weights[k]).sum::<f32>();
        let seen = |index: usize, light: &Light| match self.visibility.shade(index, face) {
            Shade::Lit => 1.0,
            Shade::Dark => 0.0,
            Shade::Mixed => self.visibility.light_seen(light, point, normal, pixel_turn(at)),
        };
        let color = self.lit(albedo, normal, toward_eye, sky, seen);
        let color = if self.look.wireframe > 0.0 { self.with_wires(color, corners, at) } else { color };
        Shaded { color, opacity: self.look.opacity[side], normal: side_normal(normal, side) }
    }

    /// Shades a line at a place in pixels.
    pub fn tube(&self, tube: &ScreenTube, at: [f32; 2]) -> Shaded {
        let normal = tube.normal_at(at);
        let color = match tube.stroke {
            Stroke::Outline { .. } | Stroke::Line => self.look.lines.color,
            Stroke::Raised => self.lit(self.look.lines.rim_color, normal, Vec3A::Z, 1.0, |_, _| 1.0),
        };
        Shaded { color, opacity: 1.0, normal }
    }

    fn albedo(&self, side: usize) -> Vec3 {
        match self.look.paint {
            Paint::Sides(colors) => colors[side],
            Paint::Map { map, .. } => map.at(0.5),
        }
    }

    fn gloss(&self) -> f32 {
        if let Material::Studio { gloss } = self.look.material { gloss } else { 0.0 }
    }

    /// Light leaving a surface point. `seen` is the share of a light that reaches it.
    fn lit(
        &self,
        albedo: Vec3,
        normal: Vec3A,
        toward_eye: Vec3A,
        sky: f32,
        seen: impl Fn(usize, &Light) -> f32,
    ) -> Vec3 {
        let ambient = self.look.ground.lerp(self.look.sky, 0.5 + 0.5 * normal.y);
        let mut diffuse = ambient * occlusion(sky, albedo);
        let mut specular = Vec3::ZERO;
        for (index, light) in self.lights.0.iter().enumerate() {
            let cosine = normal.dot(light.direction);
            let lambert = ((cosine + light.wrap) / (1.0 + light.wrap)).max(0.0);
            if lambert == 0.0 {
                continue;
            }
            let share = if light.shadow { seen(index, light) } else { 1.0 };
            diffuse += light.color * (lambert * (SHADOW_LEAK + (1.0 - SHADOW_LEAK) * share));
            if light.shadow && cosine > 0.0 {
                let halfway = normal.dot((light.direction + toward_eye).normalize_or_zero()).max(0.0);
                let fade = (cosine * 4.0).min(1.0);
                specular += light.color * (self.gloss() * highlight(halfway) * share * fade);
            }
        }
        let grazing = 1.0 - normal.dot(toward_eye).clamp(0.0, 1.0);
        (albedo * diffuse + specular) * (1.0 - self.look.rim_darkening * grazing * grazing * grazing)
    }

    /// Mesh edges one pixel wide, each half drawn by the face on its side.
    fn with_wires(&self, color: Vec3, corners: [u32; 3], at: [f32; 2]) -> Vec3 {
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
            .fold(0.0, f32::max);
        color.lerp(self.look.lines.color, cover * self.look.wireframe)
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

/// Ambient light where a share `sky` of it is seen; light that bounces takes on the surface's colour.
fn occlusion(sky: f32, albedo: Vec3) -> Vec3 {
    let open = sky.max(0.0) * sky.max(0.0).sqrt();
    let bounce = (1.0 - open) * (Vec3::ONE - 0.35 * albedo);
    Vec3::splat(open) / (Vec3::splat(open) + bounce).max(Vec3::splat(1e-6))
}

/// A narrow and a broad lobe: .16 h⁶⁰ + .05 h¹².
fn highlight(cosine: f32) -> f32 {
    let power4 = cosine * cosine * cosine * cosine;
    let power12 = power4 * power4 * power4;
    let power60 = power12 * power12 * power12 * power12 * power12;
    0.16 * power60 + 0.05 * power12
}

/// A turn per pixel whose errors are spread finely (interleaved gradient noise, Jimenez 2014).
fn pixel_turn([x, y]: [f32; 2]) -> [f32; 2] {
    let (x, y) = (x.floor(), y.floor());
    let noise = (52.982_918 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract();
    let angle = noise * std::f32::consts::TAU;
    [libm::cosf(angle), libm::sinf(angle)]
}
