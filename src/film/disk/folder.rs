//! The folder of a film: what it holds, which frames are done, resuming and beginning anew.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::FORMAT;
use super::error::{CacheError, RESTART, SIMULATE_AGAIN};
use super::file::{SealError, read, remove, seal, unseal, write_atomically};
use super::frame::{from_npz, to_npz};
use super::manifest::{Film, Manifest, MeshCounts};
use super::npz::{ArrayReader, ArrayWriter};
use crate::evolve::{Frame, FrameReport};
use crate::mesh::Mesh;

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
pub struct Cache {
    folder: PathBuf,
    manifest: Manifest,
}

impl Cache {
    /// Opens the folder of a film to go on with it, or creates it with the mesh and, if there are any, the places of
    /// its vertices (|V|). A film that is gone on with keeps the places it began with.
    ///
    /// # Errors
    /// [`CacheError::OtherScene`] if the folder holds another film, or this film on another mesh; then
    /// nothing is changed. [`CacheError::Version`] and [`CacheError::Damaged`] if its manifest is not to
    /// be read.
    pub fn open_or_create(
        folder: &Path,
        film: &Film,
        mesh: &Mesh,
        places: Option<&[DVec3]>,
    ) -> Result<Cache, CacheError> {
        let other = |found: String| CacheError::OtherScene { path: folder.to_owned(), found };
        match Cache::open(folder) {
            Ok(cache) if cache.manifest.fingerprint != film.fingerprint => {
                let found = if cache.manifest.scene == film.scene {
                    format!("another version of the scene `{}`", film.scene)
                } else {
                    format!("the scene `{}`", cache.manifest.scene)
                };
                Err(other(found))
            }
            Ok(cache) if cache.triangles()? != mesh.triangles() => {
                Err(other(format!("the scene `{}` on another mesh", cache.manifest.scene)))
            }
            // Names and checks may have changed; they decide no frame.
            Ok(cache) => Cache::begin(folder, film, cache.manifest.mesh, cache.manifest.mesh_crc32),
            Err(CacheError::NotAFilm { .. }) => Cache::create(folder, film, mesh, places),
            Err(error) => Err(error),
        }
    }

    /// Begins anew: removes the frames of whatever film the folder holds. Files that are not a cache's
    /// stay.
    ///
    /// # Errors
    /// [`CacheError::Io`]
    pub fn restart(folder: &Path, film: &Film, mesh: &Mesh, places: Option<&[DVec3]>) -> Result<Cache, CacheError> {
        if folder.is_file() {
            return Err(CacheError::not_a_folder(folder));
        }
        frame_files(folder)?.iter().try_for_each(|path| remove(path))?;
        Cache::create(folder, film, mesh, places)
    }

    fn create(folder: &Path, film: &Film, mesh: &Mesh, places: Option<&[DVec3]>) -> Result<Cache, CacheError> {
        fs::create_dir_all(folder).map_err(CacheError::io(folder, "created"))?;
        let path = folder.join("mesh.npz");
        let bytes = mesh_npz(mesh, places).map_err(CacheError::io(&path, "written"))?;
        write_unless_same(&path, &bytes)?;
        Cache::begin(folder, film, MeshCounts::of(mesh), crc32fast::hash(&bytes))
    }

    /// Writes the manifest of a film whose mesh is there.
    fn begin(folder: &Path, film: &Film, mesh: MeshCounts, mesh_crc32: u32) -> Result<Cache, CacheError> {
        let frames = folder.join("frames");
        fs::create_dir_all(&frames).map_err(CacheError::io(&frames, "created"))?;
        let manifest = Manifest {
            format: FORMAT,
            scene: film.scene.clone(),
            fingerprint: film.fingerprint,
            frame_count: film.frame_count,
            mesh,
            mesh_crc32,
            checks: film.checks.clone(),
        };
        let path = folder.join("manifest.json");
        write_unless_same(&path, &sealed(&path, &manifest)?)?;
        Ok(Cache { folder: folder.to_owned(), manifest })
    }

