//! The pages: markup, style and scripts, with what they show put into them.

use serde_json::Value as Json;

use super::streams::Stream;

const MARKUP: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/style.css");
/// In the order in which they use each other.
const OF_FILM: [&str; 11] = [
    include_str!("page/words.js"),
    include_str!("page/unpack.js"),
    include_str!("page/camera.js"),
    include_str!("page/shaders.js"),
    include_str!("page/picture.js"),
    include_str!("page/surface.js"),
    include_str!("page/viewer.js"),
    include_str!("page/curves.js"),
    include_str!("page/table.js"),
    include_str!("page/tables.js"),
    include_str!("page/main.js"),
];
const OF_FILMS: [&str; 3] =
    [include_str!("page/words.js"), include_str!("page/table.js"), include_str!("page/films.js")];

/// All that the page of a film is made of beside the film, for its key.
pub(super) fn parts() -> impl Iterator<Item = &'static str> {
    [MARKUP, STYLE].into_iter().chain(OF_FILM)
}

/// The page of a film.
pub(super) fn page(title: &str, facts: &Json, streams: &[Stream]) -> String {
    let data = streams
        .iter()
        .map(|Stream { name, text }| format!("<script type=\"text/plain\" id=\"data-{name}\">{text}</script>\n"));
    let otherwise = "<code>manifest.json</code> and <code>frames</code>";
    put_together([title, otherwise], facts, data.collect(), &OF_FILM)
}

/// The page of several films.
pub(super) fn page_of_films(title: &str, facts: &Json) -> String {
    put_together([title, "<code>sweep.csv</code> and <code>sweep.png</code>"], facts, String::new(), &OF_FILMS)
}

/// A page with this title, which says where else to find what it shows.
fn put_together([title, otherwise]: [&str; 2], facts: &Json, data: String, scripts: &[&str]) -> String {
    let parts = [
        ("{{title}}", escaped(title)),
        ("{{generator}}", format!("immerse {}", env!("CARGO_PKG_VERSION"))),
        ("{{style}}", STYLE.to_owned()),
        ("{{otherwise}}", otherwise.to_owned()),
        // Nothing in a text may end the script that holds it.
        ("{{facts}}", facts.to_string().replace('<', "\\u003c")),
        ("{{data}}", data),
        ("{{script}}", scripts.concat()),
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
