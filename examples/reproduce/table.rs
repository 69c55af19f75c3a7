//! Tables of what was found, and lines of the first table.

use super::document::Line;
use super::solve::Found;
use immerse::evolve::{FrameReport, NO_CLASS};
use std::fmt::Write;

/// What the paper says of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Paper {
    pub faces: usize,
    pub l2_percent: f64,
    pub rims: usize,
}

/// `0.451 %`, with three digits that count.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        0.0 => "0 %".into(),
        _ if percent < 1e-4 => format!("{percent:.1e} %"),
        _ if percent < 1e-2 => format!("{percent:.5} %"),
        _ if percent < 1.0 => format!("{percent:.3} %"),
        _ => format!("{percent:.2} %"),
    }
}

/// `1 rim`, `2 rims`.
pub fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

const HEADER: &str = "\
| | faces | L2 | p95 | max | rims | pinch points | class asked → found | mean bending | steps | seconds |
|---|--:|--:|--:|--:|--:|--:|---|--:|--:|--:|";

/// A table of surfaces.
#[derive(Default)]
pub struct Table {
    rows: String,
}

impl Table {
    pub fn add(&mut self, what: &str, found: &Found) {
        self.add_measured(
            what,
            found.mesh.face_count(),
            found.report(),
            found.bending_degrees,
            found.steps,
            found.seconds,
        );
    }

    pub fn add_measured(
        &mut self,
        what: &str,
        faces: usize,
        report: &FrameReport,
        bending_degrees: f64,
        steps: usize,
        seconds: f64,
    ) {
        let class = match (report.asked_class.as_str(), report.spin_class.as_str()) {
            ("", "" | NO_CLASS) => "–".to_owned(),
            ("", found) => found.to_owned(),
            (asked, found) => format!("{asked} → {found}"),
        };
        let FrameReport { l2_length_error, p95_length_error, max_length_error, rims, pinch_points, .. } = report;
        let [l2, p95, max] = [l2_length_error, p95_length_error, max_length_error].map(|error| percent(*error));
        let _ = writeln!(
            self.rows,
            "| {what} | {faces} | {l2} | {p95} | {max} | {rims} | {pinch_points} | {class} | {bending_degrees:.1}° | {steps} | {seconds:.1} |"
        );
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{HEADER}\n{}", self.rows)
    }
}

/// The same thing found several times, from different seeds or only once, sorted by error.
pub struct Sorted(Vec<Found>);

impl Sorted {
    pub fn new(mut all: Vec<Found>) -> Sorted {
        all.sort_by(|a, b| a.l2().total_cmp(&b.l2()));
        Sorted(all)
    }

    pub fn median(&self) -> &Found {
        &self.0[self.0.len() / 2]
    }

    pub fn worst(&self) -> &Found {
        &self.0[self.0.len() - 1]
    }

    pub fn is_single(&self) -> bool {
        self.0.len() == 1
    }

    pub fn all(&self) -> &[Found] {
        &self.0
    }

    /// `0.45 %`, or median and worst.
    fn errors(&self) -> String {
        let [median, worst] = [self.median(), self.worst()].map(|found| percent(found.l2()));
        if self.is_single() { median } else { format!("{median}, worst {worst}") }
    }
}

/// The columns of ours: number of faces, and what is said of errors before polish and after, if there is an after.
pub fn ours(faces: usize, errors: &[String]) -> [String; 3] {
    let error = |stage: usize| errors.get(stage).cloned().unwrap_or("–".into());
    [faces.to_string(), error(0), error(1)]
}

/// The line of a figure in the first table. `before` and `after` polish; `after` is empty where there is no polish.
pub fn line(what: &str, paper: Option<Paper>, before: &Sorted, after: Option<&Sorted>) -> Line {
    let best = after.unwrap_or(before);
    let most =
        |value: fn(&FrameReport) -> usize| best.all().iter().map(|found| value(found.report())).max().unwrap_or(0);
    let (rims, pinches) = (most(|report| report.rims), most(|report| report.pinch_points));
    let report = best.median().report();
    let is_other = |found: &Found| found.report().asked_class != found.report().spin_class;
    let others = best.all().iter().filter(|found| is_other(found)).count();
    let mut miss = Vec::new();
    if rims > 0 {
        miss.push(count(rims, "rim"));
    }
    if pinches > 0 {
        miss.push(count(pinches, "pinch point"));
    }
    if others > 0 && pinches == 0 {
        miss.push(format!("{others} of {} in another class", best.all().len()));
    }
    if let Some(paper) = paper
        && 100.0 * best.worst().l2() > paper.l2_percent
    {
        miss.push("larger error".into());
    }
    let class = if report.asked_class.is_empty() { String::new() } else { format!(", class {}", report.spin_class) };
    Line {
        what: what.into(),
        paper: paper.map_or(["–", "–", "–"].map(str::to_owned), |paper| {
            [paper.faces.to_string(), format!("{} %", paper.l2_percent), paper.rims.to_string()]
        }),
        ours: [best.median().mesh.face_count().to_string(), before.errors(), after.map_or("–".into(), Sorted::errors)],
        state: format!("{rims}, {pinches}{class}"),
        miss: miss.join(", "),
    }
}
