//! `sweep`: a scene run once for every combination of values, and what all of them are worth.

mod children;
mod combinations;
mod request;
mod results;
mod room;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use self::children::{Ended, Work, log_of};
use self::combinations::Run;
pub(super) use self::request::Request;
use self::results::{Row, csv, row_of, write_rows};
use self::room::room_for;
use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use crate::film::{self, DiskError, Tile};
use crate::scene::Scene;
use crate::whole_file;

/// How long each run took until now, so that one that is gone on with has the time of all.
const SECONDS: &str = "seconds.json";

/// Runs them all, those first that are first in the order of the table, and writes `sweep.csv` and `sweep.png`.
pub(super) fn sweep(request: &Request, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    let (runs, scenes) = request.runs()?;
    let Some(first) = scenes.first() else { return Ok(()) };
    let folder = request.folder(first)?;
    session.hold(&folder)?;
    let faces = first.surface().map_err(PipelineError::from)?.mesh.face_count();
    let [at_once, threads] = room_for(runs.len(), rayon::current_num_threads(), first, faces);
    session.log.note(format_args!("{} runs, {at_once} at a time", runs.len()));
    let mut times = Times::of(&folder, request.restart)?;
    let mut rows = BTreeMap::new();
    let mut failed = false;
    let work = Work { request, folder: &folder, at_once, threads };
    work.run(&runs, session, |&Ended { index, code, seconds }| {
        let run = &runs[index];
        failed |= code != Some(0);
        let row = row_of(&folder, run, times.add(run, seconds)?);
        session.log.note(format_args!("{} of {}: {}: {}", rows.len() + 1, runs.len(), run.name, row.in_words()));
        if !matches!(code, Some(0 | 1)) || row.inspection.is_none() {
            session.log.error(format_args!("{}: it failed; {} says why", run.name, log_of(&folder, run).display()));
        }
        rows.insert(index, row);
        Ok(())
    })?;
    let rows: Vec<Row> = rows.into_values().collect();
    write(&folder.join("sweep.csv"), csv(&rows).as_bytes())?;
    write_rows(out, &rows)?;
    let films = rows.iter().zip(scenes).filter(|(row, scene)| row.frames() == scene.clock.frames);
    let tile = |(row, scene): (&Row, Scene)| Tile {
        scene,
        folder: folder.join(&row.run.name),
        captions: [row.run.name.replace(',', ", "), row.caption()],
    };
    let whole: Vec<Tile> = films.map(tile).collect();
    let picture = folder.join("sweep.png");
    film::make_sheet_of_films(&whole, &picture, &mut |event| session.log.pictures(event))
        .map_err(PipelineError::from)?;
    session.log.finish();
    writeln!(out, "{}: table and picture written", one_line(&folder.to_string_lossy()))?;
    if failed { Err(Failure::NotWell) } else { Ok(()) }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), PipelineError> {
    Ok(whole_file::write_unless_same(path, bytes).map_err(DiskError::io(path, "written"))?)
}

/// The seconds of each run, by its name.
struct Times {
    path: PathBuf,
    seconds: BTreeMap<String, f64>,
}

impl Times {
    /// Those that are kept with a sweep; none if they cannot be read.
    fn of(folder: &Path, restart: bool) -> Result<Times, PipelineError> {
        let folder = folder.join(".immerse");
        whole_file::create_folder(&folder).map_err(DiskError::io(&folder, "written"))?;
        let path = folder.join(SECONDS);
        let kept = if restart { None } else { std::fs::read(&path).ok() };
        let seconds = kept.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
        Ok(Times { path, seconds })
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
}
