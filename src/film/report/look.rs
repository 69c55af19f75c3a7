//! Camera, lights and colours as the page has them.

use serde_json::{Value as Json, json};

use super::facts::{list, six_digits};
use crate::film::pictures::Views;
use crate::immersion::FieldName;
use crate::render::{Camera, ColorMap, FieldSpread, Legend, Look, Material, Paint};
use glam::Vec3;

/// Where the eye is in each frame, or in all of them, if it never moves.
pub(super) fn camera(views: &Views, shown: &[usize]) -> Json {
    let cameras: Vec<&Camera> = shown.iter().filter_map(|&place| views.cameras.get(place)).collect();
    let still = cameras.windows(2).all(|pair| pair[0] == pair[1]);
    let Some(first) = cameras.first() else { return Json::Null };
    let clip = first.clip_from_view();
    let (center, radius) = first.subject();
    let pose = |camera: &&Camera| {
        let view = camera.view_from_world();
        let matrix = view.matrix3.to_cols_array();
        let half_height = 1.0 / camera.clip_from_view().y_axis.y;
        json!({ "half": half_height, "turn": matrix, "shift": view.translation.to_array() })
    };
    json!({
        "perspective": first.field_of_view() > 0.0,
        "aspect": six_digits(clip.y_axis.y / clip.x_axis.x),
        "center": center.to_array(),
        "radius": radius,
        "poses": cameras.iter().take(if still { 1 } else { usize::MAX }).map(pose).collect::<Vec<_>>(),
    })
}

/// Directional lights, fixed to the eye.
pub(super) fn lights(views: &Views) -> Json {
    let light = |light: &crate::render::Light| {
        json!({
            "toward": list(light.direction().to_array().map(f64::from)),
            "color": linear(light.color()),
            "wrap": six_digits(light.wrap().into()),
            "shadow": light.casts_shadow(),
        })
    };
    views.lights.all().iter().map(light).collect()
}

/// What the surface looks like, as far as the page draws it. Lines are as wide as in a picture of 1920 times 1080 pixels.
pub(super) fn look(look: &Look) -> Json {
    let sides = match look.paint {
        Paint::Sides(sides) => sides,
        Paint::Map { map, range } => [map.color(0.5 * (range[0] + range[1]), range); 2],
    };
    let (lit, gloss) = match look.material {
        Material::Studio { gloss } => (true, gloss),
        Material::Flat => (false, 0.0),
        // Others are drawn as the studio's.
        _ => (true, 1.0),
    };
    let lines = &look.lines;
    let number = |x: f32| six_digits(x.into());
    json!({
        "sides": sides.map(linear),
        "lit": lit,
        "gloss": number(gloss),
        "opacity": look.opacity.map(number),
        "edgeOpacity": number(look.edge_opacity),
        "background": look.background.map(linear),
        "sky": linear(look.sky),
        "ground": linear(look.ground),
        "occlusion": number(look.occlusion),
        "shadows": look.shadows,
        "rimDarkening": number(look.rim_darkening),
        "wireframe": number(look.wireframe),
        "lines": {
            "color": linear(lines.color),
            "rimColor": linear(lines.rim_color),
            "pinColor": linear(lines.pin_color),
            "silhouette": number(lines.silhouette),
            "boundary": number(lines.boundary),
            "intersection": number(lines.intersection),
            "rim": number(lines.rim),
            "pinch": number(lines.pinch),
            "pin": number(lines.pin),
        },
    })
}

/// The range and the map in which the page shows a field.
pub(super) fn colors_of(
    field: FieldName,
    look: &Look,
    shown: Option<FieldName>,
    spread: &FieldSpread,
) -> (ColorMap, [f32; 2]) {
    match look.paint {
        Paint::Map { map, range } if shown == Some(field) => (map, range),
        _ => (ColorMap::suiting(field), spread.range(field)),
    }
}

/// A field that the page has, and the words for its values.
pub(super) fn field(field: FieldName, (map, range): (ColorMap, [f32; 2]), spread: &FieldSpread) -> Json {
    let legend = Legend::new(field, map, range, spread.extremes());
    json!({
        "name": field.name(),
        "title": legend.title,
        "unit": legend.unit,
        "map": map.name(),
        "range": legend.range.map(|value| six_digits(value.into())),
        "beyond": legend.beyond,
        "perFace": field.is_per_face(),
        "categories": map == ColorMap::Categorical,
    })
}

/// Entries of a map that the page goes between; those of the categorical one are its ten colours.
const ENTRIES: usize = 65;

/// The colours of a map, linear light.
pub(super) fn map(map: ColorMap) -> (&'static str, Json) {
    let colors = match map {
        ColorMap::Categorical => (0..10).map(|k| linear(map.color(k as f32, [0.0, 1.0]))).collect(),
        _ => (0..ENTRIES).map(|k| linear(map.at(k as f32 / (ENTRIES - 1) as f32))).collect(),
    };
    (map.name(), colors)
}

fn linear(color: Vec3) -> Json {
    list(color.to_array().map(f64::from))
}
