//! `[look]`.

use super::picture::not_zero;
use crate::scene::data::{
    ColorSection, CutSection, LineSection, LookSection, MaterialName, PatternAlong, PatternSection, TextSection,
};
use crate::scene::keys::Color;
use crate::scene::keys::Table;
use crate::{
    immersion::FieldName,
    render::{ColorMap, Corner, LookName, PatternKind},
};

pub(super) fn look(table: &mut Table) -> LookSection {
    let materials = [
        ("studio", MaterialName::Studio),
        ("clay", MaterialName::Clay),
        ("pbr", MaterialName::Pbr),
        ("toon", MaterialName::Toon),
        ("matcap", MaterialName::Matcap),
        ("flat", MaterialName::Flat),
    ];
    let look = LookSection {
        preset: table.choice_or("preset", "The named look from which all else that stands here differs.", &LookName::ALL, LookName::default()),
        front: color(table, "front", "Colour of the front, the side from which faces are counterclockwise."),
        back: color(table, "back", "Colour of the back."),
        background: color(table, "background", "Colour behind the surface."),
        background_bottom: color(table, "background_bottom", "Colour at the lower end of the picture, for a gradient."),
        material: table.choice("material", "How the surface answers light; `pbr` has `roughness` and `metallic`, `matcap` takes its shading from a picture, `flat` is not lit.", &materials),
        roughness: share(table, "roughness", "Roughness of the `pbr` material."),
        metallic: share(table, "metallic", "How metallic the `pbr` material is."),
        matcap: table
            .key::<String>("matcap", "A picture of a lit sphere, for the `matcap` material.")
            .optional("clay.png".into())
            .map(Into::into),
        front_opacity: share(table, "front_opacity", "Opacity of the front where it is seen face-on."),
        back_opacity: share(table, "back_opacity", "Opacity of the back where it is seen face-on."),
        edge_opacity: share(table, "edge_opacity", "Opacity where the surface is seen edge-on, which is more than face-on for soap films and the like."),
        pattern: table.optional_table("pattern", "Stripes, fields or lines on the surface.", pattern),
        color: table.optional_table("color", "A field shown as colour.", shown_field),
        hide: table
            .key::<String>("hide", "Faces are left out where this formula of the mesh's x, y and z is positive.")
            .optional("z".into()),
        hide_faces: table
            .key("hide_faces", "Faces that are left out, by their numbers in the mesh file, counted from 0.")
            .or(Vec::new()),
        cut: table.optional_table("cut", "A plane in front of which the surface is cut away.", cut),
        explode: table
            .key("explode", "How far components are moved apart, in units of their distance from the middle.")
            .at_least(0.0)
            .or(0.0),
        wireframe: share(table, "wireframe", "Strength of the lines along mesh edges; 0 draws none."),
        lines: table
            .key("lines", "Whether silhouettes, creases, boundary, self-intersections, rims and pins are drawn.")
            .optional(true),
        line: table.table("line", "Widths of lines in pixels at 1920 x 1080; 0 draws none.", line),
        rim_loops: table
            .key("rim_loops", "Radius of loops in mean edge lengths, which the surface makes along its rims so that it is an immersion: half as wide on the first and the last frame of a rim. 0 draws rims as lines.")
            .at_least(0.0)
            .at_most(20.0)
            .or(0.0),
        events: table
            .key("events", "Whether a ring marks each place where a hinge folds or a face vanishes on the way from the frame before, or to the next one.")
            .or(false),
        occlusion: share(table, "occlusion", "Strength of the ambient occlusion."),
        shadows: table.key("shadows", "Whether lights that can cast shadows do.").optional(true),
        ground_shadow: share(table, "ground_shadow", "Strength of the shadow on the ground below the surface."),
        texts: table.tables("text", "A label.", text),
        text_size: table
            .key("text_size", "Size of labels and legend, as a share of the usual one.")
            .above(0.0)
            .at_most(10.0)
            .optional(1.0),
    };
    if look.matcap.is_some() && look.material != Some(MaterialName::Matcap) {
        table.complain("matcap", "`matcap` is a picture for another material", "add material = \"matcap\"");
    }
    look
}

fn color(table: &mut Table, name: &'static str, doc: &'static str) -> Option<[u8; 3]> {
    table.key(name, doc).optional(Color([0xE0, 0x82, 0x3D])).map(|color| color.0)
}

fn share(table: &mut Table, name: &'static str, doc: &'static str) -> Option<f64> {
    table.key(name, doc).at_least(0.0).at_most(1.0).optional(0.5)
}

