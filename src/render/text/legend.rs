//! The key to colours that stand for values.

use glam::{Vec2, Vec3};

use super::{
    canvas::Canvas,
    draw::{Anchor, TextStyle},
    layout::{CAPITAL_HEIGHT, text_width},
    sizes::Sizes,
    ticks::{Ticks, superscript},
};
use crate::{
    immersion::FieldName,
    render::{
        ColorMap,
        look::{Wording, wording},
    },
};

/// A bar of colours with numbers, or, for the categorical map, a patch for each number.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Over the colours, before the unit.
    pub title: String,
    /// Behind the title; empty for pure numbers.
    pub unit: String,
    /// The colours.
    pub map: ColorMap,
    /// Values at the ends of the map, in that unit; the categorical one has patches for 1 up to the second of them.
    pub range: [f32; 2],
    /// Whether there are values below and above, which have the colours of the ends.
    pub beyond: [bool; 2],
}

/// Share of the height of a picture that a bar takes.
const BAR_HEIGHT: f32 = 0.42;
/// Share of the height that patches may take.
const PATCHES_HEIGHT: f32 = 0.7;
/// More patches say nothing.
const MOST_PATCHES: f32 = 64.0;
/// Opacity of the thin line around colours, without which pale ones would run into the background.
const HAIRLINE: f32 = 0.4;

impl Legend {
    /// For a field in these colours; `range` are the values at the ends of the map, `extremes` the least and the greatest
    /// one, as the field has them. A legend says them as people read them, a length error in per cent.
    pub fn new(field: FieldName, map: ColorMap, range: [f32; 2], extremes: Option<[f32; 2]>) -> Legend {
        let Wording { title, unit, factor } = wording(field);
        // What differs by less than a ten thousandth of the range is not beyond it.
        let slack = 1e-4 * (range[1] - range[0]);
        let beyond =
            extremes.map_or([false; 2], |[least, greatest]| [least < range[0] - slack, greatest > range[1] + slack]);
        let range = range.map(|value| (factor * f64::from(value)) as f32);
        Legend { title: title.to_owned(), unit: unit.to_owned(), map, range, beyond }
    }

    pub(in crate::render) fn draw(&self, canvas: &mut Canvas, sizes: &Sizes, ink: Vec3) {
        if self.map == ColorMap::Categorical {
            self.draw_patches(canvas, sizes, ink);
        } else {
            self.draw_bar(canvas, sizes, ink);
        }
    }

    fn draw_bar(&self, canvas: &mut Canvas, sizes: &Sizes, ink: Vec3) {
        let size = canvas.size();
        let width = (0.5 * sizes.label).round().max(2.0);
        let right = (size.x - sizes.margin).round();
        let top = ((0.5 - 0.5 * BAR_HEIGHT) * size.y + 0.5 * sizes.label).round();
        let bottom = top + (BAR_HEIGHT * size.y).round().max(1.0);
        let corners = [Vec2::new(right - width, top), Vec2::new(right, bottom)];
        let radius = 0.22 * width;
        let line = Vec2::splat(sizes.stroke);
        canvas.fill_rounded([corners[0] - line, corners[1] + line], radius + line.x, |_| (ink, HAIRLINE));
        canvas.fill_rounded(corners, radius, |place| (self.map.at((bottom - place.y) / (bottom - top)), 1.0));

        // Where the map ends before the values do, it points on.
        let gap = (0.4 * width).round() + sizes.stroke;
        let point = (0.62 * width).round();
        for (end, (from, direction)) in [(bottom, 1.0), (top, -1.0)].into_iter().enumerate() {
            if self.beyond[end] {
                let base = Vec2::new(right - width / 2.0, from + direction * gap);
                let tip = base + Vec2::new(0.0, direction * point);
                let color = self.map.at(end as f32);
                let line = Vec2::new(0.0, direction * sizes.stroke);
                fill_arrow(canvas, base - line, tip + line, width + 2.0 * sizes.stroke, |_| (ink, HAIRLINE));
                fill_arrow(canvas, base, tip, width, |_| (color, 1.0));
            }
        }

        let ticks = Ticks::new(self.range.map(f64::from));
        let mark = (0.3 * sizes.label).round().max(2.0);
        let marks_end = right - width - (0.22 * sizes.label).round() - sizes.stroke;
        let [low, high] = self.range.map(f64::from);
        for (value, text) in &ticks.marks {
            let place = if high > low { ((value - low) / (high - low)) as f32 } else { 0.5 };
            // Marks of whole pixels are sharp, and those at the ends end with the bar.
            let y = (bottom - place * (bottom - top) - sizes.stroke * (1.0 - place)).round();
            let tick = [Vec2::new(marks_end - mark, y), Vec2::new(marks_end, y + sizes.stroke)];
            canvas.fill_rounded(tick, 0.5 * sizes.stroke, |_| (ink, 0.75));
            let baseline = Vec2::new(
                marks_end - mark - (0.35 * sizes.label).round(),
                y + 0.5 * (sizes.stroke + CAPITAL_HEIGHT * sizes.tick),
            );
            canvas.draw_text(text, baseline, &TextStyle { size: sizes.tick, color: ink, anchor: Anchor::Right });
        }
        let above = if self.beyond[1] { gap + point } else { 0.0 };
        self.draw_title(canvas, sizes, ink, Vec2::new(right, top - above - 0.95 * sizes.label), ticks.exponent);
    }

