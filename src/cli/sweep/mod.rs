//! `sweep`: a scene run once for every combination of values, and what all of them are worth.

mod children;
mod combinations;
mod results;
mod room;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use self::children::{Ended, Work, log_of};
use self::combinations::{Run, combinations};
use self::results::{csv, row_of, write_rows};
use self::room::room_for;
use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use super::set_up::{count_classes, folder_of};
use crate::film::{self, DiskError, Tile};
use crate::scene::{MeshSection, Scene, SceneErrors};
use crate::whole_file;

/// What is asked for.
pub(super) struct Request<'a> {
    pub scene: &'a Path,
    pub mesh: Option<&'a Path>,
    pub set: &'a [String],
    pub out: Option<&'a Path>,
    pub restart: bool,
}

/// How long each run took until now, so that one that is gone on with has the time of all.
const SECONDS: &str = "seconds.json";
/// More runs are a mistake.
const MOST_RUNS: usize = 10_000;

/// Runs them all, those first that are first in the order of the table, and writes `sweep.csv` and `sweep.png`.
pub(super) fn sweep(request: &Request, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    let count = combinations::count(request.set);
    if count > MOST_RUNS {
        return Err(Failure::Sweep(count));
    }
    let runs = combinations(request.set);
    let scenes = scenes_of(request, &runs)?;
    let Some(first) = scenes.first() else { return Ok(()) };
    let folder = match request.out {
        Some(folder) => folder.to_owned(),
        None => beside(folder_of(first, request.scene, Path::new("renders"))?),
    };
    session.hold(&folder)?;
    let faces = first.surface().map_err(PipelineError::from)?.mesh.face_count();
    let [at_once, threads] = room_for(runs.len(), rayon::current_num_threads(), first, faces);
    session.log.note(format_args!("{} runs, {at_once} at a time", runs.len()));
    let work =
        Work { scene: request.scene, mesh: request.mesh, folder: &folder, restart: request.restart, at_once, threads };
    let mut times = Times::of(&folder, request.restart);
    let (mut done, mut failed) = (0, false);
    work.run(&runs, session, |&Ended { index, code, seconds }| {
        let run = &runs[index];
        done += 1;
        failed |= code != Some(0);
        let seconds = times.add(run, seconds)?;
        let row = row_of(&folder, run, seconds);
        session.log.note(format_args!("{done} of {}: {}: {}", runs.len(), run.name, row.in_words()));
        if !matches!(code, Some(0 | 1)) || row.inspection.is_none() {
            session.log.error(format_args!("{}: it failed; {} says why", run.name, log_of(&folder, run).display()));
        }
        Ok(())
    })?;
    let rows: Vec<_> = runs.iter().map(|run| row_of(&folder, run, times.of_run(run))).collect();
    let table = folder.join("sweep.csv");
    write(&table, csv(&rows).as_bytes())?;
    write_rows(out, &rows)?;
    let whole: Vec<Tile> = runs
        .iter()
        .zip(scenes)
        .zip(&rows)
        .filter(|((_, scene), row)| row.frames() == scene.clock.frames)
        .map(|((run, scene), row)| Tile {
            scene,
            folder: folder.join(&run.name),
            captions: [run.name.replace(',', ", "), row.caption()],
        })
        .collect();
    let picture = folder.join("sweep.png");
    film::make_sheet_of_films(&whole, &picture, &mut |event| session.log.pictures(event))
        .map_err(PipelineError::from)?;
    session.log.finish();
    writeln!(out, "{}: table and picture written", one_line(&folder.to_string_lossy()))?;
    if failed { Err(Failure::NotWell) } else { Ok(()) }
}

/// The scenes of all runs. Nothing begins if one of them has a mistake.
fn scenes_of(request: &Request, runs: &[Run]) -> Result<Vec<Scene>, Failure> {
    let scene = |run: &Run| -> Result<Scene, SceneErrors> {
        let mut scene = Scene::read_with(request.scene, &run.settings)?;
        if let Some(mesh) = request.mesh {
            scene.mesh = MeshSection::File(std::path::absolute(mesh).unwrap_or_else(|_| mesh.to_owned()));
        }
        Ok(scene)
    };
    let mut scenes = runs.iter().map(scene).collect::<Result<Vec<_>, _>>().map_err(PipelineError::from)?;
    scenes.iter_mut().try_for_each(count_classes)?;
    Ok(scenes)
}

/// The folder of a sweep of a scene whose own film has this one.
fn beside(folder: PathBuf) -> PathBuf {
    let mut name = folder.into_os_string();
    name.push(".sweep");
    PathBuf::from(name)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), PipelineError> {
    let failed = |source| DiskError::Io { path: path.to_owned(), action: "written", source };
    if let Some(folder) = path.parent() {
        whole_file::create_folder(folder).map_err(failed)?;
    }
    Ok(whole_file::write_unless_same(path, bytes).map_err(failed)?)
}

/// The seconds of each run, by its name.
struct Times {
    path: PathBuf,
    seconds: BTreeMap<String, f64>,
}

impl Times {
    /// Those that are kept with a sweep; none if they cannot be read.
    fn of(folder: &Path, restart: bool) -> Times {
        let path = folder.join(".immerse").join(SECONDS);
        let kept = if restart { None } else { std::fs::read(&path).ok() };
        let seconds = kept.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
        Times { path, seconds }
    }

    /// Adds to those of a run; returns all of it.
    fn add(&mut self, run: &Run, seconds: f64) -> Result<f64, PipelineError> {
        let all = self.seconds.entry(run.name.clone()).or_default();
        *all += seconds;
        let all = *all;
        let text = serde_json::to_vec_pretty(&self.seconds).unwrap_or_default();
        write(&self.path, &text)?;
        Ok(all)
    }

    fn of_run(&self, run: &Run) -> f64 {
        self.seconds.get(&run.name).copied().unwrap_or_default()
    }
}
