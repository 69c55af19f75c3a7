//! What the runs of a sweep are worth, in one table.

use std::io::{self, Write};
use std::path::Path;

use super::combinations::Run;
use super::kept::KeptRun;
use crate::cli::results::{Inspection, percent, write_table};
use crate::evolve::FrameReport;
use crate::scene::split_setting;

/// A run that has ended.
pub(super) struct Row<'a> {
    pub run: &'a Run,
    /// Of all the times that it was gone on with.
    pub seconds: f64,
    /// `None` if there is no film.
    pub inspection: Option<Inspection>,
}

impl<'a> From<(&'a KeptRun, Option<Inspection>)> for Row<'a> {
    fn from((KeptRun { run, seconds }, inspection): (&'a KeptRun, Option<Inspection>)) -> Row<'a> {
        Row { run, seconds: *seconds, inspection }
    }
}

impl Row<'_> {
    pub fn last(&self) -> Option<&FrameReport> {
        self.inspection.as_ref()?.frames.last()
    }

    /// Whether all checks of the scene hold: "-" if it states none.
    pub fn checks(&self) -> &'static str {
        match self.inspection.as_ref().map(|inspection| &inspection.checks) {
            None => "NO",
            Some(checks) if checks.is_empty() => "-",
            Some(checks) if checks.iter().all(|check| check.holds) => "yes",
            Some(_) => "NO",
        }
    }

    /// Whether all of its frames are there.
    pub fn is_whole(&self) -> bool {
        self.inspection.as_ref().is_some_and(|inspection| inspection.is_whole())
    }

    /// What sets it apart, and class and length error, for a picture. A class that is what was asked for is said once.
    pub fn captions(&self) -> [String; 2] {
        let name = self.run.name.replace(',', ", ");
        let Some(last) = self.last() else { return [name, String::new()] };
        let class = if last.spin_class.is_empty() { String::new() } else { format!("class {}, ", last.spin_class) };
        let is_said = name == format!("spin.class={}", last.spin_class);
        [if is_said { String::new() } else { name }, format!("{class}{}", percent(last.l2_length_error))]
    }

    /// In one line.
    pub fn in_words(&self) -> String {
        let Some(last) = self.last() else { return "there is no film".to_owned() };
        let class = if last.spin_class.is_empty() { String::new() } else { format!(", class {}", last.spin_class) };
        format!(
            "length error {}, {} rims, {} pinch points{class}",
            percent(last.l2_length_error),
            last.rims,
            last.pinch_points
        )
    }
}

/// The columns of the last frame: heading and value, numbers as they are.
type Column = (&'static str, fn(&FrameReport) -> String);
const COLUMNS: [Column; 14] = [
    ("frames", |last| last.frame.to_string()),
    ("l2_length_error", |last| last.l2_length_error.to_string()),
    ("median_length_error", |last| last.median_length_error.to_string()),
    ("p95_length_error", |last| last.p95_length_error.to_string()),
    ("max_length_error", |last| last.max_length_error.to_string()),
    ("rims", |last| last.rims.to_string()),
    ("pinch_points", |last| last.pinch_points.to_string()),
    ("asked_class", |last| last.asked_class.clone()),
    ("class", |last| last.spin_class.clone()),
    ("energy", |last| last.energy.to_string()),
    ("rms_bending_error", |last| last.bending_error.map(|error| error.rms_degrees.to_string()).unwrap_or_default()),
    ("steps", |last| last.cursor.steps.to_string()),
    ("restarts", |last| last.cursor.restarts.to_string()),
    ("converged", |last| if last.converged { "yes" } else { "NO" }.to_owned()),
];

/// A table of comma-separated values: a line a run, first its folder and the keys that were set.
pub(super) fn csv(rows: &[Row]) -> String {
    let Some(first) = rows.first() else { return String::new() };
    let mut heading = vec!["run"];
    heading.extend(first.run.settings.iter().map(|setting| key_of(setting)));
    heading.extend(COLUMNS.iter().map(|(title, _)| *title));
    heading.extend(["seconds", "checks"]);
    let mut lines = vec![line(heading.into_iter().map(str::to_owned))];
    for row in rows {
        let mut cells = vec![row.run.name.clone()];
        cells.extend(row.run.settings.iter().map(|setting| value_of(setting).to_owned()));
        cells.extend(COLUMNS.iter().map(|(_, value)| row.last().map(value).unwrap_or_default()));
        cells.extend([format!("{:.1}", row.seconds), row.checks().to_owned()]);
        lines.push(line(cells.into_iter()));
    }
    lines.concat()
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let quoted = |cell: String| {
        if cell.contains([',', '"', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
    };
    cells.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

pub(super) fn key_of(setting: &str) -> &str {
    split_setting(setting).map_or(setting, |(key, _)| key)
}

pub(super) fn value_of(setting: &str) -> &str {
    split_setting(setting).map_or("", |(_, value)| value)
}

/// The same for people.
pub(super) fn write_rows(out: &mut impl Write, rows: &[Row]) -> io::Result<()> {
    let Some(first) = rows.first() else { return Ok(()) };
    let keys: Vec<String> = first.run.settings.iter().map(|setting| key_of(setting).to_owned()).collect();
    let titles = ["L2 error", "max error", "rims", "pinch points", "class", "steps", "seconds", "checks"];
    let mut table = vec![keys.into_iter().chain(titles.map(str::to_owned)).collect::<Vec<_>>()];
    for row in rows {
        let mut cells: Vec<String> = row.run.settings.iter().map(|setting| value_of(setting).to_owned()).collect();
        match row.last() {
            Some(last) => cells.extend([
                percent(last.l2_length_error),
                percent(last.max_length_error),
                last.rims.to_string(),
                last.pinch_points.to_string(),
                if last.spin_class.is_empty() { "-".to_owned() } else { last.spin_class.clone() },
                last.cursor.steps.to_string(),
            ]),
            None => cells.extend(std::iter::repeat_n("-".to_owned(), 6)),
        }
        cells.extend([format!("{:.1}", row.seconds), row.checks().to_owned()]);
        table.push(cells);
    }
    write_table(out, &table, &["class", "checks"])
}

/// Reads the film of a run.
pub(super) fn row_of<'a>(folder: &Path, kept: &'a KeptRun) -> Row<'a> {
    Row::from((kept, Inspection::of(&folder.join(&kept.run.name)).ok()))
}
