//! `files` and `times`, which stand side by side.

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::problems::Problem;
use super::table::Table;
use super::value::{Bounds, Kind, Value};
use crate::scene::data::FilesSection;

/// A text, or a list of texts.
struct Texts(Vec<String>);

impl Value for Texts {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Either(Box::new(String::kind(bounds)), Box::new(Vec::<String>::kind(bounds)))
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Texts, Problem> {
        match value.get_ref() {
            DeValue::Array(list) if list.is_empty() => Err(Problem {
                span: value.span(),
                reason: format!("`{name}` is empty"),
                remedy: format!("write for example {example}"),
            }),
            DeValue::Array(list) => {
                list.iter().map(|text| String::read(name, text, bounds, example)).collect::<Result<_, _>>().map(Texts)
            }
            _ => Ok(Texts(vec![String::read(name, value, bounds, example)?])),
        }
    }

    fn json(&self) -> Json {
        match self.0.as_slice() {
            [only] => only.as_str().into(),
            several => several.into(),
        }
    }
}

/// The keys `files` and `times`; `None` without files.
pub(in crate::scene) fn files(table: &mut Table, doc: &'static str) -> Option<FilesSection> {
    let files = table.key::<Texts>("files", doc).optional(Texts(vec!["pose*.obj".into()]));
    let doc = "Increasing times, one for each of `files`, or for each frame of a FOLD file; left out, they are spread evenly over the clock, and in a film that \
               loops the first one comes again at the end.";
    let times = table.key::<Vec<f64>>("times", doc).optional(vec![0.0, 1.0]);
    if files.is_none() && times.is_some() && !table.has("files") {
        table.complain("times", "`times` are those of `files`, and there are none", "remove it, or add `files`");
    }
    if let Some([earlier, later]) = times.iter().flat_map(|times| times.array_windows()).find(|[a, b]| b <= a) {
        let reason = format!("keyframes are out of order: {later} comes after {earlier}");
        table.complain("times", reason, "sort them, each time greater than the last");
    }
    Some(FilesSection { files: files?.0, times })
}
