//! The formats of exports.

use crate::scene::ExportFormat;

use super::{fold, gltf, npz, obj, pc2, ply, subject::Moment, subject::Subject, usd, vtk};

impl ExportFormat {
    /// The most frames that a file of the format has.
    pub(super) fn most_frames(self) -> Option<usize> {
        (self == ExportFormat::Gltf).then_some(gltf::MOST_FRAMES)
    }

    /// What it wants to know of frames.
    pub(super) fn wants(self) -> Wants {
        let nothing = Wants::default();
        match self {
            ExportFormat::Usd => Wants { normals: true, fields: true, colors: true, crossings: true, angles: false },
            ExportFormat::Vtk => Wants { normals: true, fields: true, crossings: true, ..nothing },
            ExportFormat::Gltf => Wants { normals: true, colors: true, ..nothing },
            ExportFormat::Ply => Wants { normals: true, fields: true, colors: true, ..nothing },
            ExportFormat::Obj => Wants { normals: true, ..nothing },
            ExportFormat::Npz => Wants { normals: true, fields: true, angles: true, ..nothing },
            ExportFormat::Fold => Wants { angles: true, ..nothing },
            ExportFormat::Pc2 => nothing,
        }
    }

    /// How it is written.
    pub(super) fn layout<'a>(self, subject: &'a Subject) -> Box<dyn Layout + 'a> {
        match self {
            ExportFormat::Usd => Box::new(usd::Usd(subject)),
            ExportFormat::Vtk => Box::new(vtk::Vtk(subject)),
            ExportFormat::Gltf => Box::new(gltf::Gltf::of(subject)),
            ExportFormat::Pc2 => Box::new(pc2::Pc2(subject)),
            ExportFormat::Ply => Box::new(ply::Ply(subject)),
            ExportFormat::Obj => Box::new(obj::Obj(subject)),
            ExportFormat::Fold => Box::new(fold::Fold(subject)),
            ExportFormat::Npz => Box::new(npz::Npz(subject)),
        }
    }
}

/// What a format wants to know of frames beside positions, lengths and rims.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wants {
    pub normals: bool,
    pub fields: bool,
    pub colors: bool,
    pub crossings: bool,
    pub angles: bool,
}

/// How frames are laid out in files.
pub(super) trait Layout: Sync {
    /// The ending of the files of which each frame has one; `None` if all frames go into one file.
    fn ending(&self) -> Option<&'static str> {
        None
    }

    /// What is written of a frame: the bytes of its file, or its pieces of each part of the one file, always as many.
    ///
    /// # Errors
    /// In words, if a library cannot write it.
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String>;

    /// The files that there are once, of these frames, whose pieces have so many bytes in each part.
    fn end(&self, frames: &[Mark], pieces: &[u64]) -> Vec<(&'static str, Vec<Part>)>;
}

/// A frame that has been written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    pub number: usize,
    pub time: f64,
}

/// A part of a file.
pub(super) enum Part {
    Bytes(Vec<u8>),
    /// The pieces of all frames of this number, in order.
    Pieces(usize),
}

/// The file of a frame in a sequence.
pub(super) fn file_of_frame(number: usize, ending: &str) -> String {
    format!("film.{number:06}.{ending}")
}
