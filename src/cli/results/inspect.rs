//! `inspect`: what each computed frame is worth, as tables or as JSON.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde_json::Value as Json;

use super::checks::{Check, check_of_homotopy, checks_of};
use super::text_table::{percent, short, write_table};
use crate::evolve::FrameReport;
use crate::film::{Arrivals, DiskError, FilmFolder, MeshCounts, certificate_of};
use crate::polish::{Ending, PolishReport};
use crate::scene::ChecksSection;

/// What `inspect --json` prints.
#[derive(Debug, Serialize)]
pub(in crate::cli) struct Inspection {
    mesh: MeshCounts,
    pub frames: Vec<FrameReport>,
    pub checks: Vec<Check>,
    /// How many frames the film is to have.
    #[serde(skip)]
    frame_count: usize,
    /// What the scene asks for.
    #[serde(skip)]
    pub asked: ChecksSection,
    /// Frames that are there but do not verify. Said on standard error.
    #[serde(skip)]
    pub damaged: Vec<DiskError>,
}

impl Inspection {
    /// Reads and verifies all frames of a film.
    pub fn of(folder: &Path) -> Result<Inspection, DiskError> {
        let film = FilmFolder::open(folder)?;
        let (mut frames, mut damaged) = (Vec::new(), Vec::new());
        for frame in film.frames()? {
            match film.read_report(frame) {
                Ok(report) => frames.push(report),
                Err(error) => damaged.push(error),
            }
        }
        let manifest = film.manifest();
        let mut checks = checks_of(&manifest.checks, &frames);
        if manifest.checks.film.regular_homotopy == Some(true) {
            let certificate = certificate_of(&film, &Arrivals::over(), &mut |_| ());
            checks.extend(check_of_homotopy(&manifest.checks, &certificate));
        }
        let (mesh, frame_count, asked) = (manifest.mesh, manifest.frame_count, manifest.checks.clone());
        Ok(Inspection { mesh, frames, checks, frame_count, asked, damaged })
    }

    /// Whether all frames of the film are there.
    pub fn is_whole(&self) -> bool {
        self.frames.len() == self.frame_count
    }

    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, self)?;
        writeln!(out)
    }

    pub fn write_tables(&self, out: &mut impl Write) -> io::Result<()> {
        let MeshCounts { vertices, edges, faces, genus, boundaries } = self.mesh;
        writeln!(out, "{vertices} vertices, {edges} edges, {faces} faces, genus {genus}, {boundaries} boundary loops")?;
        writeln!(out)?;
        let heading = [
            "frame",
            "time",
            "L2 error",
            "max error",
            "rims",
            "rim length",
            "pinch points",
            "class",
            "energy",
            "steps",
            "converged",
        ];
        let mut rows = vec![heading.map(str::to_owned).to_vec()];
        rows.extend(self.frames.iter().map(row));
        for (title, value) in EXTRAS {
            // Columns for what only some films have.
            if self.frames.iter().any(|report| value(report).is_some()) {
                rows[0].push(title.to_owned());
                let cells = self.frames.iter().map(|report| value(report).unwrap_or_else(|| "-".to_owned()));
                rows[1..].iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
            }
        }
        write_table(out, &rows, &["class"])?;
        self.write_components(out)?;
        if !self.checks.is_empty() {
            writeln!(out)?;
            self.write_checks(out)?;
        }
        Ok(())
    }

    /// The components of the last frame, where there are several.
    fn write_components(&self, out: &mut impl Write) -> io::Result<()> {
        let components = self.frames.last().map_or(&[][..], |last| &last.components);
        if components.is_empty() {
            return Ok(());
        }
        let heading =
            ["component", "faces", "L2 error", "max error", "rims", "pinch points", "steps", "restarts", "converged"];
        let mut rows = vec![heading.map(str::to_owned).to_vec()];
        for (k, component) in components.iter().enumerate() {
            rows.push(vec![
                (k + 1).to_string(),
                component.faces.to_string(),
                percent(component.l2_length_error),
                percent(component.max_length_error),
                component.rims.to_string(),
                component.pinch_points.to_string(),
                component.cursor.steps.to_string(),
                component.cursor.restarts.to_string(),
                if component.converged { "yes" } else { "NO" }.to_owned(),
            ]);
        }
        writeln!(out)?;
        write_table(out, &rows, &[])
    }

    pub fn write_checks(&self, out: &mut impl Write) -> io::Result<()> {
        let shown = |value: &Json| match value {
            Json::Null => "no frame".to_owned(),
            Json::String(text) => text.clone(),
            Json::Number(number) if number.is_f64() => number.as_f64().map_or_else(String::new, short),
            other => other.to_string(),
        };
        let mut rows = vec![["check", "limit", "value", "holds"].map(str::to_owned).to_vec()];
        for check in &self.checks {
            let holds = if check.holds { "yes" } else { "NO" };
            rows.push(vec![check.name.to_owned(), shown(&check.limit), shown(&check.value), holds.to_owned()]);
        }
        write_table(out, &rows, &["check", "holds"])
    }

    /// One line for the end of a run.
    pub fn write_summary(&self, out: &mut impl Write) -> io::Result<()> {
        let Some(last) = self.frames.last() else { return writeln!(out, "no frames") };
        writeln!(
            out,
            "{} frames; the last one has length error {} (max {}), {} rims, {} pinch points{}",
            self.frames.len(),
            percent(last.l2_length_error),
            percent(last.max_length_error),
            last.rims,
            last.pinch_points,
            if last.spin_class.is_empty() { String::new() } else { format!(", class {}", last.spin_class) },
        )?;
        if let Some(polish) = &last.polish {
            writeln!(out, "{}", in_words(polish))?;
        }
        match last.cursor.restarts {
            0 => {}
            1 => writeln!(out, "frames were drawn anew once, because rims were left")?,
            times => writeln!(out, "frames were drawn anew {times} times, because rims were left")?,
        }
        if last.cursor.mirrored {
            writeln!(out, "random frames ended in the mirror image, which was turned the right side out")?;
        }
        Ok(())
    }
}

