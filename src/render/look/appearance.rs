use std::path::Path;

use glam::Vec3;

use super::{ColorMap, RenderError, color::linear_from_srgb};
use crate::scene::{ColorMapName, LineSection, LookSection, MaterialName, PatternKind};

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
    /// How much grazing views are darkened, so that the outline reads on a light ground; negative brightens them
    /// for a dark one.
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
    /// The look a scene asks for: a preset and what differs from it. What depends on the surface, the fields that
    /// colours and patterns run along and the plane of a cut, is added by the caller.
    ///
    /// # Errors
    /// [`RenderError::Share`] if a share is not between 0 and 1, [`RenderError::Matcap`] if the picture of a
    /// sphere cannot be read; its path starts in `folder`.
    pub fn from_scene(section: &LookSection, folder: &Path) -> Result<Self, RenderError> {
        let preset = Self::preset(section.preset);
        let share = |key: &'static str, value: Option<f64>, usual: f32| match value {
            Some(value) if !(0.0..=1.0).contains(&value) => Err(RenderError::Share { key, value }),
            value => Ok(value.map_or(usual, |value| value as f32)),
        };
        let top = section.background.map_or(preset.background[0], linear_from_srgb);
        let bottom = section.background.map_or(preset.background[1], linear_from_srgb);
        Ok(Self {
            paint: paint(section, preset.paint),
            material: material(section, preset.material, folder)?,
            opacity: [
                share("front_opacity", section.front_opacity, preset.opacity[0])?,
                share("back_opacity", section.back_opacity, preset.opacity[1])?,
            ],
            edge_opacity: share("edge_opacity", section.edge_opacity, preset.edge_opacity)?,
            pattern: section.pattern.as_ref().map_or(preset.pattern, |pattern| {
                Some(Pattern { kind: pattern.kind, periods: [1.0; 2], gap: pattern.gap as f32 })
            }),
            background: [top, section.background_bottom.map_or(bottom, linear_from_srgb)],
            occlusion: share("occlusion", section.occlusion, preset.occlusion)?,
            shadows: section.shadows.unwrap_or(preset.shadows),
            ground_shadow: share("ground_shadow", section.ground_shadow, preset.ground_shadow)?,
            wireframe: share("wireframe", section.wireframe, preset.wireframe)?,
            lines: if section.lines == Some(false) { Lines::NONE } else { lines(&section.line, preset.lines) },
            ..preset
        })
    }

    /// Whether all of the surface hides what is behind it.
    pub fn is_opaque(&self) -> bool {
        self.opacity == [1.0; 2] && self.edge_opacity == 1.0
    }
}

fn paint(section: &LookSection, preset: Paint) -> Paint {
    if section.color.is_some() {
        // Map and range are those of the field, which is computed later.
        return Paint::Map { map: ColorMap(ColorMapName::Viridis), range: [0.0, 1.0] };
    }
    let sides = |usual: [Vec3; 2]| {
        Paint::Sides([
            section.front.map_or(usual[0], linear_from_srgb),
            section.back.map_or(usual[1], linear_from_srgb),
        ])
    };
    match preset {
        Paint::Sides(usual) => sides(usual),
        map => map,
    }
}

fn material(section: &LookSection, preset: Material, folder: &Path) -> Result<Material, RenderError> {
    let Some(name) = section.material else { return Ok(preset) };
    Ok(match name {
        MaterialName::Studio => Material::Studio { gloss: 1.0 },
        MaterialName::Clay => Material::Studio { gloss: 0.0 },
        MaterialName::Pbr => Material::Pbr {
            roughness: section.roughness.unwrap_or(0.4) as f32,
            metallic: section.metallic.unwrap_or(0.0) as f32,
        },
        MaterialName::Toon => Material::Toon { steps: 4 },
        MaterialName::Matcap => Material::Matcap(match &section.matcap {
            Some(path) => Matcap::read(&folder.join(path))?,
            None => Matcap::porcelain(),
        }),
        MaterialName::Flat => Material::Flat,
    })
}

fn lines(section: &LineSection, preset: Lines) -> Lines {
    let width = |value: Option<f64>, usual: f32| value.map_or(usual, |value| value as f32);
    let rim = width(section.rim, preset.rim);
    Lines {
        color: section.color.map_or(preset.color, linear_from_srgb),
        silhouette: width(section.silhouette, preset.silhouette),
        crease: width(section.crease, preset.crease),
        crease_angle: section.crease_angle.map_or(preset.crease_angle, |degrees| degrees.to_radians() as f32),
        boundary: width(section.boundary, preset.boundary),
        intersection: width(section.intersection, preset.intersection),
        rim,
        pinch: 2.0 * rim,
        pin: width(section.pin, preset.pin),
        perspective: section.perspective.unwrap_or(preset.perspective),
        ..preset
    }
}

impl Matcap {
    /// Reads a picture of a lit sphere that touches the middle square's sides.
    ///
    /// # Errors
    /// [`RenderError::Matcap`]
    pub fn read(path: &Path) -> Result<Self, RenderError> {
        let failed = |error: String| RenderError::Matcap { path: path.to_owned(), reason: error };
        let picture = image::open(path).map_err(|error| failed(error.to_string()))?.into_rgb8();
        let side = picture.width().min(picture.height());
        let (left, top) = ((picture.width() - side) / 2, (picture.height() - side) / 2);
        let square = image::imageops::crop_imm(&picture, left, top, side, side).to_image();
        Ok(Self { side: side as usize, pixels: square.pixels().map(|pixel| linear_from_srgb(pixel.0)).collect() })
    }

    /// White porcelain between two soft boxes.
    pub fn porcelain() -> Self {
        const SIDE: usize = 256;
        let boxes = [(Vec3::new(-0.55, 0.65, 0.55), 0.75, 60), (Vec3::new(0.80, 0.15, 0.35), 0.30, 14)];
        let pixel = |index: usize| {
            let place = |value: usize| (value as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
            let (x, y) = (place(index % SIDE), -place(index / SIDE));
            let normal = Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()).normalize();
            let mirror =
                Vec3::new(2.0 * normal.z * normal.x, 2.0 * normal.z * normal.y, 2.0 * normal.z * normal.z - 1.0);
            let base =
                Vec3::new(0.30, 0.29, 0.30).lerp(Vec3::new(0.86, 0.87, 0.90), 0.5 + 0.5 * normal.dot(boxes[0].0));
            let shine: f32 = boxes
                .iter()
                .map(|&(toward, strength, power)| strength * mirror.dot(toward.normalize()).max(0.0).powi(power))
                .sum();
            base * (0.55 + 0.45 * normal.z) + Vec3::splat(shine)
        };
        Self { side: SIDE, pixels: (0..SIDE * SIDE).map(pixel).collect() }
    }
}