    fn draw_patches(&self, canvas: &mut Canvas, sizes: &Sizes, ink: Vec3) {
        let size = canvas.size();
        let count = self.range[1].round().clamp(0.0, MOST_PATCHES) as usize;
        let step = (1.35 * sizes.label).min(PATCHES_HEIGHT * size.y / count.max(1) as f32).round().max(2.0);
        let side = (0.62 * step).round();
        let right = (size.x - sizes.margin).round();
        let top = ((size.y - step * count as f32 + sizes.label) / 2.0).round();
        let style = TextStyle { size: sizes.tick.min(0.9 * step), color: ink, anchor: Anchor::Right };
        for k in 0..count {
            let corner = Vec2::new(right - side, top + k as f32 * step);
            let color = self.map.color((k + 1) as f32, self.range);
            canvas.fill_rounded([corner, corner + side], 0.22 * side, |_| (color, 1.0));
            let baseline =
                Vec2::new(corner.x - 0.5 * sizes.label, corner.y + 0.5 * (side + CAPITAL_HEIGHT * style.size));
            canvas.draw_text(&(k + 1).to_string(), baseline, &style);
        }
        self.draw_title(canvas, sizes, ink, Vec2::new(right, top - 0.95 * sizes.label), 0);
    }

    /// Ends at a place, and begins inside the picture.
    fn draw_title(&self, canvas: &mut Canvas, sizes: &Sizes, ink: Vec3, end: Vec2, exponent: i32) {
        let power = if exponent == 0 { String::new() } else { format!("10{}", superscript(exponent)) };
        let separator = if power.is_empty() || self.unit.is_empty() { "" } else { " " };
        let scale = format!("{power}{separator}{}", self.unit);
        let comma = if scale.is_empty() { "" } else { ", " };
        let title = format!("{}{comma}{scale}", self.title);
        let room = (end.x - sizes.margin).max(1.0);
        let size = sizes.label * (room / text_width(&title, sizes.label)).min(1.0);
        canvas.draw_text(&title, end, &TextStyle { size, color: ink, anchor: Anchor::Right });
    }
}

/// An upright triangle with the middle of its base and its tip at these places.
fn fill_arrow(canvas: &mut Canvas, base: Vec2, tip: Vec2, width: f32, paint: impl Fn(Vec2) -> (Vec3, f32)) {
    let half = Vec2::new(width / 2.0, 0.0);
    let along = tip - base;
    // Outward normals of the three sides.
    let side = Vec2::new(along.y.abs(), half.x).normalize_or_zero();
    let down = -along.normalize_or_zero();
    let distance = |place: Vec2| {
        let from_tip = place - tip;
        let sides = Vec2::new(from_tip.x.abs(), -from_tip.dot(down)).dot(side);
        sides.max((place - base).dot(down))
    };
    canvas.fill([base.min(tip) - half, base.max(tip) + half], distance, paint);
}
