//! Moving pictures, written frame by frame.

use std::{
    fs::File,
    io::BufWriter,
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use super::{MovieError, apng::Apng, gif::Gif, gif::Palette};
use crate::{
    render::{Metadata, temporary_beside},
    scene::AnimationFormat,
};

/// A moving picture in the making. Frames are pushed in order as sRGB bytes, three per pixel, row by row.
pub(super) trait Animation: Send {
    fn push(&mut self, pixels: &[u8]) -> Result<(), MovieError>;

    /// The file appears, whole.
    fn finish(self: Box<Self>) -> Result<(), MovieError>;
}

/// How all frames of a moving picture are shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reeling {
    pub width: usize,
    pub height: usize,
    pub frames: usize,
    /// Frames a second.
    pub rate: f64,
    /// Fingerprint of what was simulated.
    pub scene_hash: u32,
}

impl Reeling {
    /// The fingerprint as it is written.
    pub fn hash(&self) -> String {
        Metadata { scene_hash: self.scene_hash, ..Metadata::default() }.hash()
    }
}

/// Begins `film.gif`, `film.apng` or `film.mp4` in a folder.
pub(super) fn begin(
    format: AnimationFormat,
    folder: &Path,
    reeling: Reeling,
    palette: &Palette,
) -> Result<Box<dyn Animation>, MovieError> {
    Ok(match format {
        AnimationFormat::Gif => Box::new(Gif::begin(Draft::begin(folder.join("film.gif"))?, reeling, palette.clone())?),
        AnimationFormat::Apng => Box::new(Apng::begin(Draft::begin(folder.join("film.apng"))?, reeling)?),
        #[cfg(feature = "mp4")]
        AnimationFormat::Mp4 => Box::new(super::mp4::Mp4::begin(Draft::begin(folder.join("film.mp4"))?, reeling)?),
        #[cfg(not(feature = "mp4"))]
        AnimationFormat::Mp4 => return Err(MovieError::WithoutMp4),
    })
}

/// A file under a temporary name beside its final one.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
}

impl Draft {
    pub fn begin(path: PathBuf) -> Result<Draft, MovieError> {
        let file = temporary_beside(&path);
        Ok(Draft { file: file.map_err(|error| MovieError::write(&path, error))?, path })
    }

    pub fn writer(&self) -> Result<BufWriter<File>, MovieError> {
        let file = self.file.as_file().try_clone();
        Ok(BufWriter::new(file.map_err(|error| self.error(error))?))
    }

    pub fn error(&self, reason: impl std::fmt::Display) -> MovieError {
        MovieError::write(&self.path, reason)
    }

    /// Gives the file its name; everything must have been flushed.
    pub fn publish(self) -> Result<(), MovieError> {
        let Draft { file, path } = self;
        file.as_file().sync_all().map_err(|error| MovieError::write(&path, error))?;
        file.persist(&path).map_err(|error| MovieError::write(&path, error.error))?;
        Ok(())
    }
}
