//! What each command does, and with which exit code it ends.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::{CommandFactory, Parser};

use super::arguments::{Arguments, Command, Film, PictureOptions, SceneFile};
use super::certify::{Asked, certify, certify_as_asked};
use super::check;
use super::diagnostics::one_line;
use super::export::{self, Request, export};
use super::failure::{Failure, PipelineError};
use super::farm::farm;
use super::forecast::forecast;
use super::gallery::gallery;
use super::leftovers::clear_leftovers;
use super::new::new;
use super::pipeline::{self, Making, Summary};
use super::process::{Answers, Session, Signals, make_pool, supervised};
use super::progress::{Kept, Log, LogFormat};
use super::report::{report, write_report};
use super::results::{Inspection, step_limit_line, verdict, write_curves};
use super::set_up::{folder_of, read_scene};
use super::sweep::{self, report_of_sweep, sweep};
use crate::film::{self, FilmFolder, Plan};
use crate::scene::Scene;

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return ExitCode::from(say_usage(&error)),
    };
    let log = Log::new(arguments.log, arguments.quiet);
    let session = Arc::new(Session::new(log, Signals::new(arguments.command.writes())));
    let restarts = arguments.command.restarts();
    let at_work = session.clone();
    let outcome = supervised(&session, move || execute(&arguments, &at_work));
    // What fails after a signal fails because of it.
    let outcome = outcome.map_err(|failure| match session.signals.received() {
        Some(signal) => Failure::Interrupted { signal },
        None => failure,
    });
    session.let_all_go();
    session.log.finish();
    let code = outcome.map_or_else(|failure| say_failure(&failure, &session.log, restarts), |()| 0);
    session.log.end(code);
    ExitCode::from(code)
}

/// Help goes to standard output with code 0, mistakes to standard error with code 2, whether or not anybody reads them.
fn say_usage(error: &clap::Error) -> u8 {
    match error.print() {
        _ if error.use_stderr() => 2,
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let failure = Failure::Output(error);
            Log::new(LogFormat::Text, true).error(&failure);
            failure.code()
        }
        _ => 0,
    }
}

/// Says why a command failed; returns the exit code.
fn say_failure(failure: &Failure, log: &Log, restarts: bool) -> u8 {
    match failure {
        Failure::Pipeline(PipelineError::Scene(errors)) => log.mistakes(errors),
        Failure::Interrupted { .. } => log.note(what_is_kept(log.kept(), restarts)),
        Failure::NotWell => {}
        other => log.error(other),
    }
    failure.code()
}

/// What an interrupted command leaves, and how to go on.
fn what_is_kept(kept: Kept, restarts: bool) -> String {
    let counted = |[done, of]: [usize; 2], what: &str| format!("{done} of {of} {what}");
    let counts: Vec<String> = [(kept.frames, "frames"), (kept.pictures, "pictures")]
        .into_iter()
        .filter_map(|(count, what)| Some(counted(count?, what)))
        .collect();
    let kept = if counts.is_empty() { "what is complete is".to_owned() } else { counts.join(" and ") + " are" };
    let again = if restarts { "the same command without --restart goes on" } else { "the same command goes on" };
    format!("interrupted: {kept} kept; {again}")
}

/// Does what is asked for, in as many threads.
fn execute(arguments: &Arguments, session: &Session) -> Result<(), Failure> {
    make_pool(arguments.threads)?.into_iter().for_each(|warning| session.log.warning(warning));
    let mut out = Answers::new();
    let outcome = obey(&arguments.command, session, &mut out);
    let written = out.end().map_err(Failure::from);
    if let (Err(_), Err(failure)) = (&outcome, &written) {
        session.log.error(failure);
    }
    outcome.and(written)
}

