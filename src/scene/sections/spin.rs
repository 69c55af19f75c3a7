//! `[spin]`, and classes elsewhere.

use crate::scene::data::SpinSection;
use crate::scene::keys::Table;

pub(super) fn spin(table: &mut Table) -> SpinSection {
    let doc = "One digit for each generator as `immerse check` lists them, 0 where a strip along it is a plain ring and 1 where it is twisted by a full turn; or \"immersion\", the class of the mesh's positions; or \"all\", all classes one after another, one a frame.";
    match table.key::<String>("class", doc).optional("01".into()) {
        None => SpinSection::Automatic,
        Some(class) if class == "immersion" => SpinSection::Immersion,
        Some(class) if class == "all" => SpinSection::All,
        Some(class) => SpinSection::Digits(binary_digits(table, "class", class)),
    }
}

/// Passes a class on, and reports it if it is not one.
pub(super) fn binary_digits(table: &Table, key: &str, class: String) -> String {
    if !class.bytes().all(|b| matches!(b, b'0' | b'1')) {
        let reason = format!("`{key}` is the string {class:?}, a class has one digit 0 or 1 per generator");
        let also = if table.title() == "[spin]" { ", or \"immersion\" for that of the mesh's positions" } else { "" };
        table.complain(key, reason, format!("write for example {key} = \"01\"{also}"));
    }
    class
}
