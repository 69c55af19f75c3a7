//! The named looks.

use glam::Vec3;

use super::{
    appearance::{Look, Paint},
    color::linear_from_srgb,
    color_map::ColorMap,
    lines::Lines,
    material::Material,
    pattern::{Pattern, PatternKind},
};

const WARM_WHITE: [u8; 3] = [0xF4, 0xF3, 0xF0];
const INK: [u8; 3] = [0x2B, 0x23, 0x20];

/// Named looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum LookName {
    /// Two-coloured, three lights, on warm white.
    #[default]
    Studio,
    /// One matte colour, ambient light and a shadow on the ground.
    Clay,
    /// Thin, see-through, opaque where it is seen edge-on.
    Soap,
    /// Stripes with see-through gaps.
    Bands,
    /// White, lines only.
    Blueprint,
    /// Length error as colour, with a legend.
    Error,
}

impl LookName {
    /// All of them by their names.
    pub const ALL: [(&'static str, LookName); 6] = [
        ("studio", LookName::Studio),
        ("clay", LookName::Clay),
        ("soap", LookName::Soap),
        ("bands", LookName::Bands),
        ("blueprint", LookName::Blueprint),
        ("error", LookName::Error),
    ];
}

impl Look {
    /// A look by name.
    pub fn preset(name: LookName) -> Self {
        match name {
            LookName::Studio => Self::default(),
            LookName::Clay => clay(),
            LookName::Soap => soap(),
            LookName::Bands => bands(),
            LookName::Blueprint => blueprint(),
            LookName::Error => error(),
        }
    }
}

impl Default for Look {
    fn default() -> Self {
        Self {
            paint: Paint::Sides([[0xE0, 0x82, 0x3D], [0x3E, 0x7C, 0xB8]].map(linear_from_srgb)),
            material: Material::Studio { gloss: 1.0 },
            opacity: [1.0; 2],
            edge_opacity: 1.0,
            pattern: None,
            cut: None,
            background: [linear_from_srgb(WARM_WHITE); 2],
            sky: Vec3::new(0.30, 0.33, 0.38),
            ground: Vec3::new(0.20, 0.18, 0.16),
            occlusion_reach: 0.45,
            occlusion: 1.0,
            shadows: true,
            ground_shadow: 0.0,
            rim_darkening: 0.55,
            wireframe: 0.0,
            lines: Lines {
                color: linear_from_srgb(INK),
                rim_color: linear_from_srgb([0xB0, 0x12, 0x2E]),
                pin_color: linear_from_srgb([0x1E, 0x1B, 0x1A]),
                silhouette: 2.2,
                crease: 0.0,
                crease_angle: 40_f32.to_radians(),
                boundary: 2.4,
                intersection: 2.4,
                rim: 8.0,
                pinch: 16.0,
                pin: 0.0,
                perspective: false,
            },
        }
    }
}

/// Matte, one colour on both sides, much ambient light, a shadow on the ground and no outlines.
fn clay() -> Look {
    let studio = Look::default();
    Look {
        paint: Paint::Sides([[0xD9, 0xCF, 0xC1], [0xC2, 0xA3, 0x8C]].map(linear_from_srgb)),
        material: Material::Studio { gloss: 0.0 },
        background: [[0xE9, 0xE6, 0xE1], [0xDC, 0xD8, 0xD2]].map(linear_from_srgb),
        sky: Vec3::new(0.50, 0.51, 0.53),
        ground: Vec3::new(0.34, 0.31, 0.28),
        occlusion_reach: 0.7,
        ground_shadow: 0.6,
        rim_darkening: 0.2,
        lines: Lines { silhouette: 0.0, boundary: 0.0, intersection: 0.0, ..studio.lines },
        ..studio
    }
}

/// Thin sheets that are clear where they are seen face-on and dense where they are seen edge-on.
fn soap() -> Look {
    let studio = Look::default();
    Look {
        paint: Paint::Sides([[0xF0, 0x9A, 0x4E], [0x4F, 0x9E, 0xE8]].map(linear_from_srgb)),
        material: Material::Studio { gloss: 2.2 },
        opacity: [0.30; 2],
        edge_opacity: 0.97,
        background: [[0x1B, 0x20, 0x2A], [0x0E, 0x11, 0x17]].map(linear_from_srgb),
        sky: Vec3::new(0.55, 0.60, 0.70),
        ground: Vec3::new(0.34, 0.32, 0.30),
        occlusion: 0.5,
        shadows: false,
        rim_darkening: -0.35,
        lines: Lines {
            color: linear_from_srgb([0xF4, 0xEE, 0xE2]),
            rim_color: linear_from_srgb([0xFF, 0x3B, 0x5C]),
            pin_color: linear_from_srgb([0xF4, 0xEE, 0xE2]),
            silhouette: 0.0,
            intersection: 1.6,
            boundary: 1.8,
            ..studio.lines
        },
        ..studio
    }
}

/// Stripes with gaps, through which the far side is seen.
fn bands() -> Look {
    Look {
        pattern: Some(Pattern { kind: PatternKind::Bands, periods: [1.0; 2], gap: 0.42 }),
        lines: Lines { silhouette: 1.4, intersection: 1.6, ..Look::default().lines },
        ..Look::default()
    }
}

/// White paper and dark lines; hidden lines shine through.
fn blueprint() -> Look {
    let studio = Look::default();
    let ink = linear_from_srgb([0x14, 0x3A, 0x6B]);
    Look {
        paint: Paint::Sides([[0xFF, 0xFF, 0xFF], [0xE6, 0xEE, 0xF7]].map(linear_from_srgb)),
        material: Material::Flat,
        opacity: [0.86; 2],
        edge_opacity: 0.86,
        background: [Vec3::ONE; 2],
        occlusion: 0.0,
        shadows: false,
        rim_darkening: 0.0,
        wireframe: 0.22,
        lines: Lines { color: ink, silhouette: 2.6, boundary: 3.2, intersection: 2.6, pin_color: ink, ..studio.lines },
        ..studio
    }
}

/// A field as colour on a calm surface.
fn error() -> Look {
    let studio = Look::default();
    Look {
        paint: Paint::Map { map: ColorMap::Viridis, range: [0.0, 1.0] },
        material: Material::Studio { gloss: 0.3 },
        background: [Vec3::ONE; 2],
        sky: Vec3::new(0.56, 0.57, 0.59),
        ground: Vec3::new(0.46, 0.45, 0.44),
        occlusion: 0.7,
        rim_darkening: 0.3,
        lines: Lines { silhouette: 1.6, boundary: 1.8, intersection: 1.6, ..studio.lines },
        ..studio
    }
}
