//! `farm`: job files for the engines that farms have, as text.
//!
//! A film is three steps: its frames are computed, pictures of them are made by several tasks at a time, and the rest is put together
//! and verified. A sweep is two: all runs, and the table of them. A [`Job`] says that in words of the command line, and each engine has a
//! file that writes it as the engine reads it.

mod chunks;
mod commands;
mod job;
mod openjd;
mod slurm;
mod words;
mod written;

use std::io::Write;
use std::path::Path;

use clap::ValueEnum;

use self::job::Job;
use self::written::Written;
use super::arguments::FrameRange;
use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use super::shell;
use super::sweep;
use crate::film::DiskError;
use crate::whole_file;

/// What job files are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Engine {
    /// Batch scripts and one that submits them
    Slurm,
    /// A job template of Open Job Description
    Openjd,
    /// Lists of shell commands, one a line, for GNU parallel and the like
    Commands,
}

/// Writes the job files of a film, or of a sweep if a key has several values, into the folder `farm` in its folder. Nothing is
/// written if the scene has a mistake.
pub(super) fn farm(
    what: &sweep::Request,
    engine: Engine,
    frames: Option<&FrameRange>,
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let job = Job::of(what, frames, &session.log)?;
    let folder = job.folder.join("farm");
    let quoted = shell::quoted(&words::text_of(&folder)?);
    let Written { files, start } = match engine {
        Engine::Slurm => slurm::write(&job),
        Engine::Openjd => openjd::write(&job)?,
        Engine::Commands => commands::write(&job),
    };
    session.hold(&folder)?;
    // Of another job, which had other steps.
    for name in of_engine(engine).iter().filter(|&&name| files.iter().all(|(written, _)| written != name)) {
        let path = folder.join(name);
        whole_file::remove(&path).map_err(DiskError::io(&path, "removed")).map_err(PipelineError::from)?;
    }
    for (name, text) in &files {
        write(&folder.join(name), text)?;
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    writeln!(out, "{}: {} written, {}", one_line(&folder.to_string_lossy()), names.join(", "), job.in_words())?;
    Ok(writeln!(out, "start with: {}", start.replace("{}", &quoted))?)
}

/// All files that an engine may have.
fn of_engine(engine: Engine) -> &'static [&'static str] {
    match engine {
        Engine::Slurm => slurm::FILES,
        Engine::Openjd => openjd::FILES,
        Engine::Commands => commands::FILES,
    }
}

fn write(path: &Path, text: &str) -> Result<(), PipelineError> {
    Ok(whole_file::write_unless_same(path, text.as_bytes()).map_err(DiskError::io(path, "written"))?)
}
