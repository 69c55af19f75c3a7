//! The page: markup, style and scripts, with a film put into them.

use serde_json::Value as Json;

use super::streams::Stream;

const MARKUP: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/style.css");
/// In the order in which they use each other.
const SCRIPTS: [&str; 10] = [
    include_str!("page/words.js"),
    include_str!("page/unpack.js"),
    include_str!("page/camera.js"),
    include_str!("page/shaders.js"),
    include_str!("page/picture.js"),
    include_str!("page/surface.js"),
    include_str!("page/viewer.js"),
    include_str!("page/curves.js"),
    include_str!("page/tables.js"),
    include_str!("page/main.js"),
];

/// All that a page is made of beside its film, for its key.
pub(super) fn parts() -> impl Iterator<Item = &'static str> {
    [MARKUP, STYLE].into_iter().chain(SCRIPTS)
}

/// The page of a film.
pub(super) fn page(title: &str, facts: &Json, streams: &[Stream]) -> String {
    let data = streams
        .iter()
        .map(|Stream { name, text }| format!("<script type=\"text/plain\" id=\"data-{name}\">{text}</script>\n"));
    let parts = [
        ("{{title}}", escaped(title)),
        ("{{generator}}", format!("immerse {}", env!("CARGO_PKG_VERSION"))),
        ("{{style}}", STYLE.to_owned()),
        // Nothing in a text may end the script that holds it.
        ("{{facts}}", facts.to_string().replace('<', "\\u003c")),
        ("{{data}}", data.collect()),
        ("{{script}}", SCRIPTS.concat()),
    ];
    // Part by part, so that nothing within a part is taken for the name of another.
    let mut page = String::new();
    let mut rest = MARKUP;
    for (name, part) in parts.iter() {
        let Some((before, after)) = rest.split_once(name) else { continue };
        page.push_str(before);
        page.push_str(part);
        rest = after;
    }
    page + rest
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
