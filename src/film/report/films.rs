//! Several films of one scene as one page: a table with pictures.

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

use super::page::page_of_films;
use super::work::REPORT;
use crate::evolve::FrameReport;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::kept_scene::scene_to_show;
use crate::film::pictures::{Watch, small_picture};
use crate::whole_file;

/// A film in the table, and what its row says.
#[derive(Clone, Debug)]
pub struct FilmRow {
    /// The folder of its film, among those of the others.
    pub name: String,
    /// The values that set it apart from the others, in the order of the keys.
    pub values: Vec<String>,
    /// Its last frame; `None` if there is none.
    pub last: Option<FrameReport>,
    /// "yes" if all that its scene asks for holds, "NO" if not, "-" if nothing is asked for.
    pub checks: &'static str,
    /// Whether all of its frames are there.
    pub is_whole: bool,
}

/// What stands above the table.
#[derive(Clone, Debug)]
pub struct FilmTable {
    /// The name of the scene.
    pub scene: String,
    /// The keys whose values set films apart.
    pub keys: Vec<String>,
    /// What is set in all of them.
    pub common: Vec<String>,
    /// The command that makes them again.
    pub command: String,
    /// The films, in order.
    pub rows: Vec<FilmRow>,
}

/// Bytes that all pictures of a page may have, about, and of a pixel.
const ROOM: usize = 8 << 20;
const OF_PIXEL: usize = 2;
/// The longest side of a picture.
const SIDES: std::ops::RangeInclusive<usize> = 96..=560;

/// Writes the page of the films in a folder.
///
/// # Errors
/// [`FilmError`] if a film that is whole cannot be shown, or the page cannot be written.
pub fn report_films(folder: &Path, table: &FilmTable, watch: &mut Watch) -> Result<(), FilmError> {
    let pixels = ROOM / OF_PIXEL / table.rows.len().max(1);
    let side = (pixels as f64 * 4.0 / 3.0).sqrt() as usize;
    let side = side.clamp(*SIDES.start(), *SIDES.end());
    let mut rows = Vec::new();
    for row in &table.rows {
        let film: PathBuf = folder.join(&row.name);
        let picture = match row.is_whole {
            true => {
                let scene = scene_to_show(&FilmFolder::open(&film)?, watch)?;
                let png = small_picture(&scene, &film, scene.clock.frames, side)?;
                Some(format!("data:image/png;base64,{}", STANDARD.encode(png)))
            }
            false => None,
        };
        rows.push(json!({
            "name": row.name,
            "values": row.values,
            "page": film.join(REPORT).is_file().then(|| format!("{}/{REPORT}", encoded(&row.name))),
            "picture": picture,
            "last": row.last,
            "checks": row.checks,
        }));
    }
    let FilmTable { scene, keys, common, command, .. } = table;
    let program = format!("immerse {}", env!("CARGO_PKG_VERSION"));
    let facts =
        json!({ "scene": scene, "keys": keys, "common": common, "command": command, "program": program, "runs": rows });
    let path = folder.join(REPORT);
    let page = page_of_films(scene, &facts);
    whole_file::write_unless_same(&path, page.as_bytes()).map_err(|error| FilmError::write(&path, error))
}

/// The name of a folder as part of an address.
fn encoded(name: &str) -> String {
    let spelled = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'=' | b',' | b'+' => (byte as char).to_string(),
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(spelled).collect()
}
