//! A scene as one text again, which says all that its texts say together.

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// The text of a table of keys: what stands alone first, then tables with a line for each of their keys. A comment above says
/// what it was put together of.
pub(in crate::scene) fn as_text(tree: &DeTable, parts: &[String]) -> String {
    let shown = |part: &String| part.replace(char::is_control, " ");
    let parts: Vec<String> = parts.iter().map(shown).collect();
    let mut text = format!("# Put together of {}.\n", parts.join(", "));
    let entries = in_order(tree);
    for (key, value) in &entries {
        if !matches!(value, DeValue::Table(_)) && tables(value).is_none() {
            text += &format!("{} = {}\n", key_in_text(key), inline(value));
        }
    }
    for (key, value) in entries {
        match (value, tables(value)) {
            (DeValue::Table(table), _) => section(&mut text, &format!("[{}]", key_in_text(key)), table),
            (_, Some(tables)) => {
                tables.iter().for_each(|table| section(&mut text, &format!("[[{}]]", key_in_text(key)), table));
            }
            _ => {}
        }
    }
    text
}

fn section(text: &mut String, header: &str, table: &DeTable) {
    *text += &format!("\n{header}\n");
    for (key, value) in in_order(table) {
        *text += &format!("{} = {}\n", key_in_text(key), inline(value));
    }
}

/// The tables of a list of tables.
fn tables<'t, 'a>(value: &'t DeValue<'a>) -> Option<Vec<&'t DeTable<'a>>> {
    let list = value.as_array().filter(|list| !list.is_empty())?;
    list.iter().map(|element| element.get_ref().as_table()).collect()
}

/// The keys of a table in the order of the texts: parameters may use those before them.
fn in_order<'t, 'a>(table: &'t DeTable<'a>) -> Vec<(&'t str, &'t DeValue<'a>)> {
    let mut entries: Vec<(&Spanned<DeString>, &Spanned<DeValue>)> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries.into_iter().map(|(key, value)| (key.get_ref().as_ref(), value.get_ref())).collect()
}

fn key_in_text(key: &str) -> String {
    let is_bare = !key.is_empty() && key.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-'));
    if is_bare { key.to_owned() } else { quoted(key) }
}

fn inline(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => quoted(text),
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.to_string(),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(date) => date.to_string(),
        DeValue::Array(list) => {
            let elements: Vec<String> = list.iter().map(|element| inline(element.get_ref())).collect();
            format!("[{}]", elements.join(", "))
        }
        DeValue::Table(table) => {
            let entry = |(key, value)| format!("{} = {}", key_in_text(key), inline(value));
            let entries: Vec<String> = in_order(table).into_iter().map(entry).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}

/// A basic string of TOML on one line.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted += &format!("\\U{:08X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
