//! The reference of all keys of a scene as a page of Markdown, from the very declarations that read them.

use std::fmt::Write;

use super::data::Scene;
use super::keys::{Bounds, Field, Kind, declared};
use super::sections::root;

const PREFACE: &str = "\
# Scene reference

Every key that a scene can have, section by section. [Scenes](scenes.md) tells the same as a story, and the
[cookbook](cookbook.md) by examples. This page is written by the program from the declarations by which it reads scenes, so
that it says what the program does: `immerse schema --markdown`. `immerse schema` gives the same to editors, as a JSON schema.

**How to read it.** `[name]` is a table that stands once, `[[name]]` one that can stand several times. All keys can be left out
unless *required* stands there; then the value in the third column counts, or what the description says. A key that is not
here is a mistake, and `immerse check` says which one may have been meant.

**Units.** Lengths, positions and radii are in the unit of the scene, which is up to you; curvatures are per length squared. Angles are in degrees.
Times are those of the clock, which runs from `start` to `end`, 0 to 1 unless `[clock]` says otherwise. Errors are ratios: 0.01 is one per
cent. Colours are sRGB, `\"#RRGGBB\"`. Vertices, edges and faces are counted from 0. Paths of files are relative to the scene.

**Formulas** are texts such as `\"length * (1 + 0.2 * z)\"`, with `+ - * / ^`, parentheses, `sin`, `cos`, `tan`, their inverses
and hyperbolic ones (`asin`, `sinh`, `asinh`), `atan2(y, x)`, `min(a, b)`, `max(a, b)`, `exp`, `ln`, `log2`, `log10`, `sqrt`, `cbrt`, `abs`, `signum`, `floor`, `ceil`, `round`, `trunc`,
`fract`, `PI`, `TAU` and `E`, the names that the description lists, and those of `[parameters]`. No number of a scene is above 10¹⁵ in size.
";

const CHANGING: &str = "\
## Numbers that change

Where this page says *number, formula or keyframes*, there stands a number, `0.3`; or a formula of the time `t` and of parameters, `\"0.3 * t\"`;
or a table of values at times:
";

impl Scene {
    /// A page of Markdown that lists every section and key of a scene file: what it takes, its default, its meaning.
    pub fn reference() -> String {
        let fields = declared(root);
        let mut page = PREFACE.to_owned();
        let is_section = |field: &&Field| inner(&field.kind).is_some() || matches!(field.kind, Kind::Map(_));
        let (sections, keys): (Vec<&Field>, Vec<&Field>) = fields.iter().partition(is_section);
        page.push_str("\n## Sections\n\n| section | what it says |\n|---|---|\n");
        for field in &sections {
            let title = title(field.name, &field.kind);
            let _ = writeln!(page, "| [`{title}`](#{}) | {} |", anchor(&title), prose(first_sentence(field.doc)));
        }
        page.push_str("\nBefore any section:\n\n");
        write_keys(&mut page, "", keys);
        page.push('\n');
        page.push_str(CHANGING);
        if let Some(keyframes) = fields.iter().find_map(|field| keyframes(&field.kind)) {
            page.push('\n');
            write_keys(&mut page, "", keyframes);
        }
        sections.into_iter().for_each(|field| write_table(&mut page, "##", field.name, field));
        page
    }
}

/// The keys of a table, or of each table of a list.
fn inner(kind: &Kind) -> Option<&[Field]> {
    match kind {
        Kind::Table(fields) | Kind::Tables(fields) => Some(fields),
        _ => None,
    }
}

/// The keys of keyframes, if such can stand there.
fn keyframes(kind: &Kind) -> Option<&[Field]> {
    match kind {
        Kind::ChangingNumber(_, fields) => Some(fields),
        Kind::Map(item) => keyframes(item),
        _ => None,
    }
}

/// The brackets of a table, as they stand in a scene.
fn title(path: &str, kind: &Kind) -> String {
    if matches!(kind, Kind::Tables(_)) { format!("[[{path}]]") } else { format!("[{path}]") }
}

/// Where a heading is linked to: its letters and digits, with hyphens for blanks.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    heading.to_lowercase().chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// A table of a scene, the tables in it, and what else stands in it depending on a name.
fn write_table(page: &mut String, level: &str, path: &str, field: &Field) {
    let _ = write!(page, "\n{level} `{}`\n\n{}\n", title(path, &field.kind), prose(field.doc));
    if let Kind::Map(item) = &field.kind {
        let _ = writeln!(page, "\nIts keys are names of your own; each takes a {}.", takes(item, ""));
    }
    write_fields(page, path, &title(path, &field.kind), inner(&field.kind).unwrap_or_default());
}

