//! The formats of exports.

use crate::scene::ExportFormat;

use super::layout::Layout;
use super::subject::{Subject, Wants};
use super::{fold, gltf, npz, obj, pc2, ply, usd, vtk};

impl ExportFormat {
    /// The most frames that a file of the format has.
    pub(super) fn most_frames(self) -> Option<usize> {
        (self == ExportFormat::Gltf).then_some(gltf::MOST_FRAMES)
    }

    /// What it wants to know of frames.
    pub(super) fn wants(self) -> Wants {
        let nothing = Wants::default();
        match self {
            ExportFormat::Usd => Wants { normals: true, fields: true, view: true, crossings: true, angles: false },
            ExportFormat::Vtk => Wants { normals: true, fields: true, crossings: true, ..nothing },
            ExportFormat::Gltf => Wants { normals: true, view: true, ..nothing },
            ExportFormat::Ply => Wants { normals: true, fields: true, view: true, ..nothing },
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
