//! The curves of a film: what its frames are worth over time, as a table (`curves.csv`) and as a figure (`curves.svg`).

use std::fmt;
use std::io;
use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::Value as Json;

use crate::evolve::FrameReport;
use crate::film::{DiskError, FilmFolder, kept_certificate};
use crate::whole_file;

/// Writes `curves.csv` and `curves.svg` into the folder of a film, with its events if it has a certificate.
pub(in crate::cli) fn write_curves(folder: &Path, reports: &[FrameReport]) -> Result<(), DiskError> {
    let certificate = kept_certificate(&FilmFolder::open(folder)?);
    let events = certificate.map(|certificate| certificate.events_before_frames());
    let events = events.as_deref();
    let table = curves_csv(reports, events).map_err(io::Error::from);
    for (name, text) in [("curves.csv", table), ("curves.svg", curves_svg(reports, events))] {
        let path = folder.join(name);
        let text = text.map_err(DiskError::io(&path, "written"))?;
        whole_file::write_unless_same(&path, text.as_bytes()).map_err(DiskError::io(&path, "written"))?;
    }
    Ok(())
}

/// One line a frame under a header: every number of the reports, in their order, and yes or no as 1 or 0; in the end how much folds or
/// vanishes on the way from the frame before, if that is known.
///
/// # Errors
/// None on reports of finite numbers.
pub fn curves_csv(reports: &[FrameReport], events: Option<&[usize]>) -> serde_json::Result<String> {
    let mut table = String::new();
    for (line, report) in reports.iter().enumerate() {
        let mut fields: Fields = serde_json::from_str(&serde_json::to_string(report)?)?;
        fields.0.extend(events_before(report, events).map(|count| ("events".to_owned(), count.to_string())));
        if line == 0 {
            let names: Vec<&str> = fields.0.iter().map(|(name, _)| name.as_str()).collect();
            table = names.join(",") + "\n";
        }
        let values: Vec<&str> = fields.0.iter().map(|(_, value)| value.as_str()).collect();
        table.push_str(&values.join(","));
        table.push('\n');
    }
    Ok(table)
}

/// What folds or vanishes on the way to a frame, if that is known.
fn events_before(report: &FrameReport, events: Option<&[usize]>) -> Option<usize> {
    events?.get(report.frame.checked_sub(1)?).copied()
}

/// The numbers of a JSON object in the order in which they are written; a map would sort them.
struct Fields(Vec<(String, String)>);

impl<'de> Deserialize<'de> for Fields {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder;
        impl<'de> Visitor<'de> for InOrder {
            type Value = Fields;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Fields, A::Error> {
                let mut fields = Vec::new();
                while let Some((name, value)) = object.next_entry::<String, Json>()? {
                    match value {
                        Json::Number(number) => fields.push((name, number.to_string())),
                        Json::Bool(yes) => fields.push((name, u8::from(yes).to_string())),
                        _ => {} // not a curve
                    }
                }
                Ok(Fields(fields))
            }
        }
        deserializer.deserialize_map(InOrder)
    }
}

/// Length error, rims, pinch points and, if they are known, events over the frames, one panel each, as an SVG (Fig. 8 and 20 of the paper).
///
/// # Errors
/// None on reports of finite numbers.
pub fn curves_svg(reports: &[FrameReport], events: Option<&[usize]>) -> io::Result<String> {
    let mut svg = String::new();
    let height = if events.is_some() { HEIGHT + COUNT_PANEL_HEIGHT } else { HEIGHT };
    let area = SVGBackend::with_string(&mut svg, (WIDTH, height)).into_drawing_area();
    draw(&area, reports, events).map_err(io::Error::other)?;
    drop(area);
    Ok(svg)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// Coordinates of the drawing are integers, so that its unit has to be small: a quarter of a pixel on a usual page.
const WIDTH: u32 = 2800;
const HEIGHT: u32 = 2000;
const ERROR_PANEL_HEIGHT: u32 = 880;
const COUNT_PANEL_HEIGHT: u32 = 530;
const MARGIN_LEFT: u32 = 230;
const MARGIN_RIGHT: i32 = 80;
const TITLE_HEIGHT: u32 = 100;
const TITLE: (&str, u32) = ("sans-serif", 48);
const LABEL: (&str, u32) = ("sans-serif", 42);
const THIN: u32 = 3;
const CURVE: u32 = 6;
const GRID: RGBColor = RGBColor(0xE4, 0xE4, 0xE4);
const INK: RGBColor = RGBColor(0x33, 0x33, 0x33);
const BLUE: RGBColor = RGBColor(0x3E, 0x7C, 0xB8);
const ORANGE: RGBColor = RGBColor(0xE0, 0x82, 0x3D);

/// A curve with its name and colour.
struct Curve {
    name: &'static str,
    color: RGBColor,
    points: Vec<(f64, f64)>,
}

impl Curve {
    fn of(name: &'static str, color: RGBColor, reports: &[FrameReport], value: impl Fn(&FrameReport) -> f64) -> Curve {
        Curve { name, color, points: reports.iter().map(|r| (r.frame as f64, value(r))).collect() }
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|(_, value)| *value)
    }
}

/// Where an axis begins and ends, and where it is labelled.
#[derive(Clone)]
struct Axis {
    from: f64,
    to: f64,
    ticks: Vec<f64>,
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let along = (value - self.from) / (self.to - self.from);
        limit.0 + (along * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.from..self.to
    }
}

