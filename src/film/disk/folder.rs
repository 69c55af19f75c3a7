//! The folder of a film: what it holds, which frames are done, resuming and beginning anew.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::{DiskError, RESTART, SIMULATE_AGAIN};
use super::frame_file::{from_npz, to_npz};
use super::manifest::{FORMAT, FilmSpec, Manifest, MeshCounts};
use super::mesh_file::{FilmMesh, file_faces_of, triangles_of};
use super::seal::{SealError, read, remove, seal, unseal, write_whole};
use crate::evolve::{Frame, FrameReport};
use crate::mesh::Mesh;
use crate::whole_file;

/// `frames/000001.json`: written after the state, so that its presence says that the frame is done.
#[derive(Serialize, Deserialize)]
struct FrameRecord {
    format: u32,
    fingerprint: u32,
    state_bytes: u64,
    state_crc32: u32,
    report: FrameReport,
}

/// The folder of a film.
#[derive(Clone, Debug)]
pub struct FilmFolder {
    folder: PathBuf,
    manifest: Manifest,
}

impl FilmFolder {
    /// Opens the folder of a film to go on with it, or creates it with its mesh. A film that is
    /// gone on with keeps the mesh it began with.
    ///
    /// # Errors
    /// [`DiskError::OtherScene`] if the folder holds another film, or this film on another mesh; then
    /// nothing is changed. [`DiskError::Version`] and [`DiskError::Damaged`] if its manifest is not to
    /// be read.
    pub fn open_or_create(folder: &Path, spec: &FilmSpec, mesh: &FilmMesh) -> Result<FilmFolder, DiskError> {
        let other = |found: String| DiskError::OtherScene { path: folder.to_owned(), found };
        match FilmFolder::open(folder) {
            Ok(film) if film.manifest.fingerprint != spec.fingerprint => {
                let found = if film.manifest.scene == spec.scene {
                    format!("another version of the scene `{}`", spec.scene)
                } else {
                    format!("the scene `{}`", film.manifest.scene)
                };
                Err(other(found))
            }
            Ok(film) if film.triangles()? != mesh.mesh.triangles() => {
                Err(other(format!("the scene `{}` on another mesh", film.manifest.scene)))
            }
            // Names and checks may have changed; they decide no frame.
            Ok(film) => FilmFolder::begin(folder, spec, film.manifest.mesh, film.manifest.mesh_crc32),
            Err(DiskError::NotAFilm { .. }) => FilmFolder::create(folder, spec, mesh),
            Err(error) => Err(error),
        }
    }

    /// Begins anew: removes the frames of whatever film the folder holds. Files that are not
    /// of a film stay.
    ///
    /// # Errors
    /// [`DiskError::Io`]
    pub fn restart(folder: &Path, spec: &FilmSpec, mesh: &FilmMesh) -> Result<FilmFolder, DiskError> {
        if folder.is_file() {
            return Err(DiskError::not_a_folder(folder));
        }
        frame_files(folder)?.iter().try_for_each(|path| remove(path))?;
        FilmFolder::create(folder, spec, mesh)
    }

    fn create(folder: &Path, spec: &FilmSpec, mesh: &FilmMesh) -> Result<FilmFolder, DiskError> {
        whole_file::create_folder(folder).map_err(DiskError::io(folder, "created"))?;
        let path = folder.join("mesh.npz");
        let bytes = mesh.to_npz().map_err(DiskError::io(&path, "written"))?;
        write_unless_same(&path, &bytes)?;
        FilmFolder::begin(folder, spec, MeshCounts::of(&mesh.mesh), crc32fast::hash(&bytes))
    }

