//! The iterator over the frames of a film.

use std::sync::{Arc, Mutex};

use immerse::Simulation;
use immerse::advice::Advice;
use immerse::evolve;
use immerse::film::FilmFolder;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use super::errors::{of_disk, refused};
use super::film::{Film, Kept};
use super::shape::Frame;
use super::watching::Watcher;

/// Frames of a film, one after another, as `iter(film)` and `film.frames()` give them.
#[pyclass(module = "immerse", frozen)]
pub struct Frames {
    film: Py<Film>,
    progress: Option<Py<PyAny>>,
    state: Mutex<State>,
}

/// How far it has come.
#[derive(Default)]
struct State {
    /// The last frame that was handed out; 0 before the first.
    done: usize,
    simulation: Option<Simulation>,
    /// Of a film with a folder, from its first frame on.
    kept: Option<Kept>,
}

impl Frames {
    /// From the start of a film.
    pub fn of(film: Py<Film>, progress: Option<Py<PyAny>>) -> Frames {
        Frames { film, progress, state: Mutex::new(State::default()) }
    }

    /// Computes what is left of the film.
    pub fn run_to_end(&self, py: Python<'_>) -> PyResult<()> {
        if let Ok(mut state) = self.state.try_lock() {
            let film = self.film.get();
            state.kept = film.keep(py)?;
            // They need not be read to know that they are there.
            state.done = state.kept.as_ref().map_or(0, |kept| kept.valid.iter().take_while(|&&valid| valid).count());
        }
        while self.next(py)?.is_some() {}
        Ok(())
    }

    fn next(&self, py: Python<'_>) -> PyResult<Option<Arc<evolve::Frame>>> {
        let Ok(mut state) = self.state.try_lock() else {
            return Err(PyRuntimeError::new_err("another thread is taking a frame of this iterator"));
        };
        let film = self.film.get();
        if state.done == film.count() {
            // Others may have the folder.
            *state = State { done: state.done, ..State::default() };
            return Ok(None);
        }
        let frame = match film.read_only() {
            Some(folder) => {
                let number = state.done + 1;
                let read = py.detach(|| FilmFolder::open(folder)?.read_frame(number));
                Arc::new(read.map_err(|error| of_disk(py, &error))?)
            }
            None => self.make(py, film, &mut state)?,
        };
        state.done += 1;
        if state.done == film.count() {
            *state = State { done: state.done, ..State::default() };
        }
        Ok(Some(frame))
    }

    /// The next frame, from disk or computed.
    fn make(&self, py: Python<'_>, film: &Film, state: &mut State) -> PyResult<Arc<evolve::Frame>> {
        if state.done == 0 && state.kept.is_none() {
            state.kept = film.keep(py)?;
        }
        let number = state.done + 1;
        if let Some(Kept { folder, valid, .. }) = &state.kept
            && valid.get(state.done) == Some(&true)
        {
            // What a simulation had reached is behind it now.
            state.simulation = None;
            let read = py.detach(|| folder.read_frame(number));
            return Ok(Arc::new(read.map_err(|error| of_disk(py, &error))?));
        }
        let mut simulation = match state.simulation.take() {
            Some(simulation) => simulation,
            None => self.set_up_after(py, film, state)?,
        };
        let mut watcher = Watcher::new(self.progress.as_ref().map(|callback| callback.clone_ref(py)), film.count());
        let made = py.detach(|| simulation.next_frame(&mut watcher));
        let frame = match (watcher.raised(), made) {
            (Some(error), _) => return Err(error),
            (None, made) => made.map_err(|error| film.fault(py, &error))?,
        };
        if let Some(Kept { folder, .. }) = &state.kept {
            py.detach(|| folder.write_frame(&frame)).map_err(|error| of_disk(py, &error))?;
        }
        state.simulation = Some(simulation);
        Ok(frame)
    }

    /// A simulation that goes on after the frames that were handed out.
    fn set_up_after(&self, py: Python<'_>, film: &Film, state: &State) -> PyResult<Simulation> {
        let mut simulation = film.simulation(py)?;
        if state.done == 0 {
            return Ok(simulation);
        }
        let Some(Kept { folder, .. }) = &state.kept else {
            // It was stopped half way through a frame, and nothing of it is kept.
            return Err(refused(py, "this iterator was stopped", "iterate over the film anew"));
        };
        let before = py.detach(|| folder.read_frame(state.done)).map_err(|error| of_disk(py, &error))?;
        let resumed = py.detach(|| simulation.resume(Arc::new(before)));
        resumed.map_err(|error| {
            let reason = format!("the film cannot go on after frame {}: {}", state.done, error.reason());
            refused(py, reason, "remove its folder to begin anew")
        })?;
        Ok(simulation)
    }
}

#[pymethods]
impl Frames {
    fn __iter__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Py<Frame>>> {
        match self.next(py)? {
            Some(frame) => Frame::of(py, self.film.get().mesh_of(py), frame).map(Some),
            None => Ok(None),
        }
    }
}
