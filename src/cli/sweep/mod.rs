//! `sweep`: a scene run once for every combination of values, and what all of them are worth.

mod children;
mod combinations;
mod kept;
mod page;
mod request;
mod results;
mod room;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use self::children::{Ended, Work, log_of};
use self::kept::Kept;
use self::page::write_page;
pub(super) use self::request::Request;
use self::results::{Row, csv, row_of, write_rows};
use self::room::room_for;
use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use crate::film::{self, DiskError, REPORT, Tile};
use crate::scene::Scene;
use crate::whole_file;

/// The picture of all films.
pub(super) const POSTER: &str = "sweep.png";

/// Runs them all, those first that are first in the order of the table, and writes `sweep.csv`, `sweep.png` and a page.
pub(super) fn sweep(request: &Request, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    let (runs, scenes) = request.runs()?;
    let Some(first) = scenes.first() else { return Ok(()) };
    let folder = request.folder(first)?;
    session.hold(&folder)?;
    let has_page = first.output.report;
    let faces = first.surface().map_err(PipelineError::from)?.mesh.face_count();
    let [at_once, threads] = room_for(runs.len(), rayon::current_num_threads(), first, faces);
    session.log.note(format_args!("{} runs, {at_once} at a time", runs.len()));
    let mut kept = Kept::begin(&folder, &first.name, request.command(&first.name), &runs, request.restart)?;
    let mut inspections = BTreeMap::new();
    let mut failed = false;
    let work = Work { request, folder: &folder, at_once, threads };
    work.run(&runs, session, |&Ended { index, code, seconds }| {
        failed |= code != Some(0);
        kept.add(&folder, index, seconds)?;
        let row = row_of(&folder, &kept.runs[index]);
        let ended = inspections.len() + 1;
        session.log.note(format_args!("{ended} of {}: {}: {}", runs.len(), row.run.name, row.in_words()));
        if !matches!(code, Some(0 | 1)) || row.inspection.is_none() {
            let log = log_of(&folder, row.run);
            session.log.error(format_args!("{}: it failed; {} says why", row.run.name, log.display()));
        }
        inspections.insert(index, row.inspection);
        Ok(())
    })?;
    let rows: Vec<Row> = kept.runs.iter().zip(inspections.into_values()).map(Row::from).collect();
    write(&folder.join("sweep.csv"), csv(&rows).as_bytes())?;
    write_rows(out, &rows)?;
    if has_page {
        write_page(&folder, &kept, &rows, session)?;
    }
    write_poster(&folder, &rows, scenes, session)?;
    session.log.finish();
    let page = if has_page { ", page" } else { "" };
    writeln!(out, "{}: table{page} and picture written", one_line(&folder.to_string_lossy()))?;
    if failed { Err(Failure::NotWell) } else { Ok(()) }
}

/// Writes the page of a sweep anew, of its films as they are; `None` if the folder is not that of one.
pub(super) fn report_of_sweep(folder: &Path, session: &Session, out: &mut impl Write) -> Option<Result<(), Failure>> {
    let kept = Kept::of(folder)?;
    let mut write = || {
        session.hold(folder)?;
        let rows: Vec<Row> = kept.runs.iter().map(|run| row_of(folder, run)).collect();
        write_page(folder, &kept, &rows, session)?;
        session.log.finish();
        Ok(writeln!(out, "{}: {REPORT} written", one_line(&folder.to_string_lossy()))?)
    };
    Some(write())
}

/// The last frame of each film that is whole, as one picture.
fn write_poster(folder: &Path, rows: &[Row], scenes: Vec<Scene>, session: &Session) -> Result<(), PipelineError> {
    let films = rows.iter().zip(scenes).filter(|(row, _)| row.is_whole());
    let tile =
        |(row, scene): (&Row, Scene)| Tile { scene, folder: folder.join(&row.run.name), captions: row.captions() };
    let whole: Vec<Tile> = films.map(tile).collect();
    let path = folder.join(POSTER);
    Ok(film::make_sheet_of_films(&whole, &path, &mut |event| session.log.pictures(event))?)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), PipelineError> {
    Ok(whole_file::write_unless_same(path, bytes).map_err(DiskError::io(path, "written"))?)
}
