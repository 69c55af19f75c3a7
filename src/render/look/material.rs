//! What a surface is made of.

use super::matcap::Matcap;

/// How the surface answers light.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Diffuse with a soft and a sharp highlight of this strength, 1 for the studio's.
    Studio {
        /// Strength of highlights.
        gloss: f32,
    },
    /// Microfacets (GGX) over a diffuse base.
    Pbr {
        /// 0 for a mirror, 1 for chalk.
        roughness: f32,
        /// 0 for plastic, 1 for metal.
        metallic: f32,
    },
    /// Light in a few even steps.
    Toon {
        /// Number of steps.
        steps: u32,
    },
    /// Light by the normal alone, from a picture of a sphere.
    Matcap(Matcap),
    /// The colour itself.
    Flat,
}
