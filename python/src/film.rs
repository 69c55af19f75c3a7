//! `immerse.Film`.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use immerse::film::{Event, FilmFolder, FilmMesh, FilmSpec, FolderLock, Plan, make_pictures, take_picture};
use immerse::mesh::shapes::Shape;
use immerse::scene::{MeshSection, clock_of};
use immerse::{Scene, Simulation};
use numpy::{PyArray1, PyArray3};
use pyo3::prelude::*;

use super::arrays::vector;
use super::errors::{of_disk, of_evolve, of_film, of_mistake, refused};
use super::frames::Frames;
use super::mesh::Mesh;
use super::picture::pixels;
use super::scenes::{absolute, scene_of};
use super::shape::Frame;

/// A film: the frames of a scene, one after another. Iterating over it computes them.
///
/// Parameters
/// ----------
/// scene : path, str or dict
///     The path of a scene file; or the text of one, which is told from a path by its line breaks; or a dict with the same
///     keys, such as ``{"mesh": {"shape": "sphere"}, "clock": {"frames": 24}}``. Arrays of NumPy may stand for lists.
/// folder : path, optional
///     Keeps frames there, as the program does: those that are there already are read and not computed again. Left out, frames
///     are nowhere but in memory, and no longer than somebody holds them.
/// base : path
///     Where relative paths in a text or dict start.
///
/// Raises
/// ------
/// Error
///     With every mistake in the scene, each with its line and a caret; the lines of a dict are those it has as TOML.
///
/// Examples
/// --------
/// >>> for frame in immerse.Film("scenes/breathing_torus.toml"):
/// ...     print(frame.time, frame.report["l2_length_error"])
#[pyclass(module = "immerse", frozen)]
pub struct Film {
    scene: Option<Arc<Scene>>,
    mesh: Py<Mesh>,
    folder: Option<PathBuf>,
    times: Vec<f64>,
    /// A simulation that no frame was asked of yet.
    fresh: Mutex<Option<Simulation>>,
}

/// The frames of a film that are kept on disk, while they are computed.
pub struct Kept {
    /// The folder.
    pub folder: FilmFolder,
    /// Per frame: whether it is there.
    pub valid: Vec<bool>,
    /// Keeps others out.
    pub _lock: FolderLock,
}

impl Film {
    /// A simulation at its beginning.
    pub fn simulation(&self, py: Python<'_>) -> PyResult<Simulation> {
        let fresh = self.fresh.lock().unwrap_or_else(PoisonError::into_inner).take();
        match (fresh, &self.scene) {
            (Some(simulation), _) => Ok(simulation),
            (None, Some(scene)) => py.detach(|| scene.simulation()).map_err(|mistake| of_mistake(py, &mistake)),
            (None, None) => Err(self.without_scene(py)),
        }
    }

    /// Begins a film on disk, or goes on with it.
    pub fn keep(&self, py: Python<'_>) -> PyResult<Option<Kept>> {
        let (Some(folder), Some(scene)) = (&self.folder, &self.scene) else { return Ok(None) };
        Plan::of(scene).map_err(|error| of_film(py, &error))?;
        let lock = FolderLock::try_take(folder, "Python").map_err(|error| of_disk(py, &error))?;
        let film = match FilmFolder::open_unchanged(folder, scene).map_err(|error| of_disk(py, &error))? {
            Some(film) => film,
            None => {
                let mut simulation = self.simulation(py)?;
                let keys = py.detach(|| simulation.frame_keys()).map_err(|error| self.fault(py, &error))?;
                let mesh = film_mesh(scene, &simulation).map_err(|mistake| of_mistake(py, &mistake))?;
                let spec = FilmSpec::of(scene, keys);
                let opened = py.detach(|| FilmFolder::open_or_create(folder, &spec, &mesh));
                opened.map_err(|error| of_disk(py, &error))?.0
            }
        };
        let valid = py.detach(|| film.valid_frames()).map_err(|error| of_disk(py, &error))?;
        Ok(Some(Kept { folder: film, valid, _lock: lock }))
    }

    /// An error of its simulation, at the key of the scene that is at fault.
    pub fn fault(&self, py: Python<'_>, error: &immerse::evolve::EvolveError) -> PyErr {
        match self.scene.as_ref().and_then(|scene| scene.fault(error)) {
            Some(mistake) => of_mistake(py, &mistake),
            None => of_evolve(py, error),
        }
    }