fn write_fields(page: &mut String, path: &str, table: &str, fields: &[Field]) {
    if !fields.is_empty() {
        page.push('\n');
        write_keys(page, path, fields);
    }
    for field in fields.iter().filter(|field| inner(&field.kind).is_some()) {
        write_table(page, "###", &format!("{path}.{}", field.name), field);
    }
    for field in fields {
        let Kind::Variants(variants) = &field.kind else { continue };
        for variant in variants {
            let heading = of_variant(table, field.name, variant.name);
            let _ = write!(page, "\n### {heading}\n\n{}\n", prose(variant.doc));
            write_fields(page, path, table, &variant.fields);
        }
    }
}

fn of_variant(table: &str, key: &str, name: &str) -> String {
    format!("`{table}` with `{key} = \"{name}\"`")
}

fn write_keys<'f>(page: &mut String, path: &str, fields: impl IntoIterator<Item = &'f Field>) {
    page.push_str("| key | takes | left out | meaning |\n|---|---|---|---|\n");
    for field in fields {
        let left_out = match &field.default {
            _ if field.required => "*required*".to_owned(),
            Some(default) => format!("`{}`", default_as_toml(default)),
            None => "—".to_owned(),
        };
        let (name, takes, meaning) = (field.name, takes_here(path, field), prose(field.doc));
        let _ = writeln!(page, "| `{name}` | {takes} | {left_out} | {meaning} |");
    }
}

/// What a key takes, with links to the tables that it opens.
fn takes_here(path: &str, field: &Field) -> String {
    let nested = format!("{path}.{}", field.name);
    match &field.kind {
        Kind::Table(_) | Kind::Tables(_) => {
            let title = title(&nested, &field.kind);
            let what = if matches!(field.kind, Kind::Tables(_)) { "tables" } else { "a table" };
            format!("{what}, [`{title}`](#{})", anchor(&title))
        }
        Kind::Variants(variants) => {
            let table = if path.contains('.') { format!("[[{path}]]") } else { format!("[{path}]") };
            let link = |name: &str| format!("[`\"{name}\"`](#{})", anchor(&of_variant(&table, field.name, name)));
            variants.iter().map(|variant| link(variant.name)).collect::<Vec<_>>().join(", ")
        }
        kind => takes(kind, ""),
    }
}

/// What a value may be, in few words; `s` makes them a plural.
fn takes(kind: &Kind, s: &str) -> String {
    match kind {
        Kind::Number(bounds) => format!("number{s}{}", within(bounds)),
        Kind::Integer(bounds) => format!("integer{s}{}", within(bounds)),
        Kind::Flag => "`true` or `false`".into(),
        Kind::Text => format!("text{s}"),
        Kind::Color => format!("colour{s} `\"#RRGGBB\"`"),
        Kind::Choice(names) => quoted(names),
        Kind::OneOrMore(names) => format!("{}, or a list of them", quoted(names)),
        Kind::Array { item, length } => {
            let (length, s) = (length.map_or(String::new(), |length| format!("{length} ")), &format!("list{s} of"));
            format!("{s} {length}{}", takes(item, "s"))
        }
        Kind::ChangingNumber(bounds, _) => {
            format!("number{}, [formula or keyframes](#numbers-that-change)", within(bounds))
        }
        Kind::Either(one, other) => format!("{}, or {}", takes(one, s), takes(other, s)),
        Kind::TablesLike(anchor) => format!("tables with the keys of `{anchor}`"),
        Kind::Map(_) | Kind::Table(_) => "a table".into(),
        Kind::Tables(_) => "tables".into(),
        Kind::Variants(variants) => quoted(&variants.iter().map(|variant| variant.name).collect::<Vec<_>>()),
    }
}

fn quoted(names: &[&str]) -> String {
    names.iter().map(|name| format!("`\"{name}\"`")).collect::<Vec<_>>().join(", ")
}

fn within(bounds: &Bounds) -> String {
    let low = bounds.low.map(|(low, open)| format!(" {} {low}", if open { ">" } else { "≥" }));
    let high = bounds.high.map(|(high, open)| format!(" {} {high}", if open { "<" } else { "≤" }));
    low.into_iter().chain(high).collect::<Vec<_>>().join(" and")
}

/// A default as a scene would say it.
fn default_as_toml(default: &serde_json::Value) -> String {
    match default {
        serde_json::Value::Object(entries) => {
            let entries: Vec<_> =
                entries.iter().map(|(key, value)| format!("{key} = {}", default_as_toml(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        serde_json::Value::Array(list) => {
            format!("[{}]", list.iter().map(default_as_toml).collect::<Vec<_>>().join(", "))
        }
        // A whole number needs no point.
        serde_json::Value::Number(number) => number.as_f64().map_or(number.to_string(), |number| number.to_string()),
        other => other.to_string(),
    }
}

fn first_sentence(doc: &str) -> &str {
    doc.find(". ").map_or(doc, |end| &doc[..=end])
}

/// A description in a cell of a table.
fn prose(doc: &str) -> String {
    doc.replace('|', "\\|").replace('*', "\\*")
}