/// What polish did, in a sentence.
fn in_words(polish: &PolishReport) -> String {
    let PolishReport { l2_length_error_before, mean_bending_before, mean_bending, steps, ending, .. } = *polish;
    let why = match ending {
        Ending::Isometric => "edges have their lengths up to rounding",
        Ending::BestFit => "this is the best fit nearby",
        Ending::BendingLimit => "a better fit would bend it by more than `max_bending_growth` allows",
        Ending::StepLimit => "it was to take no more steps",
        Ending::Unchanged => {
            return "it was not polished: it is pinched, has rims or another class, or polish found nothing better"
                .into();
        }
    };
    let steps = format!("{steps} step{}", if steps == 1 { "" } else { "s" });
    format!(
        "polished from {} in {steps}, mean bending angle {mean_bending_before:.2}° before and {mean_bending:.2}° after: {why}",
        percent(l2_length_error_before)
    )
}

/// A heading, and what a frame has below it.
type Column = (&'static str, fn(&FrameReport) -> Option<String>);

/// Columns that are left out where no frame has a value.
const EXTRAS: [Column; 6] = [
    ("before polish", |report| report.polish.map(|polish| percent(polish.l2_length_error_before))),
    ("mean bending", |report| report.polish.map(|polish| format!("{:.2}°", polish.mean_bending))),
    ("angle error", |report| report.bending_error.map(|error| format!("{:.2}°", error.rms_degrees))),
    ("max angle error", |report| report.bending_error.map(|error| format!("{:.2}°", error.max_degrees))),
    ("largest dent", |report| report.largest_dent.map(short)),
    ("volume", |report| report.enclosed_volume.map(short)),
];

fn row(report: &FrameReport) -> Vec<String> {
    vec![
        report.frame.to_string(),
        short(report.time),
        percent(report.l2_length_error),
        percent(report.max_length_error),
        report.rims.to_string(),
        short(report.rim_length),
        report.pinch_points.to_string(),
        if report.spin_class.is_empty() { "-".to_owned() } else { report.spin_class.clone() },
        short(report.energy),
        report.cursor.steps.to_string(),
        if report.converged { "yes" } else { "NO" }.to_owned(),
    ]
}