fn obey(command: &Command, session: &Session, out: &mut Answers) -> Result<(), Failure> {
    match command {
        Command::Run { film, restart, preview, pictures } => {
            run(film, Making { restart: *restart, preview: *preview }, pictures, session, out)
        }
        Command::Simulate { film, restart, preview } => {
            let (scene, folder) = open(film)?;
            session.hold(&folder)?;
            let summary =
                pipeline::simulate(&scene, &folder, Making { restart: *restart, preview: *preview }, session)?;
            session.log.finish();
            clear_leftovers(&folder, None, false, &session.log)?;
            certify_as_asked(&scene, &folder, session)?;
            let inspection = Inspection::of(&folder).map_err(PipelineError::from)?;
            write_curves_of_film(&folder, &inspection)?;
            writeln!(out, "{}", sentence("frames computed", summary, &folder))?;
            out.flush()?;
            say_verdict(&inspection, &scene, &session.log);
            Ok(())
        }
        Command::Render { film, restart, share, pictures } => render(film, *restart, *share, pictures, session, out),
        Command::Gallery { scenes, out: folder, work, restart, settings } => {
            gallery(scenes, folder, work, *restart, &settings.set, session, out)
        }
        Command::Sweep { scene, mesh, set, out: folder, restart } => {
            let (mesh, folder) = (mesh.as_deref(), folder.as_deref());
            sweep(&sweep::Request { scene, mesh, set, out: folder, restart: *restart }, session, out)
        }
        Command::Farm { film: Film { scene, out: folder }, engine, frames } => {
            let (mesh, folder) = (scene.mesh.as_deref(), folder.as_deref());
            let what =
                sweep::Request { scene: &scene.path, mesh, set: &scene.settings.set, out: folder, restart: false };
            farm(&what, *engine, frames.as_ref(), session, out)
        }
        Command::Check { scene: file, phases: true, .. } => Ok(write!(out, "{}", check::phases(&read(file)?)?)?),
        Command::Check { scene: file, phases: false, no_trial } => {
            let scene = read(file)?;
            let notes = check::check(&scene, &session.log)?;
            let of_trial = if *no_trial { Vec::new() } else { forecast(&scene)? };
            for note in notes.into_iter().chain(of_trial) {
                writeln!(out, "{note}")?;
            }
            Ok(writeln!(out, "{}: nothing is wrong", shown(&file.path))?)
        }
        Command::Inspect { folder, json, curves } => inspect(folder, *json, *curves, session, out),
        Command::Certify { folder, json, points } => {
            certify(folder, Asked { json: *json, points: *points }, session, out)
        }
        Command::Export { folder, format, frames, to, restart } => {
            let request = Request { folder, formats: format, to: to.as_deref(), restart: *restart };
            export(&request, frames.as_ref(), session, out)
        }
        Command::Report { folder, restart } => match report_of_sweep(folder, session, out) {
            Some(reported) => reported,
            None => report(folder, *restart, session, out),
        },
        Command::New { kind, name } => new(kind, name.as_deref(), out),
        Command::Schema { markdown: true } => Ok(write!(out, "{}", Scene::reference())?),
        Command::Schema { markdown: false } => Ok(writeln!(out, "{:#}", Scene::schema())?),
        Command::Completions { shell } => {
            clap_complete::generate(*shell, &mut Arguments::command(), "immerse", out);
            Ok(())
        }
        Command::Man => Ok(clap_mangen::Man::new(Arguments::command()).render(out)?),
    }
}

/// The scene that is named.
fn read(file: &SceneFile) -> Result<Scene, Failure> {
    Ok(read_scene(&file.path, file.mesh.as_deref(), &file.settings.set)?)
}

/// The scene and the folder of its film.
fn open(film: &Film) -> Result<(Scene, PathBuf), Failure> {
    let scene = read(&film.scene)?;
    let folder = match &film.out {
        Some(folder) => folder.clone(),
        None => folder_of(&scene, &film.scene.path, Path::new("renders"))?,
    };
    Ok((scene, folder))
}

fn run(
    film: &Film,
    making: Making,
    pictures: &PictureOptions,
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let (mut scene, folder) = open(film)?;
    let frames = pictures.apply(&mut scene)?;
    session.hold(&folder)?;
    let [simulated, rendered] = pipeline::run(&scene, &folder, making, &frames, session)?;
    let restart = making.restart;
    session.log.finish();
    clear_leftovers(&folder, Some(&scene.output), scene.output.report, &session.log)?;
    certify_as_asked(&scene, &folder, session)?;
    let inspection = Inspection::of(&folder).map_err(PipelineError::from)?;
    let reported = match scene.output.report {
        true => Some(write_report(&folder, &inspection, restart, session)?),
        false => None,
    };
    write_curves_of_film(&folder, &inspection)?;
    writeln!(out, "{}", sentence("frames computed", simulated, &folder))?;
    writeln!(out, "{}", sentence("pictures made", rendered, &folder))?;
    reported.map_or(Ok(()), |reported| writeln!(out, "{}", reported))?;
    export_as_asked(&scene, &folder, restart, session, out)?;
    inspection.write_summary(out)?;
    if !inspection.checks.is_empty() {
        writeln!(out)?;
        inspection.write_checks(out)?;
    }
    out.flush()?;
    say_verdict(&inspection, &scene, &session.log);
    all_is_well(&inspection, &session.log)
}

