//! Which format a moving picture is written in.

use std::path::Path;

use super::apng::Apng;
use super::draft::Draft;
use super::gif::Gif;
#[cfg(feature = "mp4")]
use super::mp4::Mp4;
use super::palette::Palette;
use super::reeling::{Animation, Reeling};
use crate::film::error::FilmError;
use crate::scene::AnimationFormat;

/// Begins `film.gif`, `film.apng` or `film.mp4` in a folder.
pub(in crate::film) fn begin(
    format: AnimationFormat,
    folder: &Path,
    reeling: Reeling,
    palette: &Palette,
) -> Result<Box<dyn Animation>, FilmError> {
    Ok(match format {
        AnimationFormat::Gif => Box::new(Gif::begin(Draft::begin(folder.join("film.gif"))?, reeling, palette.clone())?),
        AnimationFormat::Apng => Box::new(Apng::begin(Draft::begin(folder.join("film.apng"))?, reeling)?),
        #[cfg(feature = "mp4")]
        AnimationFormat::Mp4 => Box::new(Mp4::begin(Draft::begin(folder.join("film.mp4"))?, reeling)?),
        #[cfg(not(feature = "mp4"))]
        AnimationFormat::Mp4 => return Err(FilmError::WithoutMp4),
    })
}
