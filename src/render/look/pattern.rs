//! Stripes, fields and lines on a surface, as averages over the width of a pixel.

/// Kinds of patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternKind {
    /// Stripes with see-through gaps between them.
    Bands,
    /// Fields of two shades, along and across.
    Checker,
    /// Lines along and across (a graticule).
    Grid,
    /// Lines of equal value.
    Isolines,
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

/// What a pattern does to the colour of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// Nothing.
    Plain,
    /// Darkens it by this share of a shade.
    Shade(f32),
    /// Covers it with ink by this share.
    Ink(f32),
}

/// A value at a place and how much it changes over a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// The value.
    pub value: f32,
    /// How much it changes from one pixel to the next.
    pub per_pixel: f32,
}

impl Pattern {
    /// The mark at a place, given the values along and across there (in the units of the fields). Bands make no
    /// mark: their gaps are left out of the surface.
    pub(in crate::render) fn mark(&self, along: Option<Spread>, across: Option<Spread>) -> Mark {
        let in_periods = |spread: Option<Spread>, period: f32| {
            spread.map(|s| Spread { value: s.value / period, per_pixel: s.per_pixel / period })
        };
        let along = in_periods(along, self.periods[0]);
        let across = in_periods(across, self.periods[1]);
        let line = |spread: Option<Spread>| spread.map_or(0.0, |s| centered(s, self.gap));
        match self.kind {
            PatternKind::Bands => Mark::Plain,
            PatternKind::Checker => {
                let sign = |spread: Option<Spread>| spread.map_or(1.0, |s| 1.0 - 2.0 * on_share(s, self.gap));
                Mark::Shade(0.5 - 0.5 * sign(along) * sign(across))
            }
            PatternKind::Grid => Mark::Ink(1.0 - (1.0 - line(along)) * (1.0 - line(across))),
            PatternKind::Isolines => Mark::Ink(line(along)),
        }
    }

    /// Whether the surface is left out where the field that the pattern runs along has this value.
    pub(in crate::render) fn is_gap(&self, along: f64) -> bool {
        let place = along / f64::from(self.periods[0]);
        self.kind == PatternKind::Bands && place - place.floor() >= 1.0 - f64::from(self.gap)
    }

    /// Parts, from 0 to 1, of a segment between two values that are no gaps.
    pub(in crate::render) fn solid_parts(&self, [from, to]: [f32; 2]) -> Vec<[f32; 2]> {
        let (from, to) = (from / self.periods[0], to / self.periods[0]);
        let has_few_bands = (to - from).abs() <= MOST_BANDS;
        if self.kind != PatternKind::Bands || from == to || !has_few_bands {
            return if self.is_gap(f64::from(from * self.periods[0])) { Vec::new() } else { vec![[0.0, 1.0]] };
        }
        let part = |value: f32| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let bands = from.min(to).floor() as i64..=from.max(to).floor() as i64;
        let ends = bands.map(|band| [part(band as f32), part(band as f32 + 1.0 - self.gap)]);
        ends.map(|[a, b]| [a.min(b), a.max(b)]).filter(|[a, b]| a < b).collect()
    }
}

/// More bands than this on one segment cannot be told apart, and are not listed.
const MOST_BANDS: f32 = 65_536.0;

/// Share of the pixel that lies in the first `duty` of a period.
fn on_share(Spread { value, per_pixel }: Spread, duty: f32) -> f32 {
    let integral = |x: f32| x.floor() * duty + (x - x.floor()).min(duty);
    // Where a whole period is less than a pixel wide, its mean is all there is to see.
    let width = per_pixel.clamp(1e-6, 1.0);
    let near = value - value.floor();
    let share = (integral(near + width / 2.0) - integral(near - width / 2.0)) / width;
    let blur = (per_pixel - 0.7).clamp(0.0, 1.0);
    share.clamp(0.0, 1.0) * (1.0 - blur) + duty * blur
}

/// Share of the pixel that lies within `duty` of a period around its whole numbers, never less than a fine line.
fn centered(spread: Spread, duty: f32) -> f32 {
    // A line thinner than a pixel is drawn a pixel wide, as long as lines are apart.
    let duty = duty.max((spread.per_pixel * 1.2).min(0.5));
    on_share(Spread { value: spread.value + duty / 2.0, ..spread }, duty)
}