fn draw<'a>(area: &Area<'a>, reports: &[FrameReport], events: Option<&[usize]>) -> Outcome<'a> {
    area.fill(&WHITE)?;
    let (errors, below) = area.split_vertically(ERROR_PANEL_HEIGHT);
    let exponent = |ratio: f64| libm::log10((100.0 * ratio).max(SMALLEST_PERCENT));
    let curves = [
        Curve::of("max", ORANGE, reports, |r| exponent(r.max_length_error)),
        Curve::of("L2", BLUE, reports, |r| exponent(r.l2_length_error)),
    ];
    panel(&errors, "relative length error", reports, &curves, &decades(&curves), &percent_of_exponent)?;
    let counts = [
        Curve::of("rims", INK, reports, |r| r.rims as f64),
        Curve::of("pinch points", INK, reports, |r| r.pinch_points as f64),
        Curve::of("folds and faces that vanish since the frame before", INK, reports, |r| {
            events_before(r, events).unwrap_or(0) as f64
        }),
    ];
    let mut rest = below;
    for curve in counts.into_iter().take(if events.is_some() { 3 } else { 2 }) {
        let (area, after) = rest.split_vertically(COUNT_PANEL_HEIGHT);
        rest = after;
        let most = curve.values().fold(1.0, f64::max);
        let axis = Axis { from: 0.0, to: 1.08 * most, ticks: ticks(0.0, most, 4.0) };
        panel(&area, curve.name, reports, &[curve], &axis, &|y| y.to_string())?;
    }
    text(&rest, "frame", &INK, (WIDTH as i32 - MARGIN_RIGHT, 20), HPos::Right)?;
    area.present()
}

/// One diagram over the frames: title on top, names of curves, if there are several, to the right of it.
fn panel<'a>(
    area: &Area<'a>,
    title: &str,
    reports: &[FrameReport],
    curves: &[Curve],
    axis: &Axis,
    label: &dyn Fn(&f64) -> String,
) -> Outcome<'a> {
    let first = reports.first().map_or(0.0, |r| r.frame as f64);
    let last = reports.last().map_or(1.0, |r| r.frame as f64).max(first + 1.0);
    let frames = Axis { from: first, to: last, ticks: ticks(first, last, 8.0) };
    let mut chart = ChartBuilder::on(area)
        .margin_top(TITLE_HEIGHT)
        .margin_right(MARGIN_RIGHT)
        .x_label_area_size(100)
        .y_label_area_size(MARGIN_LEFT)
        .build_cartesian_2d(frames, axis.clone())?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .bold_line_style(GRID.stroke_width(THIN))
        .light_line_style(TRANSPARENT)
        .axis_style(INK.stroke_width(THIN))
        .set_all_tick_mark_size(14)
        .label_style(LABEL.into_font().color(&INK))
        .x_label_formatter(&|frame| frame.to_string())
        .y_label_formatter(&label)
        .draw()?;
    for curve in curves {
        chart.draw_series(LineSeries::new(curve.points.iter().copied(), curve.color.stroke_width(CURVE)))?;
    }
    let middle = TITLE_HEIGHT as i32 / 2;
    text(area, title, &INK, (MARGIN_LEFT as i32, middle), HPos::Left)?;
    let right = area.dim_in_pixel().0 as i32 - MARGIN_RIGHT;
    if curves.len() > 1 {
        for (k, curve) in curves.iter().rev().enumerate() {
            text(area, curve.name, &curve.color, (right - 160 * k as i32, middle), HPos::Right)?;
        }
    }
    Ok(())
}

fn text<'a>(area: &Area<'a>, text: &str, color: &RGBColor, at: (i32, i32), side: HPos) -> Outcome<'a> {
    area.draw_text(text, &TITLE.into_font().color(color).pos(Pos::new(side, VPos::Center)), at)
}

/// The powers of ten, as exponents, between which the curves lie.
fn decades(curves: &[Curve]) -> Axis {
    let values = || curves.iter().flat_map(Curve::values);
    let from = values().fold(f64::INFINITY, f64::min).floor();
    let to = values().fold(f64::NEG_INFINITY, f64::max).ceil();
    let (from, to) = if from.is_finite() { (from, to.max(from + 1.0)) } else { (-2.0, 0.0) };
    Axis { from, to, ticks: ticks(from, to, 6.0) }
}

/// Length errors below this are drawn at it: a surface that starts as it is would hide all others.
const SMALLEST_PERCENT: f64 = 1e-3;

/// `0.01 %` for −2.
fn percent_of_exponent(exponent: &f64) -> String {
    let decimals = (-exponent).max(0.0) as usize;
    if decimals <= 4 { format!("{:.decimals$} %", libm::pow(10.0, *exponent)) } else { format!("1e{exponent} %") }
}

/// Whole numbers from `from` to `to` in steps of 1, 2 or 5 times a power of ten, about `count` of them at most.
fn ticks(from: f64, to: f64, count: f64) -> Vec<f64> {
    let least = ((to - from) / count).max(1.0);
    let power = libm::pow(10.0, libm::log10(least).floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|k| k * power).find(|step| *step >= least).unwrap_or(least);
    let start = (from / step).ceil();
    (0..).map(|k| (start + f64::from(k)) * step).take_while(|tick| *tick <= to).collect()
}