    /// Its mesh.
    pub fn mesh_of(&self, py: Python<'_>) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// Number of frames.
    pub fn count(&self) -> usize {
        self.times.len()
    }

    /// The folder of a film that is only read.
    pub fn read_only(&self) -> Option<&Path> {
        self.folder.as_deref().filter(|_| self.scene.is_none())
    }

    /// The scene whose text lies in the folder of a film that was opened from there.
    fn kept_scene(&self, py: Python<'_>, folder: &Path) -> PyResult<Arc<Scene>> {
        let kept = FilmFolder::open(folder).and_then(|film| film.scene()).map_err(|error| of_disk(py, &error))?;
        let mut scene = kept.ok_or_else(|| self.without_scene(py))?;
        if scene.clock.a_frame_for_each_class {
            let counted = clock_of(&scene, &self.mesh.get().mesh);
            scene.clock = counted.map_err(|mistake| of_mistake(py, &mistake))?;
        }
        Ok(Arc::new(scene))
    }

    fn without_scene(&self, py: Python<'_>) -> PyErr {
        let remedy = "make it of its scene, `Film(scene, folder=...)`";
        refused(py, "this film was opened from its folder, which does not hold its scene", remedy)
    }

    fn on_disk(&self, py: Python<'_>) -> PyResult<&Path> {
        self.folder.as_deref().ok_or_else(|| {
            let remedy = "make it with `Film(scene, folder=...)`; `render` makes a picture of any frame";
            refused(py, "this film has no folder", remedy)
        })
    }

    fn check(&self, py: Python<'_>, number: i64) -> PyResult<usize> {
        if let Some(number) = usize::try_from(number).ok().filter(|number| (1..=self.count()).contains(number)) {
            return Ok(number);
        }
        let reason = format!("there is no frame {number}");
        Err(refused(py, reason, format!("frames are counted from 1, and the last one is {}", self.count())))
    }

    /// What a picture is made of: the scene and the folder, in which all frames are.
    fn complete(slf: &Bound<'_, Self>, progress: Option<Py<PyAny>>) -> PyResult<(Arc<Scene>, PathBuf)> {
        let (py, film) = (slf.py(), slf.get());
        let folder = film.on_disk(py)?.to_owned();
        let Some(scene) = film.scene.clone() else { return Ok((film.kept_scene(py, &folder)?, folder)) };
        Frames::of(slf.clone().unbind(), progress).run_to_end(py)?;
        Ok((scene, folder))
    }
}

/// What is kept of the surface beside the frames.
fn film_mesh(scene: &Scene, simulation: &Simulation) -> Result<FilmMesh, immerse::scene::SceneError> {
    let lattice = match scene.mesh {
        MeshSection::Shape(Shape::FlatTorus { a, b, .. }) => Some([a, b]),
        _ => None,
    };
    let places = scene.surface()?.places().map(<[glam::DVec3]>::to_vec);
    Ok(FilmMesh { mesh: simulation.mesh().clone(), places, pins: simulation.pinned().to_vec(), lattice })
}

#[pymethods]
impl Film {
    #[new]
    #[pyo3(signature = (scene, *, folder=None, base=None))]
    fn new(scene: &Bound<'_, PyAny>, folder: Option<PathBuf>, base: Option<PathBuf>) -> PyResult<Film> {
        let py = scene.py();
        let scene = scene_of(scene, base.unwrap_or_default())?;
        let simulation = py.detach(|| scene.simulation()).map_err(|mistake| of_mistake(py, &mistake))?;
        Ok(Film {
            mesh: Py::new(py, Mesh::of(simulation.mesh().clone()))?,
            times: simulation.clock().times().collect(),
            folder: folder.as_deref().map(absolute).transpose()?,
            fresh: Mutex::new(Some(simulation)),
            scene: Some(Arc::new(scene)),
        })
    }

