//! `[look]` as a look.

use std::path::Path;

use glam::Vec3;

use crate::{
    render::{ColorMap, Lines, Look, LookElement, Matcap, Material, Paint, Pattern, RenderError, linear_from_srgb},
    scene::{LineSection, LookSection, MaterialName, Scene, SceneError},
};

/// The look that a scene asks for: a preset and what differs from it. What depends on the surface, the fields that
/// colours and patterns run along and the plane of a cut, is added by the caller.
///
/// # Errors
/// A [`SceneError`] at the key that is at fault, among them a picture of a sphere that cannot be read.
pub fn look(scene: &Scene) -> Result<Look, SceneError> {
    of_section(&scene.look, &scene.folder).map_err(|error| scene.complain_about(key(&error), &error))
}

fn of_section(section: &LookSection, folder: &Path) -> Result<Look, RenderError> {
    let preset = Look::preset(section.preset);
    let share = |value: Option<f64>, usual: f32| value.map_or(usual, |value| value as f32);
    let top = section.background.map_or(preset.background[0], linear_from_srgb);
    let bottom = section.background.map_or(preset.background[1], linear_from_srgb);
    let look = Look {
        paint: paint(section, preset.paint),
        material: material(section, preset.material, folder)?,
        opacity: [share(section.front_opacity, preset.opacity[0]), share(section.back_opacity, preset.opacity[1])],
        edge_opacity: share(section.edge_opacity, preset.edge_opacity),
        pattern: section.pattern.as_ref().map_or(preset.pattern, |pattern| {
            Some(Pattern { kind: pattern.kind, periods: [1.0; 2], gap: pattern.gap as f32 })
        }),
        background: [top, section.background_bottom.map_or(bottom, linear_from_srgb)],
        occlusion: share(section.occlusion, preset.occlusion),
        shadows: section.shadows.unwrap_or(preset.shadows),
        ground_shadow: share(section.ground_shadow, preset.ground_shadow),
        wireframe: share(section.wireframe, preset.wireframe),
        lines: if section.lines == Some(false) {
            // Marks have the colour of rims, drawn or not.
            Lines { rim_color: preset.lines.rim_color, ..Lines::NONE }
        } else {
            lines(&section.line, preset.lines)
        },
        ..preset
    };
    look.validate()?;
    Ok(look)
}

fn paint(section: &LookSection, preset: Paint) -> Paint {
    if section.color.is_some() {
        // Map and range are those of the field, which is computed later.
        return Paint::Map { map: ColorMap::Viridis, range: [0.0, 1.0] };
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

/// Where a scene says what is at fault.
fn key(error: &RenderError) -> &'static str {
    let element = match error {
        RenderError::Share { element, .. } | RenderError::LineWidth { element, .. } => *element,
        RenderError::Periods { .. } => return "look.pattern",
        RenderError::Cut { .. } => return "look.cut",
        RenderError::Matcap { .. } => return "look.matcap",
        _ => return "look",
    };
    match element {
        LookElement::FrontOpacity => "look.front_opacity",
        LookElement::BackOpacity => "look.back_opacity",
        LookElement::EdgeOpacity => "look.edge_opacity",
        LookElement::Occlusion => "look.occlusion",
        LookElement::GroundShadow => "look.ground_shadow",
        LookElement::Wireframe => "look.wireframe",
        LookElement::Gap => "look.pattern.gap",
        LookElement::Roughness => "look.roughness",
        LookElement::Metallic => "look.metallic",
        LookElement::Silhouette => "look.line.silhouette",
        LookElement::Crease => "look.line.crease",
        LookElement::Boundary => "look.line.boundary",
        LookElement::Intersection => "look.line.intersection",
        LookElement::Rim | LookElement::PinchPoint => "look.line.rim",
        LookElement::Pin => "look.line.pin",
    }
}
