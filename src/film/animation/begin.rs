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

/// The file of a moving picture.
pub(in crate::film) fn file_name(format: AnimationFormat) -> &'static str {
    match format {
        AnimationFormat::Gif => "film.gif",
        AnimationFormat::Apng => "film.apng",
        AnimationFormat::Mp4 => "film.mp4",
    }
}

/// Begins `film.gif`, `film.apng` or `film.mp4` in a folder.
pub(in crate::film) fn begin(
    format: AnimationFormat,
    folder: &Path,
    reeling: Reeling,
    palette: &Palette,
) -> Result<Box<dyn Animation>, FilmError> {
    let draft = Draft::begin(folder.join(file_name(format)))?;
    Ok(match format {
        AnimationFormat::Gif => Box::new(Gif::begin(draft, reeling, palette.clone())?),
        AnimationFormat::Apng => Box::new(Apng::begin(draft, reeling)?),
        #[cfg(feature = "mp4")]
        AnimationFormat::Mp4 => Box::new(Mp4::begin(draft, reeling)?),
        #[cfg(not(feature = "mp4"))]
        AnimationFormat::Mp4 => return Err(FilmError::WithoutMp4),
    })
}
