//! All that a surface is to look like.

use glam::Vec3;

use super::{color_map::ColorMap, lines::Lines, material::Material, pattern::Pattern, plane::Plane};
use crate::render::{LookElement, RenderError};

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
    /// Runs along the fields of [`Scenery::along`](crate::render::Scenery).
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
    /// The field [`Scenery::color`](crate::render::Scenery), from the least to the greatest shown value.
    Map {
        /// The colours.
        map: ColorMap,
        /// Values at its ends.
        range: [f32; 2],
    },
}

impl Look {
    /// That shares lie between 0 and 1, that widths of lines and periods of the pattern are finite, and that the cut is a
    /// plane.
    ///
    /// # Errors
    /// [`RenderError::Share`], [`RenderError::LineWidth`], [`RenderError::Cut`], [`RenderError::Periods`]
    pub fn validate(&self) -> Result<(), RenderError> {
        let shares = [
            (LookElement::FrontOpacity, self.opacity[0]),
            (LookElement::BackOpacity, self.opacity[1]),
            (LookElement::EdgeOpacity, self.edge_opacity),
            (LookElement::Occlusion, self.occlusion),
            (LookElement::GroundShadow, self.ground_shadow),
            (LookElement::Wireframe, self.wireframe),
            (LookElement::Gap, self.pattern.map_or(0.0, |pattern| pattern.gap)),
        ];
        let (roughness, metallic) = match self.material {
            Material::Pbr { roughness, metallic } => (roughness, metallic),
            _ => (0.0, 0.0),
        };
        let of_material = [(LookElement::Roughness, roughness), (LookElement::Metallic, metallic)];
        for (element, value) in shares.into_iter().chain(of_material) {
            if !(0.0..=1.0).contains(&value) {
                return Err(RenderError::Share { element, value });
            }
        }
        let lines = &self.lines;
        let widths = [
            (LookElement::Silhouette, lines.silhouette),
            (LookElement::Crease, lines.crease),
            (LookElement::Boundary, lines.boundary),
            (LookElement::Intersection, lines.intersection),
            (LookElement::Rim, lines.rim),
            (LookElement::PinchPoint, lines.pinch),
            (LookElement::Pin, lines.pin),
        ];
        for (element, width) in widths {
            if !(width >= 0.0 && width.is_finite()) {
                return Err(RenderError::LineWidth { element, width });
            }
        }
        if let Some(Plane { normal, offset }) = self.cut
            && !(normal.is_normalized() && offset.is_finite())
        {
            return Err(RenderError::Cut { normal, offset });
        }
        match self.pattern {
            Some(Pattern { periods, .. }) if !periods.iter().all(|period| period.is_finite()) => {
                Err(RenderError::Periods { periods })
            }
            _ => Ok(()),
        }
    }

    /// Whether all of the surface hides what is behind it.
    pub fn is_opaque(&self) -> bool {
        self.opacity == [1.0; 2] && self.edge_opacity == 1.0
    }
}
