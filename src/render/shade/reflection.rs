//! How a surface answers light.

use glam::{Vec3, Vec3A};

use crate::render::{Light, Lights, Look, Matcap, Material};

/// A point of the surface in the light.
pub struct Lit<'a> {
    /// Linear light.
    pub albedo: Vec3,
    /// Unit normal on the side that is looked at, in view directions.
    pub normal: Vec3A,
    /// Unit vector to the eye.
    pub toward_eye: Vec3A,
    /// Share of the sky that is seen.
    pub sky: f32,
    /// Lights, and the ambient light of the look.
    pub lights: &'a Lights,
    /// Ambient light.
    pub look: &'a Look,
}

/// Light that leaves a surface.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leaving {
    /// In the colour of the surface.
    pub body: Vec3,
    /// Reflected off its skin, whatever it is made of; seen on thin sheets too.
    pub highlight: Vec3,
    /// Share of what is behind a thin sheet that its skin hides, because it reflects.
    pub cover: f32,
}

/// Share of a light that still comes through in a full shadow.
const SHADOW_LEAK: f32 = 0.1;
/// Reflectance of dielectrics seen face-on.
const DIELECTRIC: f32 = 0.04;
/// Least roughness, so that directional lights are not points.
const SMOOTHEST: f32 = 0.06;

impl Lit<'_> {
    /// What leaves toward the eye. `seen` is the share of a light that reaches the point.
    pub fn leaving(&self, material: &Material, seen: impl Fn(usize, &Light) -> f32) -> Leaving {
        match material {
            Material::Studio { gloss } => self.studio(*gloss, seen),
            Material::Pbr { roughness, metallic } => self.microfacets(roughness.max(SMOOTHEST), *metallic, seen),
            Material::Toon { steps } => self.toon(*steps, seen),
            Material::Matcap(matcap) => Leaving { body: self.albedo * self.of_sphere(matcap), ..Leaving::default() },
            Material::Flat => Leaving { body: self.albedo, ..Leaving::default() },
        }
    }

    /// Light from everywhere that a surface facing `up` (the height of a unit vector) gets.
    fn ambient(&self, up: f32) -> Vec3 {
        self.look.ground.lerp(self.look.sky, 0.5 + 0.5 * up)
    }

    /// Each light with the cosine of its angle, wrapped around the terminator, and the share that arrives.
    fn arriving(&self, seen: impl Fn(usize, &Light) -> f32) -> impl Iterator<Item = (&Light, f32, f32)> {
        self.lights.all().iter().enumerate().filter_map(move |(index, light)| {
            let cosine = self.normal.dot(light.direction());
            let lambert = (cosine + light.wrap()) / (1.0 + light.wrap());
            (lambert > 0.0).then(|| {
                let share = if light.casts_shadow() && self.look.shadows { seen(index, light) } else { 1.0 };
                (light, lambert, share)
            })
        })
    }

    fn diffuse(&self, seen: impl Fn(usize, &Light) -> f32) -> Vec3 {
        let from_lights = self.arriving(seen).map(|(light, lambert, share)| light.color() * (lambert * leaked(share)));
        self.ambient(self.normal.y) * occlusion(self.sky, self.albedo) + from_lights.sum::<Vec3>()
    }

    fn halfway(&self, light: &Light) -> f32 {
        self.normal.dot((light.direction() + self.toward_eye).normalize_or_zero()).max(0.0)
    }

    fn studio(&self, gloss: f32, seen: impl Fn(usize, &Light) -> f32) -> Leaving {
        let mut diffuse = self.ambient(self.normal.y) * occlusion(self.sky, self.albedo);
        let mut highlight = Vec3::ZERO;
        for (light, lambert, share) in self.arriving(seen) {
            diffuse += light.color() * (lambert * leaked(share));
            let cosine = self.normal.dot(light.direction());
            if light.casts_shadow() && cosine > 0.0 {
                let fade = (cosine * 4.0).min(1.0);
                highlight += light.color() * (gloss * lobes(self.halfway(light)) * share * fade);
            }
        }
        let grazing = 1.0 - self.normal.dot(self.toward_eye).clamp(0.0, 1.0);
        let rim = 1.0 - self.look.rim_darkening * grazing * grazing * grazing;
        let highlight = highlight * rim.min(1.0);
        Leaving { body: self.albedo * diffuse * rim, highlight, cover: highlight.max_element().min(1.0) }
    }

    /// Lambert under GGX; what the facets reflect of the ambient light is taken from the diffuse part, so
    /// that a white surface in uniform light neither gains nor loses any.
    fn microfacets(&self, roughness: f32, metallic: f32, seen: impl Fn(usize, &Light) -> f32) -> Leaving {
        let facing = self.normal.dot(self.toward_eye).clamp(1e-3, 1.0);
        let face_on = Vec3::splat(DIELECTRIC).lerp(self.albedo, metallic);
        let (reflected, bounces) = environment_reflectance(face_on, roughness, facing);
        let base = self.albedo * (1.0 - metallic);
        // The mirror direction, bent to the normal by roughness.
        let mirror = self.normal * (2.0 * self.normal.dot(self.toward_eye)) - self.toward_eye;
        let up = mirror.lerp(self.normal, roughness * roughness).normalize_or_zero().y;
        let open = occlusion(self.sky, self.albedo);
        let kept = Vec3::ONE - reflected;
        let mut body = base * kept * self.ambient(self.normal.y) * open;
        let surround = reflected * self.ambient(up) * open;
        let mut highlight = Vec3::ZERO;
        let alpha = roughness * roughness;
        for (light, lambert, share) in self.arriving(seen) {
            body += base * kept * light.color() * (lambert * leaked(share));
            let cosine = self.normal.dot(light.direction());
            if cosine > 0.0 {
                let halfway = (light.direction() + self.toward_eye).normalize_or_zero();
                let fresnel = schlick(face_on, halfway.dot(self.toward_eye).max(0.0));
                let density = ggx(self.normal.dot(halfway).max(0.0), alpha);
                let shadowing = smith(cosine, facing, alpha);
                // A light's colour is what white paper facing it shows: pi times its radiance.
                let strength = std::f32::consts::PI * density * shadowing * cosine * share;
                highlight += fresnel * bounces * light.color() * strength.min(8.0);
            }
        }
        let cover = (reflected + highlight).max_element().min(1.0);
        Leaving { body, highlight: surround + highlight, cover }
    }

    /// Light in steps, with a narrow passage between them.
    fn toon(&self, steps: u32, seen: impl Fn(usize, &Light) -> f32) -> Leaving {
        let light = self.diffuse(seen);
        let brightness = light.dot(Vec3::new(0.2126, 0.7152, 0.0722)).max(1e-6);
        let steps = steps.max(1) as f32;
        let place = brightness.min(1.0) * steps;
        let (low, part) = (place.floor(), place.fract());
        let stepped = (low + ((part - 0.5) / 0.08 + 0.5).clamp(0.0, 1.0)) / steps;
        Leaving { body: self.albedo * (light / brightness) * stepped.max(0.25 / steps), ..Leaving::default() }
    }

    /// The colour of a sphere where it has the same normal to the eye.
    fn of_sphere(&self, matcap: &Matcap) -> Vec3 {
        // Axes around the direction of sight, so that perspective does not turn a plane into a gradient.
        let right = Vec3A::Y.cross(self.toward_eye).normalize_or(Vec3A::X);
        let up = self.toward_eye.cross(right);
        matcap.at(self.normal.dot(right), self.normal.dot(up))
    }
}

