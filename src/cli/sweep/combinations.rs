//! Which runs a sweep has: every combination of the values that keys are given.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::digest::Digest;
use crate::scene::split_setting;

/// One run of a sweep.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
pub(in crate::cli) struct Run {
    /// The folder of its film among those of the others: what makes it another one than they are.
    pub name: String,
    /// Keys and their values, as they are typed after `--set`.
    pub settings: Vec<String>,
}

/// A longer name is no name of a file everywhere.
const LONGEST_NAME: usize = 120;

/// How many combinations there are.
pub(super) fn count(set: &[String]) -> usize {
    set.iter().map(|text| keys_and_values(text).1.len()).fold(1, usize::saturating_mul)
}

/// All combinations of `key=value,value,…`, the last key changing fastest.
pub(super) fn combinations(set: &[String]) -> Vec<Run> {
    let mut runs: Vec<(Vec<String>, Vec<String>)> = vec![Default::default()];
    for text in set {
        let (key, values) = keys_and_values(text);
        let several = values.len() > 1;
        let with = |(settings, parts): &(Vec<String>, Vec<String>), value: &&str| {
            let setting = if split_setting(text).is_some() { format!("{key}={value}") } else { text.clone() };
            let mut next = (settings.clone(), parts.clone());
            if several {
                next.1.push(setting.clone());
            }
            next.0.push(setting);
            next
        };
        runs = runs.iter().flat_map(|run| values.iter().map(move |value| with(run, value))).collect();
    }
    let mut taken = BTreeSet::new();
    let named = |(settings, parts): (Vec<String>, Vec<String>)| {
        let name = if parts.is_empty() { "run".to_owned() } else { parts.join(",") };
        let mut safe = file_name(&name);
        if safe != name || !taken.insert(safe.to_lowercase()) {
            let digest = Digest::of("run").text(&name).finish().to_string();
            safe = format!("{}-{}", safe, digest.get(..8).unwrap_or_default());
        }
        Run { name: safe, settings }
    };
    runs.into_iter().map(named).collect()
}

/// The key, and its values: what stands between commas outside of quotes and brackets.
fn keys_and_values(text: &str) -> (&str, Vec<&str>) {
    let (key, list) = split_setting(text).unwrap_or((text, ""));
    let (mut values, mut start) = (Vec::new(), 0);
    let (mut depth, mut quote) = (0_usize, None);
    for (place, c) in list.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{' | '(') => depth += 1,
            (None, ']' | '}' | ')') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                values.push(list[start..place].trim());
                start = place + 1;
            }
            _ => {}
        }
    }
    values.push(list[start..].trim());
    (key.trim(), values)
}

/// With letters that every file system takes.
fn file_name(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || "._-=,+".contains(c) { c } else { '_' };
    name.chars().map(safe).take(LONGEST_NAME).collect()
}
