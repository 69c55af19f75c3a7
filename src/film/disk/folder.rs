//! The folder of a film: what it holds, which frames are done, and going on with it.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::error::{DiskError, SIMULATE_AGAIN};
use super::frame_file::{from_npz, to_npz};
use super::frame_names::{frame_files, frame_number};
use super::manifest::{FORMAT, FilmSpec, Manifest, MeshCounts};
use super::mesh_file::{FilmMesh, file_faces_of, file_vertices_of, lists_edges, triangles_of};
use super::seal::{SealError, read, remove, seal, unseal, write_whole};
use crate::digest::{Digest, Key};
use crate::evolve::{Frame, FrameReport};
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::whole_file;

/// The text of the scene, in the folder of its film.
const SCENE: &str = ".immerse/scene.toml";

/// `frames/000001.json`: written after the state, so that its presence says that the frame is done.
#[derive(Serialize, Deserialize)]
struct FrameRecord {
    format: u32,
    key: Key,
    state_bytes: u64,
    state_sha256: Key,
    report: FrameReport,
}

/// The folder of a film.
#[derive(Clone, Debug)]
pub struct FilmFolder {
    folder: PathBuf,
    manifest: Manifest,
}

impl FilmFolder {
    /// Opens the folder of a scene's film if it was begun with the same scene, by the same program, and its mesh is whole.
    /// Then nobody needs the keys of its frames again.
    ///
    /// # Errors
    /// [`DiskError::NotAFolder`], [`DiskError::Version`], [`DiskError::Io`]
    pub fn open_unchanged(folder: &Path, scene: &Scene) -> Result<Option<FilmFolder>, DiskError> {
        match FilmFolder::open(folder) {
            Ok(film) => {
                let sections = scene.section_keys();
                let Some(keys) = film.manifest.keys_for(&sections) else { return Ok(None) };
                let spec = FilmSpec::of_sections(scene, sections, keys.to_vec());
                let Manifest { mesh, mesh_sha256, .. } = film.manifest;
                match film.read_mesh(|bytes| film.mesh_of(bytes).and_then(|_| lists_edges(bytes))) {
                    // Names and checks may have changed; they decide no frame.
                    Ok(true) => FilmFolder::begin(folder, &spec, mesh, mesh_sha256).map(Some),
                    // The mesh of an earlier build is written anew.
                    Ok(false) => Ok(None),
                    Err(DiskError::Damaged { .. }) => Ok(None),
                    Err(error) => Err(error),
                }
            }
            Err(DiskError::NotAFilm { .. } | DiskError::Damaged { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Opens the folder of a film to go on with it, or creates it. Frames of the film as it was before stay, and those
    /// whose keys are still the same count. Also says what has changed since, in words; nothing if the film is a new one.
    ///
    /// # Errors
    /// [`DiskError::OtherScene`] if the folder holds the film of a scene with another name, and no frame of this one; then
    /// nothing is changed. [`DiskError::Version`] if another version of the program wrote it.
    pub fn open_or_create(
        folder: &Path,
        spec: &FilmSpec,
        mesh: &FilmMesh,
    ) -> Result<(FilmFolder, Vec<String>), DiskError> {
        let before = match FilmFolder::open(folder) {
            Ok(film) => Some(film.manifest),
            Err(DiskError::NotAFilm { .. } | DiskError::Damaged { .. }) => None,
            Err(error) => return Err(error),
        };
        let is_other = before.as_ref().is_none_or(|before| before.scene != spec.scene);
        let is_shared = |k: usize| spec.keys.get(k.wrapping_sub(1)).is_some_and(|&key| key_of(folder, k) == Some(key));
        let numbers = frame_numbers(folder)?;
        if is_other && !numbers.is_empty() && !numbers.into_iter().any(is_shared) {
            let found = match before {
                Some(before) => format!("the scene `{}`", before.scene),
                None => "another scene, whose manifest.json is not there or damaged".to_owned(),
            };
            return Err(DiskError::OtherScene { path: folder.to_owned(), found });
        }
        create_folder(folder)?;
        let path = folder.join("mesh.npz");
        let bytes = mesh.to_npz().map_err(DiskError::io(&path, "written"))?;
        write_unless_same(&path, &bytes)?;
        let film = FilmFolder::begin(folder, spec, MeshCounts::of(&mesh.mesh), Key::of_bytes(&bytes))?;
        let changes = before.map(|before| before.changes_to(&film.manifest)).unwrap_or_default();
        Ok((film, changes))
    }

    /// Removes the frames of whatever film a folder holds.
    ///
    /// # Errors
    /// [`DiskError::NotAFolder`], [`DiskError::Io`]
    pub(in crate::film) fn clear(folder: &Path) -> Result<(), DiskError> {
        if folder.is_file() {
            return Err(DiskError::not_a_folder(folder));
        }
        frame_files(folder)?.iter().try_for_each(|path| remove(path))?;
        remove(&folder.join("manifest.json"))
    }

    /// Writes the manifest of a film whose mesh is there, and keeps the text of its scene, for camera, lights and colours.
    fn begin(folder: &Path, spec: &FilmSpec, mesh: MeshCounts, mesh_sha256: Key) -> Result<FilmFolder, DiskError> {
        create_folder(&folder.join("frames"))?;
        let manifest = Manifest::of(spec, mesh, mesh_sha256);
        let path = folder.join("manifest.json");
        write_unless_same(&path, &sealed(&path, &manifest)?)?;
        if !spec.text.is_empty() {
            let path = folder.join(SCENE);
            path.parent().map_or(Ok(()), create_folder)?;
            write_unless_same(&path, spec.text.as_bytes())?;
        }
        Ok(FilmFolder { folder: folder.to_owned(), manifest })
    }

    /// Opens the folder of a film to read it.
    ///
    /// # Errors
    /// [`DiskError::NotAFolder`], [`DiskError::NotAFilm`] if there is no manifest, [`DiskError::Version`] if another version of
    /// the program wrote it, [`DiskError::Damaged`] if it is not what was written.
    pub fn open(folder: &Path) -> Result<FilmFolder, DiskError> {
        if folder.is_file() {
            return Err(DiskError::not_a_folder(folder));
        }
        let path = folder.join("manifest.json");
        let bytes = read(&path)?.ok_or_else(|| DiskError::NotAFilm { path: folder.to_owned() })?;
        let manifest: Manifest = unseal(&bytes).map_err(|error| broken_seal(&path, error))?;
        if manifest.frame_count != manifest.keys.len() {
            let reason = format!("it has {} frames and keys of {}", manifest.frame_count, manifest.keys.len());
            return Err(DiskError::damaged(&path, reason));
        }
        Ok(FilmFolder { folder: folder.to_owned(), manifest })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// What the film is of.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The scene that was kept; `None` if there is none, or none that this version of the program reads. Files that it
    /// names need not be there.
    ///
    /// # Errors
    /// [`DiskError::Io`] if it cannot be read.
    pub fn scene(&self) -> Result<Option<Scene>, DiskError> {
        Ok(self.scene_text()?.and_then(|text| Scene::parse(&text, &self.manifest.scene, &self.folder).ok()))
    }

    /// The text of that scene, whether or not it can be read as one.
    ///
    /// # Errors
    /// [`DiskError::Io`] if it cannot be read.
    pub fn scene_text(&self) -> Result<Option<String>, DiskError> {
        Ok(read(&self.folder.join(SCENE))?.and_then(|bytes| String::from_utf8(bytes).ok()))
    }

    /// The surface of the film.
    ///
    /// # Errors
    /// [`DiskError::Damaged`] if the mesh is not what was written.
    pub fn mesh(&self) -> Result<FilmMesh, DiskError> {
        self.read_mesh(|bytes| self.mesh_of(bytes))
    }

    fn mesh_of(&self, bytes: &[u8]) -> Result<FilmMesh, String> {
        let MeshCounts { vertices, faces, .. } = self.manifest.mesh;
        let mesh = Mesh::from_faces(vertices, &triangles_of(bytes, faces)?);
        FilmMesh::from_npz(bytes, mesh.map_err(|error| error.to_string())?)
    }

    /// The number of each face in the mesh file, that of its polygon, |F|.
    ///
    /// # Errors
    /// [`DiskError::Damaged`] if the mesh is not what was written.
    pub fn file_faces(&self) -> Result<Vec<u32>, DiskError> {
        self.read_mesh(|bytes| file_faces_of(bytes, self.manifest.mesh.faces))
    }

    /// The number of each vertex in the mesh file, |V|.
    ///
    /// # Errors
    /// As [`FilmFolder::file_faces`].
    pub fn file_vertices(&self) -> Result<Vec<u32>, DiskError> {
        self.read_mesh(|bytes| file_vertices_of(bytes, self.manifest.mesh.vertices))
    }

    fn read_mesh<T>(&self, arrays: impl FnOnce(&[u8]) -> Result<T, String>) -> Result<T, DiskError> {
        let path = self.folder.join("mesh.npz");
        let damaged = |reason: String| DiskError::damaged(&path, reason);
        let bytes = read(&path)?.ok_or_else(|| damaged("it is not there".into()))?;
        if Key::of_bytes(&bytes) != self.manifest.mesh_sha256 {
            return Err(damaged("its checksum does not match".into()));
        }
        arrays(&bytes).map_err(damaged)
    }

    /// Writes a frame, replacing the one that may be there.
    ///
    /// # Errors
    /// [`DiskError::Unfit`] if an array does not fit the mesh or a number is not finite,
    /// [`DiskError::Io`] if the system refuses; then the frame counts as not done.
    pub fn write_frame(&self, frame: &Frame) -> Result<(), DiskError> {
        let MeshCounts { vertices, edges, faces, .. } = self.manifest.mesh;
        let number = frame.report.frame;
        frame.fits_counts(vertices, edges, faces).map_err(|reason| DiskError::Unfit { frame: number, reason })?;
        let state_path = self.state_path(number);
        let key = self.key(number).ok_or_else(|| DiskError::Missing { path: state_path.clone() })?;
        let bytes = to_npz(frame).map_err(DiskError::io(&state_path, "written"))?;
        write_unless_same(&state_path, &bytes)?;
        let record = FrameRecord {
            format: FORMAT,
            key,
            state_bytes: bytes.len() as u64,
            state_sha256: Key::of_bytes(&bytes),
            report: frame.report.clone(),
        };
        let record_path = self.record_path(number);
        write_whole(&record_path, &sealed(&record_path, &record)?)
    }

    /// Reads a frame that verifies.
    ///
    /// # Errors
    /// [`DiskError::Missing`] if it is not there, [`DiskError::Stale`] if it is of the film as it was before,
    /// [`DiskError::Damaged`] and [`DiskError::Version`] if it is not what was written.
    pub fn read_frame(&self, frame: usize) -> Result<Frame, DiskError> {
        let (bytes, report) = self.verified(frame)?;
        let path = self.state_path(frame);
        from_npz(&bytes, report, &self.manifest.mesh).map_err(|reason| DiskError::damaged(&path, reason))
    }

    /// Reads the report of a frame that verifies.
    ///
    /// # Errors
    /// Those of [`FilmFolder::read_frame`].
    pub fn read_report(&self, frame: usize) -> Result<FrameReport, DiskError> {
        Ok(self.verified(frame)?.1)
    }

    /// The checksum of the state of a frame that is done, and its report. The state itself is not read.
    ///
    /// # Errors
    /// Those of [`FilmFolder::read_frame`], as far as the report is concerned.
    pub fn contents(&self, frame: usize) -> Result<(Key, FrameReport), DiskError> {
        let record = self.record(frame)?;
        Ok((record.state_sha256, record.report))
    }

    /// The checksum of the state of a frame; `None` if it is not done, or not as it was written.
    ///
    /// # Errors
    /// [`DiskError::Io`] if it is there but the system refuses to read it, which says nothing of the frame.
    pub fn state(&self, frame: usize) -> Result<Option<Key>, DiskError> {
        match self.contents(frame) {
            Ok((state, _)) => Ok(Some(state)),
            Err(error @ DiskError::Io { .. }) => Err(error),
            Err(_) => Ok(None),
        }
    }

    /// Stands for the states of all frames as they are now, those included that are not there.
    ///
    /// # Errors
    /// Those of [`FilmFolder::state`].
    pub fn all_contents(&self) -> Result<Key, DiskError> {
        let mut digest = Digest::of("film");
        for frame in 1..=self.manifest.frame_count {
            digest = digest.shown(&self.state(frame)?);
        }
        Ok(digest.finish())
    }

    /// Per frame: whether it is there, verifies, and is of the film as it is now. The others are to be computed.
    ///
    /// # Errors
    /// [`DiskError::Io`] if a frame is there but the system refuses to read it.
    pub fn valid_frames(&self) -> Result<Vec<bool>, DiskError> {
        let is_valid = |frame: usize| match self.verified(frame) {
            Ok(_) => Ok(true),
            Err(DiskError::Io { path, action, source }) => Err(DiskError::Io { path, action, source }),
            Err(_) => Ok(false),
        };
        (1..=self.manifest.frame_count).into_par_iter().map(is_valid).collect()
    }

    /// The frames whose files are there, done or not, in order.
    ///
    /// # Errors
    /// [`DiskError::Io`]
    pub fn frames(&self) -> Result<Vec<usize>, DiskError> {
        frame_numbers(&self.folder)
    }

    /// Removes files of frames that the film does not have, as a longer one leaves them. Returns their names.
    ///
    /// # Errors
    /// [`DiskError::Io`]
    pub fn remove_frames_beyond(&self) -> Result<Vec<String>, DiskError> {
        let beyond = |path: &PathBuf| frame_number(path).is_some_and(|k| k == 0 || k > self.manifest.frame_count);
        let old: Vec<PathBuf> = frame_files(&self.folder)?.into_iter().filter(beyond).collect();
        old.iter().try_for_each(|path| remove(path))?;
        Ok(old.iter().filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())).collect())
    }

    /// The key that a frame of the film has.
    fn key(&self, frame: usize) -> Option<Key> {
        self.manifest.keys.get(frame.checked_sub(1)?).copied()
    }

    /// The record of a frame, if it is of this film.
    fn record(&self, frame: usize) -> Result<FrameRecord, DiskError> {
        let path = self.record_path(frame);
        let record = read_record(&path)?;
        if record.report.frame != frame {
            return Err(DiskError::damaged(&path, format!("it is of frame {}", record.report.frame)));
        }
        if self.key(frame) == Some(record.key) { Ok(record) } else { Err(DiskError::Stale { path }) }
    }

    fn verified(&self, frame: usize) -> Result<(Vec<u8>, FrameReport), DiskError> {
        let record = self.record(frame)?;
        let path = self.state_path(frame);
        let state = read(&path)?.ok_or_else(|| DiskError::damaged(&path, "it is not there, but its report is"))?;
        if state.len() as u64 != record.state_bytes || Key::of_bytes(&state) != record.state_sha256 {
            return Err(DiskError::damaged(&path, "its checksum does not match"));
        }
        Ok((state, record.report))
    }

    fn state_path(&self, frame: usize) -> PathBuf {
        self.folder.join(format!("frames/{frame:06}.npz"))
    }

    fn record_path(&self, frame: usize) -> PathBuf {
        record_path(&self.folder, frame)
    }
}

fn record_path(folder: &Path, frame: usize) -> PathBuf {
    folder.join(format!("frames/{frame:06}.json"))
}

fn read_record(path: &Path) -> Result<FrameRecord, DiskError> {
    let bytes = read(path)?.ok_or_else(|| DiskError::Missing { path: path.to_owned() })?;
    unseal(&bytes).map_err(|error| broken_seal(path, error))
}

/// The key of a frame on disk, whatever film it is of; `None` if it is not there or damaged.
fn key_of(folder: &Path, frame: usize) -> Option<Key> {
    read_record(&record_path(folder, frame)).ok().map(|record| record.key)
}

fn frame_numbers(folder: &Path) -> Result<Vec<usize>, DiskError> {
    let files = frame_files(folder)?;
    let records = files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    Ok(records.filter_map(|path| frame_number(path)).collect())
}

/// A folder and those above it, where they are not there.
fn create_folder(folder: &Path) -> Result<(), DiskError> {
    whole_file::create_folder(folder).map(drop).map_err(DiskError::io(folder, "created"))
}

fn write_unless_same(path: &Path, bytes: &[u8]) -> Result<(), DiskError> {
    whole_file::write_unless_same(path, bytes).map_err(DiskError::io(path, "written"))
}

fn sealed(path: &Path, record: &impl Serialize) -> Result<Vec<u8>, DiskError> {
    seal(record).map_err(|error| DiskError::io(path, "written")(error.into()))
}

fn broken_seal(path: &Path, error: SealError) -> DiskError {
    match error {
        SealError::Version(found) => DiskError::Version { path: path.to_owned(), found },
        SealError::Damaged(reason) => DiskError::Damaged { path: path.to_owned(), reason, remedy: SIMULATE_AGAIN },
    }
}
