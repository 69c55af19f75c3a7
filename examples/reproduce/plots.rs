//! Curves as SVG: panels below each other over the same axis.

use super::request::{Outcome, Request};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A curve with its name.
pub struct Curve {
    pub name: String,
    pub color: RGBColor,
    pub points: Vec<(f64, f64)>,
}

/// A diagram.
pub struct Panel {
    pub title: String,
    /// Whether values are powers of ten, shares of which are shown in per cent.
    pub is_logarithmic: bool,
    pub curves: Vec<Curve>,
    /// Where a new stage begins, with its name.
    pub stages: Vec<(f64, String)>,
}

pub const BLUE: RGBColor = RGBColor(0x3E, 0x7C, 0xB8);
pub const ORANGE: RGBColor = RGBColor(0xE0, 0x82, 0x3D);
pub const INK: RGBColor = RGBColor(0x33, 0x33, 0x33);
const GRID: RGBColor = RGBColor(0xDD, 0xDD, 0xDD);
const WIDTH: u32 = 960;
const HEIGHT: u32 = 330;

/// Shares below this are drawn at it.
const SMALLEST: f64 = 1e-5;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// Writes the panels and gives the line that shows them.
pub fn save(request: &Request, name: &str, axis: &str, panels: &[Panel], alternative: &str) -> Outcome<String> {
    let mut svg = String::new();
    let height = HEIGHT * panels.len() as u32 + 24;
    draw(&SVGBackend::with_string(&mut svg, (WIDTH, height)).into_drawing_area(), axis, panels)
        .map_err(|error| error.to_string())?;
    std::fs::write(request.pictures().join(format!("{name}.svg")), svg)?;
    Ok(format!("![{alternative}](renders/reproduction/{name}.svg)\n"))
}

fn draw<'a>(area: &Area<'a>, axis: &str, panels: &[Panel]) -> Drawn<'a> {
    area.fill(&WHITE)?;
    let mut rest = area.clone();
    for panel in panels {
        let (upper, lower) = rest.split_vertically(HEIGHT);
        draw_panel(&upper, panel)?;
        rest = lower;
    }
    text(&rest, axis, &INK, (WIDTH as i32 - 30, 6), HPos::Right)?;
    area.present()
}

fn draw_panel<'a>(area: &Area<'a>, panel: &Panel) -> Drawn<'a> {
    let value = |y: f64| if panel.is_logarithmic { libm::log10(y.max(SMALLEST)) } else { y };
    let all = || panel.curves.iter().flat_map(|curve| curve.points.iter().copied());
    let fold = |pick: fn(f64, f64) -> f64, start: f64, of: fn((f64, f64)) -> f64| all().map(of).fold(start, pick);
    let (left, right) = (fold(f64::min, f64::INFINITY, |p| p.0), fold(f64::max, f64::NEG_INFINITY, |p| p.0));
    let (low, high) =
        (value(fold(f64::min, f64::INFINITY, |p| p.1)), value(fold(f64::max, f64::NEG_INFINITY, |p| p.1)));
    let (low, high) = if panel.is_logarithmic {
        (low.floor(), high.ceil().max(low.floor() + 1.0))
    } else {
        (0.0, 1.1 * high.max(1.0))
    };
    let mut chart = ChartBuilder::on(area)
        .margin_top(46)
        .margin_right(30)
        .x_label_area_size(34)
        .y_label_area_size(84)
        .build_cartesian_2d(left..right, low..high)?;
    let label = |y: &f64| match panel.is_logarithmic {
        true if (y - y.round()).abs() < 1e-9 => percent_of_exponent(*y),
        true => String::new(),
        false => format!("{y:.0}"),
    };
    chart
        .configure_mesh()
        .disable_x_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(INK)
        .y_labels(if panel.is_logarithmic { 2 * (high - low) as usize } else { 5 })
        .label_style(("sans-serif", 17).into_font().color(&INK))
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&label)
        .draw()?;
    for (start, name) in &panel.stages {
        chart.draw_series(LineSeries::new([(*start, low), (*start, high)], GRID.stroke_width(2)))?;
        let style = ("sans-serif", 15).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Top));
        chart.draw_series([Text::new(format!(" {name}"), (*start, high - 0.03 * (high - low)), style)])?;
    }
    for curve in &panel.curves {
        let points = curve.points.iter().map(|&(x, y)| (x, value(y)));
        chart.draw_series(LineSeries::new(points, curve.color.stroke_width(2)))?;
    }
    text(area, &panel.title, &INK, (84, 22), HPos::Left)?;
    let mut right = WIDTH as i32 - 30;
    for curve in panel.curves.iter().rev().filter(|_| panel.curves.len() > 1) {
        text(area, &curve.name, &curve.color, (right, 22), HPos::Right)?;
        right -= 9 * curve.name.chars().count() as i32 + 24;
    }
    Ok(())
}

/// `0.01 %` for −4.
fn percent_of_exponent(exponent: f64) -> String {
    let decimals = (-2.0 - exponent.round()).max(0.0) as usize;
    format!("{:.decimals$} %", 100.0 * libm::pow(10.0, exponent.round()))
}

fn text<'a>(area: &Area<'a>, text: &str, color: &RGBColor, at: (i32, i32), side: HPos) -> Drawn<'a> {
    area.draw_text(text, &("sans-serif", 18).into_font().color(color).pos(Pos::new(side, VPos::Center)), at)
}
