//! Colours, material, patterns, lines and labels.

use std::path::PathBuf;

use crate::{
    immersion::FieldName,
    render::{ColorMap, Corner, LookName, PatternKind},
};

/// `[look]`: a preset and what differs from it.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LookSection {
    /// What the rest starts from.
    pub preset: LookName,
    /// sRGB of the side the normal points from.
    pub front: Option<[u8; 3]>,
    /// sRGB of the other side.
    pub back: Option<[u8; 3]>,
    /// sRGB behind the surface.
    pub background: Option<[u8; 3]>,
    /// sRGB at the lower end of the picture, for a gradient.
    pub background_bottom: Option<[u8; 3]>,
    /// How the surface answers light.
    pub material: Option<MaterialName>,
    /// Roughness of the `pbr` material, 0 to 1.
    pub roughness: Option<f64>,
    /// How metallic the `pbr` material is, 0 to 1.
    pub metallic: Option<f64>,
    /// A picture of a sphere in the light that is wanted, for the `matcap` material.
    pub matcap: Option<PathBuf>,
    /// Opacity of the front where it is seen face-on, 0 to 1.
    pub front_opacity: Option<f64>,
    /// Opacity of the back where it is seen face-on, 0 to 1.
    pub back_opacity: Option<f64>,
    /// Opacity where the surface is seen edge-on, 0 to 1.
    pub edge_opacity: Option<f64>,
    /// Stripes, fields or lines on the surface.
    pub pattern: Option<PatternSection>,
    /// A field shown as colour in place of front and back.
    pub color: Option<ColorSection>,
    /// Faces are left out where this formula of x, y and z of the mesh is positive.
    pub hide: Option<String>,
    /// Faces that are left out, by their numbers in the mesh file.
    pub hide_faces: Vec<usize>,
    /// A plane in space in front of which the surface is cut away.
    pub cut: Option<CutSection>,
    /// How far components are moved apart, in units of their distance from the middle.
    pub explode: f64,
    /// Strength of the mesh edges, 0 to 1.
    pub wireframe: Option<f64>,
    /// Whether silhouettes, creases, boundary, self-intersections, rims and pins are drawn.
    pub lines: Option<bool>,
    /// Widths of lines.
    pub line: LineSection,
    /// Radius of the loops that rims are drawn as, in mean edge lengths; 0 draws them as lines.
    pub rim_loops: f64,
    /// Whether rings mark what folds or vanishes around a frame.
    pub events: bool,
    /// Strength of the ambient occlusion, 0 to 1.
    pub occlusion: Option<f64>,
    /// Whether lights that can cast shadows do.
    pub shadows: Option<bool>,
    /// Strength of the shadow on the ground below the surface, 0 (none) to 1.
    pub ground_shadow: Option<f64>,
    /// Labels.
    pub texts: Vec<TextSection>,
    /// Size of labels and legend, as a share of the usual one.
    pub text_size: Option<f64>,
}

/// How the surface answers light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialName {
    /// Diffuse with a soft and a sharp highlight.
    Studio,
    /// Diffuse only.
    Clay,
    /// Rough dielectric or metal (GGX).
    Pbr,
    /// Few steps of light.
    Toon,
    /// The light of a picture of a sphere.
    Matcap,
    /// The colour itself, unlit.
    Flat,
}

/// `[look.pattern]`: along what and how often is settled by the caller of the renderer
#[derive(Clone, Debug, PartialEq)]
pub struct PatternSection {
    /// What is drawn.
    pub kind: PatternKind,
    /// What it runs along.
    pub along: PatternAlong,
    /// Periods from the least to the greatest value, or once around.
    pub count: usize,
    /// Share of a period that is left out (see-through), or that is dark for checkers; line width for grids
    /// and iso-lines.
    pub gap: f64,
}

/// What a pattern runs along.
#[derive(Clone, Debug, PartialEq)]
pub enum PatternAlong {
    /// The height z of the mesh: stripes are parallels.
    Parallels,
    /// The angle around the z axis of the mesh: stripes are meridians.
    Meridians,
    /// A formula of x, y and z of the mesh.
    Formula(String),
    /// A field.
    Field(FieldName),
}

/// `[look.color]`
#[derive(Clone, Debug, PartialEq)]
pub struct ColorSection {
    /// Which quantity.
    pub field: FieldName,
    /// The map; left out, one that suits the field.
    pub map: Option<ColorMap>,
    /// Values at the ends of the map in the units of the field, a length error as a ratio; left out, those of the whole
    /// film.
    pub range: Option<[f64; 2]>,
    /// Whether a legend is drawn.
    pub legend: bool,
}

/// `[look.cut]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutSection {
    /// The side that is cut away.
    pub normal: [f64; 3],
    /// Height of the plane along the normal, from the middle of what the camera frames, in units of its radius.
    pub offset: f64,
}

/// `[look.line]`: widths in pixels at 1920 x 1080; 0 draws none, left out is that of the preset.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LineSection {
    /// sRGB of all but rims and pins.
    pub color: Option<[u8; 3]>,
    /// Outlines.
    pub silhouette: Option<f64>,
    /// Edges that are bent by more than `crease_angle`.
    pub crease: Option<f64>,
    /// Degrees.
    pub crease_angle: Option<f64>,
    /// Ends of the surface.
    pub boundary: Option<f64>,
    /// Curves where the surface passes through itself.
    pub intersection: Option<f64>,
    /// Edges where the surface folds over.
    pub rim: Option<f64>,
    /// Vertices that are held.
    pub pin: Option<f64>,
    /// Whether lines are thinner far away.
    pub perspective: Option<bool>,
}

/// `[[look.text]]`
#[derive(Clone, Debug, PartialEq)]
pub struct TextSection {
    /// What it says; {scene}, {frame}, {frames}, {time}, {error}, {max_error}, {class}, {rims}, {faces} are filled in.
    pub text: String,
    /// Where it stands.
    pub corner: Corner,
}