fn render(
    film: &Film,
    restart: bool,
    share: bool,
    pictures: &PictureOptions,
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let (mut scene, folder) = open(film)?;
    let frames = pictures.apply(&mut scene)?;
    // Nothing is begun for a picture that cannot be made, or where there is no film.
    Plan::of(&scene).map_err(PipelineError::from)?;
    FilmFolder::open(&folder).map_err(PipelineError::from)?;
    let summary = if share {
        session.share(&folder)?;
        pipeline::render_beside_others(&scene, &folder, &frames, session)?
    } else {
        session.hold(&folder)?;
        if restart {
            film::forget_pictures(&folder).map_err(PipelineError::from)?;
        }
        pipeline::render_frames(&scene, &folder, &frames, session)?
    };
    session.log.finish();
    if !share {
        clear_leftovers(&folder, Some(&scene.output), false, &session.log)?;
    }
    Ok(writeln!(out, "{}", sentence("pictures made", summary, &folder))?)
}

/// Writes the whole film in the formats that the scene names.
fn export_as_asked(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    session: &Session,
    out: &mut impl Write,
) -> Result<(), Failure> {
    let formats = &scene.output.export;
    let frames: Vec<usize> = (1..=scene.clock.frames).collect();
    export::write(&Request { folder, formats, to: None, restart }, &frames, session, out)
}

/// Says on standard error which frames ran into the limit of steps and what the result is not, on a line each.
fn say_verdict(inspection: &Inspection, scene: &Scene, log: &Log) {
    let lines = [step_limit_line(&inspection.frames), verdict(&inspection.frames, &scene.checks)];
    lines.iter().flatten().for_each(|line| log.warning(line));
}

/// One frame has no curves.
fn write_curves_of_film(folder: &Path, inspection: &Inspection) -> Result<(), PipelineError> {
    if inspection.frames.len() > 1 { Ok(write_curves(folder, &inspection.frames)?) } else { Ok(()) }
}

fn inspect(folder: &Path, json: bool, curves: bool, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    let inspection = Inspection::of(folder).map_err(PipelineError::from)?;
    if curves {
        session.hold(folder)?;
        write_curves(folder, &inspection.frames).map_err(PipelineError::from)?;
    }
    if json {
        inspection.write_json(out)?;
    } else {
        inspection.write_tables(out)?;
    }
    inspection.damaged.iter().for_each(|error| session.log.error(error));
    if inspection.damaged.is_empty() { Ok(()) } else { Err(Failure::NotWell) }
}

/// Says on standard error which checks do not hold and which frames do not verify.
fn all_is_well(inspection: &Inspection, log: &Log) -> Result<(), Failure> {
    let broken: Vec<&str> = inspection.checks.iter().filter(|check| !check.holds).map(|check| check.name).collect();
    if !broken.is_empty() {
        log.error(format_args!("the film does not hold to its [checks]: {}", broken.join(", ")));
    }
    for check in inspection.checks.iter().filter(|check| !check.holds) {
        check.reason.iter().for_each(|reason| log.error(format_args!("{}: {reason}", check.name)));
    }
    inspection.damaged.iter().for_each(|error| log.error(error));
    if broken.is_empty() && inspection.damaged.is_empty() { Ok(()) } else { Err(Failure::NotWell) }
}

fn sentence(what: &str, summary: Summary, folder: &Path) -> String {
    let Summary { made, kept } = summary;
    let kept = if kept > 0 { format!(", {kept} were there") } else { String::new() };
    format!("{}: {made} {what}{kept}", shown(folder))
}

/// A path in a line of results.
fn shown(path: &Path) -> String {
    one_line(&path.to_string_lossy()).into_owned()
}
