//! `export`: a film as other programs read it.

use std::io::Write;
use std::path::Path;

use super::arguments::FrameRange;
use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::leftovers::say_removed;
use super::process::Session;
use crate::film::{self, Arrivals, Exported, FilmFolder};
use crate::scene::ExportFormat;

/// What is typed after `export`.
pub(super) struct Request<'a> {
    pub folder: &'a Path,
    pub formats: &'a [ExportFormat],
    pub to: Option<&'a Path>,
    pub restart: bool,
}

/// Exports what is typed; all frames unless some are named.
pub(super) fn export(
    request: &Request,
    frames: Option<&FrameRange>,
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let film = FilmFolder::open(request.folder).map_err(PipelineError::from)?;
    let count = film.manifest().frame_count;
    let frames = match frames {
        Some(range) => range.frames(count)?,
        None => (1..=count).collect(),
    };
    session.hold(request.folder)?;
    // Nobody waits for himself.
    let same = |a: &Path, b: &Path| a == b || a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
    if let Some(to) = request.to.filter(|to| !same(to, request.folder)) {
        session.hold(to)?;
    }
    write(request, &frames, session, out)
}

/// Writes frames of a film that nobody else writes to meanwhile.
pub(super) fn write(
    request: &Request,
    frames: &[usize],
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let to = request.to.map(Path::to_owned).unwrap_or_else(|| request.folder.join("export"));
    for &format in request.formats {
        let arrivals = Arrivals::over().unless(session.signals.flag());
        let watch = &mut |event| session.log.pictures(event);
        let exported = film::export(request.folder, format, frames, &to, request.restart, &arrivals, watch);
        let Exported { made, kept, removed } = exported.map_err(PipelineError::from)?;
        session.log.finish();
        say_removed(&to, &removed, &session.log);
        let kept = if kept > 0 { format!(", {kept} were there") } else { String::new() };
        let (files, name) = (if made == 1 { "file" } else { "files" }, format.name());
        writeln!(out, "{}: {made} {name} {files} written{kept}", one_line(&to.to_string_lossy()))?;
    }
    Ok(())
}
