//! REPRODUCTION.md: parts that were made now, and those of earlier runs as they were.

use super::request::{Outcome, Request};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

/// What a part says.
#[derive(Clone, Debug, Default)]
pub struct Section {
    /// Its lines of the first table.
    pub summary: Vec<Line>,
    /// Markdown.
    pub body: String,
}

/// A line of the first table.
#[derive(Clone, Debug)]
pub struct Line {
    pub what: String,
    /// Size, error and rims in the paper.
    pub paper: [String; 3],
    /// Size, and errors before and after polish.
    pub ours: [String; 3],
    /// Rims, pinch points, class.
    pub state: String,
    /// In which way it is worse than the paper or not what was asked for; empty if it is neither.
    pub miss: String,
}

impl Line {
    fn row(&self) -> String {
        let Line { what, paper, ours, state, miss } = self;
        let miss = if miss.is_empty() { String::new() } else { format!("**miss**: {miss}") };
        format!("| {what} | {} | {} | {state} | {miss} |", paper.join(" | "), ours.join(" | "))
    }
}

const BEGIN: &str = "<!-- part ";
const ROW: &str = "<!-- row ";
const END: &str = " -->";

/// The page.
pub struct Document {
    path: PathBuf,
    /// By name of the part: a first line that names it, its rows of the first table as comments, and its text.
    parts: BTreeMap<String, String>,
}

impl Document {
    /// With the parts that an earlier run wrote.
    pub fn open(request: &Request) -> Outcome<Document> {
        let path = request.out.join("REPRODUCTION.md");
        let text = if path.exists() { fs::read_to_string(&path)? } else { String::new() };
        let mut parts = BTreeMap::new();
        for piece in text.split(BEGIN).skip(1) {
            if let Some((name, text)) = piece.split_once(END) {
                parts.insert(name.to_owned(), text.trim().to_owned());
            }
        }
        fs::create_dir_all(request.pictures())?;
        Ok(Document { path, parts })
    }

    pub fn put(&mut self, name: &str, title: &str, section: Section, seconds: f64) {
        let mut text = String::new();
        for line in &section.summary {
            let _ = writeln!(text, "{ROW}{}{END}", line.row());
        }
        let _ = write!(text, "## {title}\n\n{}\n\nThis part took {seconds:.0} s.", section.body.trim());
        self.parts.insert(name.to_owned(), text);
    }

    /// Writes the page with its parts in this order: name, title, whether it is long.
    pub fn write(&self, order: &[(&str, &str, bool)]) -> Outcome<()> {
        let texts: Vec<(&str, &String)> =
            order.iter().filter_map(|(name, ..)| Some((*name, self.parts.get(*name)?))).collect();
        let rows: Vec<&str> = texts
            .iter()
            .flat_map(|(_, text)| text.lines())
            .filter_map(|line| line.strip_prefix(ROW)?.strip_suffix(END))
            .collect();
        let missing: Vec<String> = order
            .iter()
            .filter(|(name, ..)| !self.parts.contains_key(*name))
            .map(|(name, title, _)| format!("- {title}: `--only {name}`"))
            .collect();
        let mut page = format!("{}\n\n{HEADER}\n{}\n", introduction(), rows.join("\n"));
        if !missing.is_empty() {
            let _ = write!(page, "\nNot made yet:\n\n{}\n", missing.join("\n"));
        }
        for (name, text) in texts {
            let _ = write!(page, "\n{BEGIN}{name}{END}\n{text}\n");
        }
        Ok(fs::write(&self.path, page)?)
    }
}

const HEADER: &str = "\
| figure | paper: faces | L2 error | rims | here: faces | L2 before polish | after | rims, pinch points, class | |
|---|--:|--:|--:|--:|--:|--:|---|---|";

fn introduction() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "# The paper made again

Figures and tables of *Shape from Metric* (Chern, Knöppel, Pinkall, Schröder 2018), made by

    cargo run --release --example reproduce
    cargo run --release --example reproduce -- --only fig14     # one part; the others stay as they are
    cargo run --release --example reproduce -- --only fig20     # the eversion, which is left out otherwise; or --all

With `--paper-data DIR`, a folder with the meshes that come with the paper (`bunny.obj`, `torus.obj`), these are taken; without it
surfaces that ship stand in, and the text says which it was. What is measured here is the same on every machine but for seconds; those
are wall seconds on {cores} cores, whatever else these had to do.

Errors are relative errors of edge lengths: L2 is the root of their mean square, p95 the 95th percentile of their absolute values.
Rims are edges where the surface folds over, pinch points are vertices whose star is a figure eight; the paper counts rims only.
Where frames start at random, all of seeds 0 to 4 are run, and a line has the median and the worst of them by L2 error.
Polish is a last step that moves positions alone, toward exact lengths. A miss is a line with rims, pinch points, another class than
was asked for, or a larger error than the paper's."
    )
}