const PATTERN_DOC: &str =
    "What is drawn: stripes with see-through gaps, a chessboard, lines both ways, or level lines.";

fn pattern(table: &mut Table) -> PatternSection {
    let kinds = [
        ("bands", PatternKind::Bands),
        ("checker", PatternKind::Checker),
        ("grid", PatternKind::Grid),
        ("isolines", PatternKind::Isolines),
    ];
    let along = table
        .key::<String>("along", "Along what it changes: \"parallels\", \"meridians\", a field by its name (as `field` under [look.color]), or a formula of the mesh's x, y and z.")
        .or("parallels".into());
    let field = FieldName::ALL.iter().find(|(name, _)| *name == along).map(|&(_, field)| field);
    let kind = table.choice_or("kind", PATTERN_DOC, &kinds, PatternKind::Bands);
    let usual_gap = if matches!(kind, PatternKind::Bands | PatternKind::Checker) { 0.5 } else { 0.06 };
    PatternSection {
        kind,
        along: match (along.as_str(), field) {
            ("parallels", _) => PatternAlong::Parallels,
            ("meridians", _) => PatternAlong::Meridians,
            (_, Some(field)) => PatternAlong::Field(field),
            _ => PatternAlong::Formula(along),
        },
        count: table
            .key("count", "Periods from the least to the greatest value, or once around.")
            .at_least(1.0)
            .at_most(1000.0)
            .or(12),
        gap: table
            .key("gap", "Share of a period that is see-through (bands), dark (checker), or a line (grid, isolines).")
            .at_least(0.0)
            .at_most(1.0)
            .or(usual_gap),
    }
}

const RANGE_DOC: &str = "Values at the ends of the map, as files have them: a length error as a ratio (0.01 is 1 %), a bending \
                         angle in degrees; left out, those of the whole film.";

fn shown_field(table: &mut Table) -> ColorSection {
    let range: Option<[f64; 2]> = table.key("range", RANGE_DOC).optional([0.0, 0.01]);
    if let Some([low, high]) = range
        && low >= high
    {
        table.complain("range", "the range is empty", "write the smaller value first, as in range = [0, 0.01]");
    }
    ColorSection {
        field: table.choice_or("field", "The quantity that is shown.", &FieldName::ALL, FieldName::LengthError),
        map: table.choice("map", "The colours; left out, those that suit the field.", &ColorMap::ALL),
        range,
        legend: table.key("legend", "Whether a legend is drawn.").or(true),
    }
}

fn cut(table: &mut Table) -> CutSection {
    let cut = CutSection {
        normal: table.key("normal", "Points to the side that is cut away.").required([0.0, 0.0, 1.0]),
        offset: table
            .key("offset", "Height along the normal from the middle of what the camera frames, in units of its radius.")
            .or(0.0),
    };
    not_zero(table, "normal", Some(cut.normal));
    cut
}

fn line(table: &mut Table) -> LineSection {
    LineSection {
        color: color(table, "color", "Colour of all but rims and pins."),
        silhouette: width(table, "silhouette", "Outlines against what lies behind."),
        crease: width(table, "crease", "Edges that are bent by more than `crease_angle`."),
        crease_angle: table
            .key("crease_angle", "The angle in degrees by which an edge must be bent to be drawn as a crease.")
            .at_least(0.0)
            .at_most(180.0)
            .optional(40.0),
        boundary: width(table, "boundary", "The boundary of the surface."),
        intersection: width(table, "intersection", "Curves where the surface passes through itself."),
        rim: width(table, "rim", "Edges where the surface folds over."),
        pin: width(table, "pin", "Vertices that are held."),
        perspective: table.key("perspective", "Whether lines are thinner far away.").optional(false),
    }
}

fn width(table: &mut Table, name: &'static str, doc: &'static str) -> Option<f64> {
    table.key(name, doc).at_least(0.0).at_most(100.0).optional(2.0)
}

fn text(table: &mut Table) -> TextSection {
    let corners = [
        ("top_left", Corner::TopLeft),
        ("top_right", Corner::TopRight),
        ("bottom_left", Corner::BottomLeft),
        ("bottom_right", Corner::BottomRight),
    ];
    TextSection {
        text: table
            .key::<String>(
                "text",
                "What it says; {scene}, {frame}, {frames}, {time}, {error}, {max_error}, {class}, {rims} and {faces} are filled in.",
            )
            .required("frame {frame}".into()),
        corner: table.choice_or("corner", "Where in the picture it stands.", &corners, Corner::default()),
    }
}
