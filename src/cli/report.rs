//! `report`: a film as one page.

use std::io::Write;
use std::path::Path;

use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use super::results::{Inspection, findings};
use crate::film::{self, Arrivals, FilmFolder, REPORT, Reported};

/// Writes the page of the film in a folder.
pub(super) fn report(folder: &Path, restart: bool, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    FilmFolder::open(folder).map_err(PipelineError::from)?;
    session.hold(folder)?;
    let inspection = Inspection::of(folder).map_err(PipelineError::from)?;
    let line = write_report(folder, &inspection, restart, session)?;
    Ok(writeln!(out, "{line}")?)
}

/// Writes the page of a film that nobody else writes to meanwhile. Returns what there is to say.
pub(super) fn write_report(
    folder: &Path,
    inspection: &Inspection,
    restart: bool,
    session: &Session,
) -> Result<String, Failure> {
    let film = FilmFolder::open(folder).map_err(PipelineError::from)?;
    let findings = findings(inspection, &film.manifest().scene);
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    let reported = film::report(folder, &findings, restart, &arrivals, watch).map_err(PipelineError::from)?;
    session.log.finish();
    let done = match reported {
        Reported::Made => "written",
        Reported::Kept => "was there",
    };
    Ok(format!("{}: {REPORT} {done}", one_line(&folder.to_string_lossy())))
}