    /// Opens the folder of a film to read it.
    ///
    /// # Errors
    /// [`CacheError::NotAFolder`], [`CacheError::NotAFilm`] if there is no manifest, [`CacheError::Version`] if another version of
    /// the program wrote it, [`CacheError::Damaged`] if it is not what was written.
    pub fn open(folder: &Path) -> Result<Cache, CacheError> {
        if folder.is_file() {
            return Err(CacheError::not_a_folder(folder));
        }
        let path = folder.join("manifest.json");
        let bytes = read(&path)?.ok_or_else(|| CacheError::NotAFilm { path: folder.to_owned() })?;
        let manifest = unseal(&bytes).map_err(|error| broken_seal(&path, error, RESTART))?;
        Ok(Cache { folder: folder.to_owned(), manifest })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// What the film is of.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Corners of the faces.
    ///
    /// # Errors
    /// [`CacheError::Damaged`] if the mesh is not what was written.
    pub fn triangles(&self) -> Result<Vec<[u32; 3]>, CacheError> {
        let faces = self.manifest.mesh.faces as u64;
        let corners = self.read_mesh(|file| file.array::<u32>("triangles", &[faces, 3]))?;
        Ok(corners.as_chunks().0.to_vec())
    }

    /// What x, y and z of each vertex mean in the scene; `None` if the mesh has no places, or the film was begun when
    /// they were not kept.
    ///
    /// # Errors
    /// [`CacheError::Damaged`] if the mesh is not what was written.
    pub fn places(&self) -> Result<Option<Vec<DVec3>>, CacheError> {
        let vertices = self.manifest.mesh.vertices as u64;
        let places = self.read_mesh(|file| match file.has("places") {
            true => file.array::<f64>("places", &[vertices, 3]).map(Some),
            false => Ok(None),
        })?;
        Ok(places.map(|places| places.as_chunks().0.iter().map(|&place| DVec3::from_array(place)).collect()))
    }

    /// The number of each face in the mesh file, that of its polygon, |F|.
    ///
    /// # Errors
    /// [`CacheError::Damaged`] if the mesh is not what was written.
    pub fn file_faces(&self) -> Result<Vec<u32>, CacheError> {
        let faces = self.manifest.mesh.faces;
        self.read_mesh(|file| match file.has("file_face") {
            true => file.array::<u32>("file_face", &[faces as u64]),
            // Films of the time before there were such numbers.
            false => Ok((0..faces as u32).collect()),
        })
    }

    fn read_mesh<T>(&self, arrays: impl FnOnce(&mut ArrayReader) -> Result<T, String>) -> Result<T, CacheError> {
        let path = self.folder.join("mesh.npz");
        let damaged = |reason: String| CacheError::Damaged { path: path.clone(), reason, remedy: RESTART };
        let bytes = read(&path)?.ok_or_else(|| damaged("it is not there".into()))?;
        if crc32fast::hash(&bytes) != self.manifest.mesh_crc32 {
            return Err(damaged("its checksum does not match".into()));
        }
        ArrayReader::new(&bytes).and_then(|mut file| arrays(&mut file)).map_err(damaged)
    }

    /// Writes a frame, replacing the one that may be there.
    ///
    /// # Errors
    /// [`CacheError::Unfit`] if an array does not fit the mesh or a number is not finite,
    /// [`CacheError::Io`] if the system refuses; then the frame counts as not done.
    pub fn write_frame(&self, frame: &Frame) -> Result<(), CacheError> {
        let MeshCounts { vertices, edges, faces, .. } = self.manifest.mesh;
        let number = frame.report.frame;
        frame.fits_counts(vertices, edges, faces).map_err(|reason| CacheError::Unfit { frame: number, reason })?;
        let state_path = self.state_path(number);
        let bytes = to_npz(frame).map_err(CacheError::io(&state_path, "written"))?;
        write_unless_same(&state_path, &bytes)?;
        let record = FrameRecord {
            format: FORMAT,
            fingerprint: self.manifest.fingerprint,
            state_bytes: bytes.len() as u64,
            state_crc32: crc32fast::hash(&bytes),
            report: frame.report.clone(),
        };
        let record_path = self.record_path(number);
        write_atomically(&record_path, &sealed(&record_path, &record)?)
    }

    /// Reads a frame that verifies.
    ///
    /// # Errors
    /// [`CacheError::Missing`] if it is not there, [`CacheError::Damaged`] and [`CacheError::Version`]
    /// if it is not what was written.
    pub fn read_frame(&self, frame: usize) -> Result<Frame, CacheError> {
        let (bytes, report) = self.verified(frame)?;
        let path = self.state_path(frame);
        from_npz(&bytes, report, &self.manifest.mesh).map_err(|reason| CacheError::Damaged {
            path,
            reason,
            remedy: SIMULATE_AGAIN,
        })
    }

    /// Reads the report of a frame that verifies.
    ///
    /// # Errors
    /// Those of [`Cache::read_frame`].
    pub fn read_report(&self, frame: usize) -> Result<FrameReport, CacheError> {
        Ok(self.verified(frame)?.1)
    }

    /// The last frame before which, itself included, every frame is there and verifies: a simulation goes
    /// on after it. `None` if frame 1 has to be computed.
    ///
    /// # Errors
    /// [`CacheError::Io`] if a frame is there but the system refuses to read it.
    pub fn last_valid_frame(&self) -> Result<Option<usize>, CacheError> {
        for frame in 1..=self.manifest.frame_count {
            match self.verified(frame) {
                Ok(_) => {}
                Err(CacheError::Io { path, action, source }) => return Err(CacheError::Io { path, action, source }),
                Err(_) => return Ok((frame > 1).then(|| frame - 1)),
            }
        }
        Ok(Some(self.manifest.frame_count))
    }

    /// The frames whose files are there, done or not, in order.
    ///
    /// # Errors
    /// [`CacheError::Io`]
    pub fn frames(&self) -> Result<Vec<usize>, CacheError> {
        let files = frame_files(&self.folder)?;
        let records = files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "json"));
        Ok(records.filter_map(|path| frame_number(path)).collect())
    }

    /// Removes files of frames that the film does not have, as a longer one leaves them. Returns their names.
    ///
    /// # Errors
    /// [`CacheError::Io`]
    pub fn remove_frames_beyond(&self) -> Result<Vec<String>, CacheError> {
        let beyond = |path: &PathBuf| frame_number(path).is_some_and(|k| k == 0 || k > self.manifest.frame_count);
        let old: Vec<PathBuf> = frame_files(&self.folder)?.into_iter().filter(beyond).collect();
        old.iter().try_for_each(|path| remove(path))?;
        Ok(old.iter().filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())).collect())
    }

    fn verified(&self, frame: usize) -> Result<(Vec<u8>, FrameReport), CacheError> {
        let record_path = self.record_path(frame);
        let bytes = read(&record_path)?.ok_or_else(|| CacheError::Missing { path: record_path.clone() })?;
        let record: FrameRecord = unseal(&bytes).map_err(|error| broken_seal(&record_path, error, SIMULATE_AGAIN))?;
        let path = self.state_path(frame);
        let damaged = |path: &Path, reason: &str| CacheError::Damaged {
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
fn frame_files(folder: &Path) -> Result<Vec<PathBuf>, CacheError> {
    let frames = folder.join("frames");
    let mut files = Vec::new();
    if frames.is_dir() {
        for entry in fs::read_dir(&frames).map_err(CacheError::io(&frames, "read"))? {
            let path = entry.map_err(CacheError::io(&frames, "read"))?.path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if frame_number(&path).is_some() && matches!(ending, Some("json" | "npz")) {
                files.push(path);
            }
        }
    }
    files.sort_by_key(|path| (path.extension().map(ToOwned::to_owned), path.clone()));
    Ok(files)
}

fn mesh_npz(mesh: &Mesh, places: Option<&[DVec3]>) -> io::Result<Vec<u8>> {
    let mut file = ArrayWriter::new();
    file.array("triangles", &[mesh.face_count() as u64, 3], mesh.triangles().into_iter().flatten())?;
    file.array("file_vertex", &[mesh.vertex_count() as u64], mesh.file_vertices())?;
    file.array("file_face", &[mesh.face_count() as u64], mesh.file_faces())?;
    if let Some(places) = places {
        file.array("places", &[places.len() as u64, 3], places.iter().flat_map(|place| place.to_array()))?;
    }
    file.finish()
}

fn frame_number(path: &Path) -> Option<usize> {
    let stem = path.file_stem()?.to_str()?;
    (stem.len() == 6 && stem.bytes().all(|b| b.is_ascii_digit())).then(|| stem.parse().ok()).flatten()
}

/// A file that already has the bytes is left alone, so that looking at a film does not touch it.
fn write_unless_same(path: &Path, bytes: &[u8]) -> Result<(), CacheError> {
    if read(path)?.as_deref() == Some(bytes) { Ok(()) } else { write_atomically(path, bytes) }
}

fn sealed(path: &Path, record: &impl Serialize) -> Result<Vec<u8>, CacheError> {
    seal(record).map_err(|error| CacheError::io(path, "written")(error.into()))
}

fn broken_seal(path: &Path, error: SealError, remedy: &'static str) -> CacheError {
    match error {
        SealError::Version(found) => CacheError::Version { path: path.to_owned(), found },
        SealError::Damaged(reason) => CacheError::Damaged { path: path.to_owned(), reason, remedy },
    }
}