    /// Writes the manifest of a film whose mesh is there.
    fn begin(folder: &Path, spec: &FilmSpec, mesh: MeshCounts, mesh_crc32: u32) -> Result<FilmFolder, DiskError> {
        let frames = folder.join("frames");
        whole_file::create_folder(&frames).map_err(DiskError::io(&frames, "created"))?;
        let manifest = Manifest {
            format: FORMAT,
            scene: spec.scene.clone(),
            fingerprint: spec.fingerprint,
            frame_count: spec.frame_count,
            mesh,
            mesh_crc32,
            checks: spec.checks.clone(),
        };
        let path = folder.join("manifest.json");
        write_unless_same(&path, &sealed(&path, &manifest)?)?;
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
        let manifest = unseal(&bytes).map_err(|error| broken_seal(&path, error, RESTART))?;
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

    /// The surface of the film.
    ///
    /// # Errors
    /// [`DiskError::Damaged`] if the mesh is not what was written.
    pub fn mesh(&self) -> Result<FilmMesh, DiskError> {
        let counts = self.manifest.mesh;
        self.read_mesh(|bytes| {
            let mesh = Mesh::from_faces(counts.vertices, &triangles_of(bytes, counts.faces)?);
            FilmMesh::from_npz(bytes, mesh.map_err(|error| error.to_string())?)
        })
    }

    /// Corners of the faces, |F|.
    ///
    /// # Errors
    /// [`DiskError::Damaged`] if the mesh is not what was written.
    pub fn triangles(&self) -> Result<Vec<[u32; 3]>, DiskError> {
        self.read_mesh(|bytes| triangles_of(bytes, self.manifest.mesh.faces))
    }

    /// The number of each face in the mesh file, that of its polygon, |F|.
    ///
    /// # Errors
    /// [`DiskError::Damaged`] if the mesh is not what was written.
    pub fn file_faces(&self) -> Result<Vec<u32>, DiskError> {
        self.read_mesh(|bytes| file_faces_of(bytes, self.manifest.mesh.faces))
    }

    fn read_mesh<T>(&self, arrays: impl FnOnce(&[u8]) -> Result<T, String>) -> Result<T, DiskError> {
        let path = self.folder.join("mesh.npz");
        let damaged = |reason: String| DiskError::Damaged { path: path.clone(), reason, remedy: RESTART };
        let bytes = read(&path)?.ok_or_else(|| damaged("it is not there".into()))?;
        if crc32fast::hash(&bytes) != self.manifest.mesh_crc32 {
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
        let bytes = to_npz(frame).map_err(DiskError::io(&state_path, "written"))?;
        write_unless_same(&state_path, &bytes)?;
        let record = FrameRecord {
            format: FORMAT,
            fingerprint: self.manifest.fingerprint,
            state_bytes: bytes.len() as u64,
            state_crc32: crc32fast::hash(&bytes),
            report: frame.report.clone(),
        };
        let record_path = self.record_path(number);
        write_whole(&record_path, &sealed(&record_path, &record)?)
    }

    /// Reads a frame that verifies.
    ///
    /// # Errors
    /// [`DiskError::Missing`] if it is not there, [`DiskError::Damaged`] and [`DiskError::Version`]
    /// if it is not what was written.
    pub fn read_frame(&self, frame: usize) -> Result<Frame, DiskError> {
        let (bytes, report) = self.verified(frame)?;
        let path = self.state_path(frame);
        from_npz(&bytes, report, &self.manifest.mesh).map_err(|reason| DiskError::Damaged {
            path,
            reason,
            remedy: SIMULATE_AGAIN,
        })
    }

    /// Reads the report of a frame that verifies.
    ///
    /// # Errors
    /// Those of [`FilmFolder::read_frame`].
    pub fn read_report(&self, frame: usize) -> Result<FrameReport, DiskError> {
        Ok(self.verified(frame)?.1)
    }

    /// The last frame before which, itself included, every frame is there and verifies: a simulation goes
    /// on after it. `None` if frame 1 has to be computed.
    ///
    /// # Errors
    /// [`DiskError::Io`] if a frame is there but the system refuses to read it.
    pub fn last_valid_frame(&self) -> Result<Option<usize>, DiskError> {
        for frame in 1..=self.manifest.frame_count {
            match self.verified(frame) {
                Ok(_) => {}
                Err(DiskError::Io { path, action, source }) => return Err(DiskError::Io { path, action, source }),
                Err(_) => return Ok((frame > 1).then(|| frame - 1)),
            }
        }
        Ok(Some(self.manifest.frame_count))
    }

    /// The frames whose files are there, done or not, in order.
    ///
    /// # Errors
    /// [`DiskError::Io`]
    pub fn frames(&self) -> Result<Vec<usize>, DiskError> {
        let files = frame_files(&self.folder)?;
        let records = files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "json"));
        Ok(records.filter_map(|path| frame_number(path)).collect())
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

    fn verified(&self, frame: usize) -> Result<(Vec<u8>, FrameReport), DiskError> {
        let record_path = self.record_path(frame);
        let bytes = read(&record_path)?.ok_or_else(|| DiskError::Missing { path: record_path.clone() })?;
        let record: FrameRecord = unseal(&bytes).map_err(|error| broken_seal(&record_path, error, SIMULATE_AGAIN))?;
        let path = self.state_path(frame);
        let damaged = |path: &Path, reason: &str| DiskError::Damaged {
            path: path.to_owned(),
            reason: reason.to_owned(),
            remedy: SIMULATE_AGAIN,
        };
        if record.fingerprint != self.manifest.fingerprint || record.report.frame != frame {
            return Err(damaged(&record_path, "it is of another film or frame"));
        }
        let state = read(&path)?.ok_or_else(|| damaged(&path, "it is not there, but its report is"))?;
        if state.len() as u64 != record.state_bytes || crc32fast::hash(&state) != record.state_crc32 {
            return Err(damaged(&path, "its checksum does not match"));
        }
        Ok((state, record.report))
    }

    fn state_path(&self, frame: usize) -> PathBuf {
        self.folder.join(format!("frames/{frame:06}.npz"))
    }

    fn record_path(&self, frame: usize) -> PathBuf {
        self.folder.join(format!("frames/{frame:06}.json"))
    }
}

/// The files of frames, records (.json) before states: a frame without a record is not done.
fn frame_files(folder: &Path) -> Result<Vec<PathBuf>, DiskError> {
    let frames = folder.join("frames");
    let mut files = Vec::new();
    if frames.is_dir() {
        for entry in fs::read_dir(&frames).map_err(DiskError::io(&frames, "read"))? {
            let path = entry.map_err(DiskError::io(&frames, "read"))?.path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if frame_number(&path).is_some() && matches!(ending, Some("json" | "npz")) {
                files.push(path);
            }
        }
    }
    files.sort_by_key(|path| (path.extension().map(ToOwned::to_owned), path.clone()));
    Ok(files)
}

fn frame_number(path: &Path) -> Option<usize> {
    let stem = path.file_stem()?.to_str()?;
    (stem.len() == 6 && stem.bytes().all(|b| b.is_ascii_digit())).then(|| stem.parse().ok()).flatten()
}

/// A file that already has the bytes is left alone, so that looking at a film does not touch it.
fn write_unless_same(path: &Path, bytes: &[u8]) -> Result<(), DiskError> {
    if read(path)?.as_deref() == Some(bytes) { Ok(()) } else { write_whole(path, bytes) }
}

fn sealed(path: &Path, record: &impl Serialize) -> Result<Vec<u8>, DiskError> {
    seal(record).map_err(|error| DiskError::io(path, "written")(error.into()))
}

fn broken_seal(path: &Path, error: SealError, remedy: &'static str) -> DiskError {
    match error {
        SealError::Version(found) => DiskError::Version { path: path.to_owned(), found },
        SealError::Damaged(reason) => DiskError::Damaged { path: path.to_owned(), reason, remedy },
    }
}
