//! One picture of several films.

use std::path::{Path, PathBuf};

use super::passes::{Watch, metadata};
use super::plan::Plan;
use super::sheet::Sheet;
use super::sheets::{SHEET_WIDTH, SMALL};
use super::single::take_picture;
use crate::film::error::FilmError;
use crate::render::{Corner, Picture};
use crate::scene::{Scene, TextSection};

/// A film on a sheet of several.
#[derive(Clone, Debug)]
pub struct Tile {
    /// As it ran.
    pub scene: Scene,
    /// The folder of its film.
    pub folder: PathBuf,
    /// What stands above it and below.
    pub captions: [String; 2],
}

/// Makes one picture with the last frame of each of some films, with captions.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn make_sheet_of_films(tiles: &[Tile], path: &Path, watch: &mut Watch) -> Result<(), FilmError> {
    let Some(first) = tiles.first() else { return Ok(()) };
    let plan = Plan::of(&first.scene)?;
    let sheet = Sheet::of(tiles.len(), plan.size(), SHEET_WIDTH);
    let [width, height] = sheet.size();
    let mut whole = Picture::blank(width, height, plan.look.background[0]);
    for (index, tile) in tiles.iter().enumerate() {
        let picture = take_picture(&small(tile, sheet.tile), &tile.folder, tile.scene.clock.frames, watch)?;
        whole.paste(&picture, sheet.place(index));
    }
    Ok(whole.write_png(path, SMALL, &metadata(&plan))?)
}

/// The scene of a tile of this size.
fn small(tile: &Tile, size: [usize; 2]) -> Scene {
    let mut scene = tile.scene.clone();
    (scene.output.size, scene.output.crop) = (size, None);
    let as_it_is = |text: &String| text.replace('{', "{{").replace('}', "}}");
    let corners = [Corner::TopLeft, Corner::BottomLeft];
    let texts = tile.captions.iter().map(as_it_is).zip(corners);
    scene.look.texts = texts.map(|(text, corner)| TextSection { text, corner }).collect();
    scene
}
