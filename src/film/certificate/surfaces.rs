//! Frames to certify: those of a film, or files with the same faces, in the order of their names.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use crate::digest::Key;
use crate::film::disk::{DiskError, FilmFolder};
use crate::film::error::FilmError;
use crate::mesh::{EdgeId, Mesh, VertexId, Weld, read_positions, read_welded};

/// Where frames come from.
pub(super) enum Surfaces {
    Film { film: Box<FilmFolder>, mesh: Arc<Mesh>, file_vertices: Vec<u32> },
    Files { folder: PathBuf, names: Vec<String>, mesh: Arc<Mesh> },
}

/// A frame.
pub(super) struct Frame {
    pub time: Option<f64>,
    pub file: String,
    pub file_sha256: Key,
    pub positions: Vec<DVec3>,
    /// Rims that are known of it.
    pub rims: Vec<EdgeId>,
}

/// Most bytes of a file with a surface.
const MOST_BYTES: u64 = 1 << 40;

impl Surfaces {
    /// Those of a folder, and what is worth saying of its mesh.
    pub fn of(folder: &Path) -> Result<(Surfaces, Vec<String>), FilmError> {
        match FilmFolder::open(folder) {
            Ok(film) => Ok((Surfaces::of_film(film)?, Vec::new())),
            Err(DiskError::NotAFilm { .. }) => Surfaces::of_files(folder),
            Err(error) => Err(error.into()),
        }
    }

    pub fn of_film(film: FilmFolder) -> Result<Surfaces, FilmError> {
        let (mesh, file_vertices) = (film.mesh()?.mesh, film.file_vertices()?);
        Ok(Surfaces::Film { film: Box::new(film), mesh, file_vertices })
    }

    fn of_files(folder: &Path) -> Result<(Surfaces, Vec<String>), FilmError> {
        let mut names = Vec::new();
        for entry in fs::read_dir(folder).map_err(|error| FilmError::read(folder, error))? {
            let name = entry.map_err(|error| FilmError::read(folder, error))?.file_name();
            let is_obj = Path::new(&name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
            names.extend(name.into_string().ok().filter(|name| is_obj && !name.starts_with('.')));
        }
        names.sort();
        let [first, _, ..] = &*names else {
            return Err(FilmError::NothingToCertify { folder: folder.to_owned(), files: names.len() });
        };
        // Each vertex of the files is one of the mesh: what is said is said of their numbers.
        let surface = read_welded(&folder.join(first), Some(Weld::None))?;
        let boundary = surface.mesh.edges().filter(|e| surface.mesh.is_boundary_edge(*e)).count();
        let mut notes = surface.repairs;
        if boundary > 0 {
            notes.push(format!("{boundary} edges lie at the boundary, where there are no hinges"));
        }
        Ok((Surfaces::Files { folder: folder.to_owned(), names, mesh: Arc::new(surface.mesh) }, notes))
    }

    pub fn mesh(&self) -> &Arc<Mesh> {
        match self {
            Surfaces::Film { mesh, .. } | Surfaces::Files { mesh, .. } => mesh,
        }
    }

    pub fn count(&self) -> usize {
        match self {
            Surfaces::Film { film, .. } => film.manifest().frame_count,
            Surfaces::Files { names, .. } => names.len(),
        }
    }

    /// What files call a vertex, from 0.
    pub fn file_vertex(&self, vertex: VertexId) -> usize {
        match self {
            Surfaces::Film { file_vertices, .. } => {
                file_vertices.get(vertex.index()).map_or(vertex.index(), |v| *v as usize)
            }
            Surfaces::Files { mesh, .. } => mesh.file_vertex(vertex),
        }
    }

    /// A frame by its number, from 1.
    pub fn frame(&self, number: usize) -> Result<Frame, FilmError> {
        match self {
            Surfaces::Film { film, .. } => {
                let frame = film.read_frame(number)?;
                let (file_sha256, _) = film.contents(number)?;
                let file = format!("frames/{number:06}.npz");
                let (time, rims) = (Some(frame.report.time), frame.rims);
                Ok(Frame { time, file, file_sha256, positions: frame.positions, rims })
            }
            Surfaces::Files { folder, names, mesh } => {
                let file = names.get(number.wrapping_sub(1)).cloned().unwrap_or_default();
                let path = folder.join(&file);
                let positions = read_positions(&path, mesh)?;
                let bytes = crate::whole_file::read(&path, MOST_BYTES);
                let bytes = bytes.map_err(|error| FilmError::read(&path, std::io::Error::other(error)))?;
                Ok(Frame { time: None, file, file_sha256: Key::of_bytes(&bytes), positions, rims: Vec::new() })
            }
        }
    }
}