    /// Opens the folder of a film, made here or by the program, to read its frames.
    ///
    /// Raises
    /// ------
    /// Error
    ///     If it holds no film, or one that is damaged or of another version.
    /// OSError
    ///     If there is no such folder.
    #[staticmethod]
    fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Film> {
        let folder = absolute(&folder)?;
        let (mesh, times) = py
            .detach(|| {
                let film = FilmFolder::open(&folder)?;
                let time = |frame: usize| film.contents(frame).map_or(f64::NAN, |(_, report)| report.time);
                let times = (1..=film.manifest().frame_count).map(time).collect();
                Ok((film.mesh()?.mesh, times))
            })
            .map_err(|error| of_disk(py, &error))?;
        let mesh = Py::new(py, Mesh::of(mesh))?;
        Ok(Film { scene: None, mesh, folder: Some(folder), times, fresh: Mutex::new(None) })
    }

    /// The mesh of all frames.
    #[getter]
    fn mesh(&self, py: Python<'_>) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// Times of the frames, in the units of the clock: float64, (n,). Of a film that was opened from its folder, NaN for
    /// frames that are not there.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.times.clone())
    }

    /// The folder where frames are kept, if they are.
    #[getter]
    fn folder(&self) -> Option<PathBuf> {
        self.folder.clone()
    }

    /// Iterates over the frames. As often as one likes: without a folder, each time from the start.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called after every step with a `Progress`. If it returns False the film ends there with `Stopped`; frames that are
    ///     kept in a folder stay, and the film goes on after them another time.
    #[pyo3(signature = (progress=None))]
    fn frames(slf: Bound<'_, Self>, progress: Option<Py<PyAny>>) -> Frames {
        Frames::of(slf.unbind(), progress)
    }

    /// Reads one frame of a film that is kept in a folder.
    ///
    /// Parameters
    /// ----------
    /// number : int
    ///     From 1, as its files are called.
    fn read(&self, py: Python<'_>, number: i64) -> PyResult<Py<Frame>> {
        let number = self.check(py, number)?;
        let folder = self.on_disk(py)?;
        let frame = py.detach(|| FilmFolder::open(folder)?.read_frame(number)).map_err(|error| of_disk(py, &error))?;
        Frame::of(py, self.mesh.clone_ref(py), Arc::new(frame))
    }

    /// The picture of a frame as the scene asks for it, with its camera, lights and look: what the program writes as PNG.
    /// Frames that are not there yet are computed first; of a film that was opened from its folder they must be there. For
    /// films with a folder.
    ///
    /// Parameters
    /// ----------
    /// number : int
    ///     The frame, from 1.
    /// progress : callable, optional
    ///     As in `frames`.
    ///
    /// Returns
    /// -------
    /// array of uint8, (height, width, 4)
    ///     sRGB over the background, rows from the top; the last channel is 255.
    #[pyo3(signature = (number, progress=None))]
    fn picture(slf: &Bound<'_, Self>, number: i64, progress: Option<Py<PyAny>>) -> PyResult<Py<PyArray3<u8>>> {
        let py = slf.py();
        let number = slf.get().check(py, number)?;
        let (scene, folder) = Film::complete(slf, progress)?;
        let picture = py.detach(|| take_picture(&scene, &folder, number, &mut |_: Event| ()));
        pixels(py, &picture.map_err(|error| of_film(py, &error))?)
    }

    /// Makes all pictures that the scene asks for, stills, animations and contact sheet, in the folder of the film, as
    /// `immerse run` does. Those that are there and still right are kept.
    #[pyo3(signature = (progress=None))]
    fn make_pictures(slf: &Bound<'_, Self>, progress: Option<Py<PyAny>>) -> PyResult<()> {
        let py = slf.py();
        let (scene, folder) = Film::complete(slf, progress)?;
        let _lock = FolderLock::try_take(&folder, "Python").map_err(|error| of_disk(py, &error))?;
        let frames: Vec<usize> = (1..=slf.get().count()).collect();
        let made = py.detach(|| make_pictures(&scene, &folder, &frames, &mut |_: Event| ()));
        made.map(drop).map_err(|error| of_film(py, &error))
    }

    fn __iter__(slf: Bound<'_, Self>) -> Frames {
        Frames::of(slf.unbind(), None)
    }

    fn __len__(&self) -> usize {
        self.count()
    }

    fn __repr__(&self) -> String {
        let faces = match &self.scene {
            Some(scene) => format!("`{}`", scene.name),
            None => "on disk".to_owned(),
        };
        format!("<immerse.Film {faces}: {} frames>", self.count())
    }
}
