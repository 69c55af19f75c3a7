//! Numbers that change with time: a number, a formula or keyframes.

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::problems::{Problem, Problems};
use super::table::{Table, declared};
use super::value::{Bounds, Kind, Value, shown};
use crate::scene::data::NumberSection;
use crate::timeline::{Ease, Extrapolation};

impl Value for NumberSection {
    fn kind(bounds: Bounds) -> Kind {
        Kind::ChangingNumber(bounds, declared(keyframes))
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<NumberSection, Problem> {
        match value.get_ref() {
            DeValue::String(text) => Ok(NumberSection::Formula(text.to_string())),
            DeValue::Table(entries) => {
                let problems = Problems::default();
                let mut table = Table::new(format!("`{name}`"), Some(entries), value.span(), &problems);
                let section = keyframes(&mut table);
                table.finish();
                drop(table);
                problems.into_listed().into_iter().next().map_or(Ok(section), |(problem, _)| Err(problem))
            }
            DeValue::Float(_) | DeValue::Integer(_) => {
                f64::read(name, value, bounds, example).map(NumberSection::Constant)
            }
            other => Err(Problem {
                span: value.span(),
                reason: format!("`{name}` is {}, it must be {}", shown(other), Self::kind(bounds).sentence()),
                remedy: format!("write for example {example}"),
            }),
        }
    }

    fn json(&self) -> Json {
        match self {
            NumberSection::Constant(number) => (*number).into(),
            NumberSection::Formula(text) => text.as_str().into(),
            NumberSection::Keyframes { times, values, .. } => {
                serde_json::json!({ "times": times, "values": values })
            }
        }
    }
}

fn keyframes(table: &mut Table) -> NumberSection {
    let (times, ease) = times(table);
    let values = table.key::<Vec<f64>>("values", "One value for each time.").required(vec![0.0, 1.0]);
    let extrapolation = extrapolation(table);
    if table.has("values") {
        one_per_time(table, "values", values.len(), times.len());
    }
    NumberSection::Keyframes { times, values, ease, extrapolation }
}

/// `times` and `ease`.
pub(in crate::scene) fn times(table: &mut Table) -> (Vec<f64>, Ease) {
    let times = table
        .key::<Vec<f64>>("times", "Times of the keyframes, each greater than the one before.")
        .required(vec![0.0, 1.0]);
    if let Some([earlier, later]) = times.array_windows().find(|[earlier, later]| later <= earlier) {
        let reason = format!("keyframes are out of order: {later} comes after {earlier}");
        table.complain("times", reason, "sort them, each time greater than the last");
    } else if times.is_empty() {
        table.complain("times", "`times` is empty", "give at least one time");
    }
    (times, ease(table))
}

pub(in crate::scene) fn ease(table: &mut Table) -> Ease {
    let names = [("linear", Ease::Linear), ("smooth", Ease::Smooth), ("in", Ease::In), ("out", Ease::Out)];
    let doc = "How values pass from one keyframe to the next: at constant speed (linear), slowly at both ends (smooth), slowly \
               at first (in), or slowly at last (out).";
    table.choice_or("ease", doc, &names, Ease::default())
}

pub(in crate::scene) fn extrapolation(table: &mut Table) -> Extrapolation {
    let names = [("hold", Extrapolation::Hold), ("linear", Extrapolation::Linear), ("repeat", Extrapolation::Repeat)];
    let doc = "Before the first and after the last keyframe: the value there is held, goes on in a straight line, or all \
               starts over.";
    table.choice_or("extrapolation", doc, &names, Extrapolation::default())
}

/// Reports a list that does not have one entry per time.
pub(in crate::scene) fn one_per_time(table: &Table, name: &str, entries: usize, times: usize) {
    if entries != times && table.has("times") {
        table.complain(name, format!("there are {entries} entries for {times} times"), "give one per time");
    }
}