fn leaked(share: f32) -> f32 {
    SHADOW_LEAK + (1.0 - SHADOW_LEAK) * share
}

/// Ambient light where a share `sky` of it is seen; light that bounces takes on the surface's colour.
fn occlusion(sky: f32, albedo: Vec3) -> Vec3 {
    if sky >= 1.0 {
        return Vec3::ONE;
    }
    let open = sky.max(0.0) * sky.max(0.0).sqrt();
    let bounce = (1.0 - open) * (Vec3::ONE - 0.35 * albedo);
    Vec3::splat(open) / (Vec3::splat(open) + bounce).max(Vec3::splat(1e-6))
}

/// A narrow and a broad lobe: .16 h⁶⁰ + .05 h¹².
fn lobes(cosine: f32) -> f32 {
    let power4 = cosine * cosine * cosine * cosine;
    let power12 = power4 * power4 * power4;
    let power60 = power12 * power12 * power12 * power12 * power12;
    0.16 * power60 + 0.05 * power12
}

fn schlick(face_on: Vec3, cosine: f32) -> Vec3 {
    let grazing = (1.0 - cosine).clamp(0.0, 1.0);
    let power2 = grazing * grazing;
    face_on + (Vec3::ONE - face_on) * (power2 * power2 * grazing)
}

/// Density of facets (Walter et al. 2007).
fn ggx(cosine: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let base = cosine * cosine * (alpha2 - 1.0) + 1.0;
    alpha2 / (std::f32::consts::PI * base * base)
}

/// Facets hiding each other, over 4 cos cos (Heitz 2014, height-correlated).
fn smith(to_light: f32, to_eye: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let from = |cosine: f32, other: f32| other * (cosine * cosine * (1.0 - alpha2) + alpha2).sqrt();
    0.5 / (from(to_eye, to_light) + from(to_light, to_eye)).max(1e-6)
}

/// Share of uniform light that the facets reflect, and what light that bounces between facets adds to it, as a
/// factor: a white metal reflects all (fits of Karis, "Physically Based Shading on Mobile", 2014, and of Turquin,
/// "Practical multiple scattering compensation for microfacet models", 2019).
fn environment_reflectance(face_on: Vec3, roughness: f32, facing: f32) -> (Vec3, Vec3) {
    let r = [-roughness + 1.0, -0.0275 * roughness + 0.0425, -0.572 * roughness + 1.04, 0.022 * roughness - 0.04];
    let a = (r[0] * r[0]).min(libm::exp2f(-9.28 * facing)) * r[0] + r[1];
    let (scale, offset) = (-1.04 * a + r[2], 1.04 * a + r[3]);
    let bounces = Vec3::ONE + face_on * (1.0 / (scale + offset).max(1e-3) - 1.0);
    (((face_on * scale + Vec3::splat(offset)) * bounces).clamp(Vec3::ZERO, Vec3::ONE), bounces)
}
