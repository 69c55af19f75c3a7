//! Where the glyphs of a line stand.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, Glyph, GlyphId, OutlinedGlyph, PxScale, point};

static FONT: LazyLock<Option<FontRef<'static>>> =
    LazyLock::new(|| FontRef::try_from_slice(include_bytes!("Inter-labels.ttf")).ok());

/// Height of capitals and digits in units of the size of a text.
pub const CAPITAL_HEIGHT: f32 = 0.7275;

/// A line of text from the origin of its baseline.
pub struct Line {
    glyphs: Vec<Glyph>,
    /// Pixels from the origin to where a next glyph would stand.
    pub width: f32,
}

impl Line {
    /// Sets a text; `size` is that of the font, in pixels. Control characters are left out, and characters that the
    /// font does not have are boxes.
    pub fn new(text: &str, size: f32) -> Line {
        let mut line = Line { glyphs: Vec::new(), width: 0.0 };
        let Some(font) = &*FONT else { return line };
        let per_unit = size / font.units_per_em().unwrap_or(2048.0);
        let scale = PxScale::from(per_unit * font.height_unscaled());
        let mut before: Option<GlyphId> = None;
        for character in text.chars().filter(|character| !character.is_control()) {
            let id = font.glyph_id(character);
            line.width += before.map_or(0.0, |before| font.kern_unscaled(before, id)) * per_unit;
            line.glyphs.push(id.with_scale_and_position(scale, point(line.width, 0.0)));
            line.width += font.h_advance_unscaled(id) * per_unit;
            before = Some(id);
        }
        line
    }

    /// The shapes of the glyphs, with the origin of the line at a place in pixels. Spaces have none.
    pub fn outlines(self, x: f32, y: f32) -> impl Iterator<Item = OutlinedGlyph> {
        self.glyphs.into_iter().filter_map(move |mut glyph| {
            glyph.position += point(x, y);
            FONT.as_ref()?.outline_glyph(glyph)
        })
    }
}

/// Pixels that a line of text is wide when its font is of this size (the em, in pixels).
pub fn text_width(text: &str, size: f32) -> f32 {
    Line::new(text, size).width
}
