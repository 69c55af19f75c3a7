//! `export`: a film as other programs read it.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::frame_range::FrameRange;
use super::process::Session;
use crate::film::{self, Arrivals, Exported, FilmFolder};
use crate::scene::ExportFormat;

/// What is typed after `export`.
pub(super) struct Request<'a> {
    pub folder: &'a Path,
    pub formats: &'a [ExportFormat],
    pub frames: Option<&'a FrameRange>,
    pub to: Option<&'a PathBuf>,
    pub restart: bool,
}

/// Exports what is typed.
pub(super) fn export(request: &Request, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    let film = FilmFolder::open(request.folder).map_err(PipelineError::from)?;
    let count = film.manifest().frame_count;
    let frames = match request.frames {
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
    let to = request.to.cloned().unwrap_or_else(|| request.folder.join("export"));
    for &format in request.formats {
        let arrivals = Arrivals::over().unless(session.signals.flag());
        let watch = &mut |event| session.log.pictures(event);
        let exported = film::export(request.folder, format, frames, &to, request.restart, &arrivals, watch);
        let Exported { made, kept, removed } = exported.map_err(PipelineError::from)?;
        session.log.finish();
        if !removed.is_empty() {
            let (count, names) = (removed.len(), removed.join(", "));
            session
                .log
                .note(format_args!("{}: removed what is not of this film ({count} files): {names}", to.display()));
        }
        let kept = if kept > 0 { format!(", {kept} were there") } else { String::new() };
        let (files, name) = (if made == 1 { "file" } else { "files" }, format.name());
        writeln!(out, "{}: {made} {name} {files} written{kept}", one_line(&to.to_string_lossy()))?;
    }
    Ok(())
}
