use glam::Vec3;

use super::{ColorMap, RenderError, color::linear_from_srgb};
use crate::scene::{LookSection, MaterialName, PatternKind};

/// Colours, material and lines. Colours are linear light. The default is the studio look: a
/// two-coloured clay on a warm white ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// What gives the surface its colour.
    pub paint: Paint,
    /// How it answers light.
    pub material: Material,
    /// Opacity of front and back where they are seen face-on, 0 to 1.
    pub opacity: [f32; 2],
    /// Opacity where the surface is seen edge-on, 0 to 1.
    pub edge_opacity: f32,
    /// Runs along the fields of [`Scenery::along`](super::Scenery).
    pub pattern: Option<Pattern>,
    /// The surface is left out where it lies beyond this plane of the world.
    pub cut: Option<Plane>,
    /// Behind the surface, at the upper and the lower end of the picture.
    pub background: [Vec3; 2],
    /// Ambient light from above.
    pub sky: Vec3,
    /// Ambient light from below.
    pub ground: Vec3,
    /// How far occluders darken the ambient light, as a share of the framed radius; 0 turns it off.
    pub occlusion_reach: f32,
    /// How much of that darkening is shown, 0 to 1.
    pub occlusion: f32,
    /// Whether lights cast shadows.
    pub shadows: bool,
    /// Strength of the shadow on the ground below the surface, 0 for no ground.
    pub ground_shadow: f32,
    /// How much grazing views are darkened, 0 to 1, so that the outline reads on a light ground.
    pub rim_darkening: f32,
    /// Strength of the mesh edges, 0 to 1.
    pub wireframe: f32,
    /// Lines.
    pub lines: Lines,
}

/// What gives the surface its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// Front (the side the normal points from) and back.
    Sides([Vec3; 2]),
    /// The field [`Scenery::color`](super::Scenery), from the least to the greatest shown value.
    Map {
        /// The colours.
        map: ColorMap,
        /// Values at its ends.
        range: [f32; 2],
    },
}

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
    /// Light in so many steps.
    Toon {
        /// Number of steps.
        steps: u32,
    },
    /// Light by the normal alone, from a picture of a sphere.
    Matcap(Matcap),
    /// The colour itself.
    Flat,
}

/// A square picture of a lit sphere in linear light, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Matcap {
    /// Pixels along a side.
    pub side: usize,
    /// side² colours.
    pub pixels: Vec<Vec3>,
}

/// A periodic pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// What is drawn.
    pub kind: PatternKind,
    /// Width of a period along each of the two fields, in their units.
    pub periods: [f32; 2],
    /// Share of a period that is see-through (bands), dark (checker) or a line (grid, iso-lines).
    pub gap: f32,
}

/// The points x with normal · x = offset; beyond it, normal · x is larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal in world space.
    pub normal: glam::DVec3,
    /// Distance from the origin.
    pub offset: f64,
}

/// Widths of lines in pixels of a picture of 1920 x 1080; 0 draws none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lines {
    /// All but rims and pins.
    pub color: Vec3,
    /// Rims and pinch points.
    pub rim_color: Vec3,
    /// Pins.
    pub pin_color: Vec3,
    /// Outlines.
    pub silhouette: f32,
    /// Edges bent by more than [`Lines::crease_angle`].
    pub crease: f32,
    /// Radians.
    pub crease_angle: f32,
    /// Ends of the surface.
    pub boundary: f32,
    /// Curves where the surface passes through itself.
    pub intersection: f32,
    /// Edges where the surface folds over.
    pub rim: f32,
    /// Vertices whose star is a figure-eight.
    pub pinch: f32,
    /// Vertices that are held.
    pub pin: f32,
    /// Whether lines far away are thinner; widths are then those at the middle of what is framed.
    pub perspective: bool,
}

impl Lines {
    /// No lines at all.
    pub const NONE: Lines = Lines {
        color: Vec3::ZERO,
        rim_color: Vec3::ZERO,
        pin_color: Vec3::ZERO,
        silhouette: 0.0,
        crease: 0.0,
        crease_angle: 0.7,
        boundary: 0.0,
        intersection: 0.0,
        rim: 0.0,
        pinch: 0.0,
        pin: 0.0,
        perspective: false,
    };
}

impl Look {
    /// The look a scene asks for: a preset and what differs from it. Fields, patterns and cuts that depend on
    /// the surface are added by the caller.
    ///
    /// # Errors
    /// [`RenderError::Wireframe`] if the strength is not between 0 and 1.
    pub fn from_scene(section: &LookSection) -> Result<Self, RenderError> {
        let mut look = Self::default();
        if let Some(wireframe) = section.wireframe {
            if !(0.0..=1.0).contains(&wireframe) {
                return Err(RenderError::Wireframe(wireframe));
            }
            look.wireframe = wireframe as f32;
        }
        if let Paint::Sides([front, back]) = &mut look.paint {
            *front = section.front.map_or(*front, linear_from_srgb);
            *back = section.back.map_or(*back, linear_from_srgb);
        }
        if let Some(background) = section.background {
            look.background = [linear_from_srgb(background); 2];
        }
        if section.lines == Some(false) {
            look.lines = Lines::NONE;
        }
        if section.material == Some(MaterialName::Flat) {
            look.material = Material::Flat;
        }
        Ok(look)
    }

    /// Whether all of the surface is opaque.
    pub fn is_opaque(&self) -> bool {
        self.opacity == [1.0; 2]
    }
}

impl Default for Look {
    fn default() -> Self {
        Self {
            paint: Paint::Sides([linear_from_srgb([0xE0, 0x82, 0x3D]), linear_from_srgb([0x3E, 0x7C, 0xB8])]),
            material: Material::Studio { gloss: 1.0 },
            opacity: [1.0; 2],
            edge_opacity: 1.0,
            pattern: None,
            cut: None,
            background: [linear_from_srgb([0xF4, 0xF3, 0xF0]); 2],
            sky: Vec3::new(0.30, 0.33, 0.38),
            ground: Vec3::new(0.20, 0.18, 0.16),
            occlusion_reach: 0.45,
            occlusion: 1.0,
            shadows: true,
            ground_shadow: 0.0,
            rim_darkening: 0.55,
            wireframe: 0.0,
            lines: Lines {
                color: linear_from_srgb([0x2B, 0x23, 0x20]),
                rim_color: linear_from_srgb([0xB0, 0x12, 0x2E]),
                pin_color: linear_from_srgb([0x1E, 0x1B, 0x1A]),
                silhouette: 2.2,
                crease: 0.0,
                crease_angle: 0.7,
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
