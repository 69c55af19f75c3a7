//! What the page of a film says first: what is wrong, in sentences, and what was asked for.

use serde_json::Value as Json;

use super::checks::{Check, step_limit_line};
use super::inspect::Inspection;
use super::text_table::{percent, short};
use super::verdict::verdict;
use crate::film::{Finding, Findings};

/// What is to be said of a film of this name.
pub(in crate::cli) fn findings(inspection: &Inspection, scene: &str) -> Findings {
    let Inspection { frames, checks, asked, damaged, .. } = inspection;
    let broken = checks.iter().filter(|check| !check.holds).map(sentence);
    let lines = [step_limit_line(frames), verdict(frames, asked)].into_iter().flatten().map(|line| ended(&line));
    let damaged = damaged.iter().map(|error| ended(&error.to_string()));
    Findings {
        faults: broken.chain(lines).chain(damaged).collect(),
        checks: checks.iter().map(finding).collect(),
        command: format!("immerse run {scene}.toml"),
    }
}

fn finding(check: &Check) -> Finding {
    Finding {
        name: check.name.to_owned(),
        limit: shown(check.name, &check.limit),
        value: shown(check.name, &check.value),
        holds: check.holds,
    }
}

/// A check that does not hold.
fn sentence(check: &Check) -> String {
    let (limit, value) = (shown(check.name, &check.limit), shown(check.name, &check.value));
    let asked = if check.name == "class" { "" } else { "at most " };
    let reason = check.reason.as_ref().map(|reason| format!(": {reason}")).unwrap_or_default();
    ended(&format!("{} is {value}, and the scene asks for {asked}{limit}{reason}", subject(check.name)))
}

/// What a check is about.
fn subject(name: &str) -> String {
    let (key, where_) = match name.strip_prefix("film.") {
        Some(key) => (key, "in all frames"),
        None => (name, "in the last frame"),
    };
    let what = match key {
        "max_l2_length_error" => "the length error (root mean square)",
        "median_l2_length_error" => return "The median over all frames of the length error".to_owned(),
        "max_rims" => "the number of rims",
        "max_pinch_points" => "the number of pinch points",
        "class" => return "The class".to_owned(),
        "max_curvature_error" => "the distance of curvatures from their targets in radians",
        "max_mean_distance" => "the mean distance from the original over its diameter",
        "max_pin_distance" => "the distance of a pinned vertex from its place",
        "rms_bending_error" => "the error of bending angles in degrees (root mean square)",
        "max_bending_error" => "the largest error of a bending angle in degrees",
        "max_unconverged" => return "The number of frames that ran into the limit of steps".to_owned(),
        "max_jump" => return "The largest move between two frames, over the usual one,".to_owned(),
        other => other,
    };
    let mut text = format!("{what} {where_}");
    text[..1].make_ascii_uppercase();
    text
}

/// A limit or a value; errors of lengths are ratios.
fn shown(name: &str, value: &Json) -> String {
    match value {
        Json::Null => "not known".to_owned(),
        Json::String(text) => text.clone(),
        Json::Number(number) => match number.as_f64() {
            Some(x) if name.ends_with("l2_length_error") => percent(x),
            Some(x) if number.is_f64() => short(x),
            _ => number.to_string(),
        },
        other => other.to_string(),
    }
}

/// As a sentence.
fn ended(text: &str) -> String {
    let mut letters = text.trim_end_matches('.').chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", letters.as_str())
}
