//! What each command does, and with which exit code it ends.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use super::arguments::{Arguments, Command, Film, SceneFile};
use super::check;
use super::diagnostics::{say, say_scene_errors};
use super::failure::{Failure, PipelineError};
use super::gallery::gallery;
use super::picture_options::PictureOptions;
use super::pipeline::{self, Summary};
use super::progress::Bar;
use super::results::{Inspection, step_limit_line, verdict, write_curves};
use super::set_up::count_classes;
use crate::film::DiskError;
use crate::film::{self, Leftovers};
use crate::scene::{MeshSection, OutputSection, Scene};

/// The scene that `new` writes.
const STARTER: &str = include_str!("starter.toml");

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help goes to standard output with code 0, mistakes to standard error with code 2.
            return match error.print() {
                Ok(()) => ExitCode::from(if error.use_stderr() { 2 } else { 0 }),
                Err(error) => report(Err(error.into())),
            };
        }
    };
    report(in_threads(&arguments))
}

fn report(outcome: Result<(), Failure>) -> ExitCode {
    let Err(failure) = outcome else { return ExitCode::SUCCESS };
    match &failure {
        // The reader has seen enough, as in `immerse schema | head`.
        Failure::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
        Failure::Pipeline(PipelineError::Scene(errors)) => say_scene_errors(errors),
        Failure::NotWell => {}
        other => say(format_args!("error: {other}")),
    }
    match failure {
        Failure::Pipeline(error) if !error.is_fault_of_input() => ExitCode::from(1),
        Failure::Output(_) | Failure::NotWell => ExitCode::from(1),
        Failure::Pipeline(_)
        | Failure::Frames(_)
        | Failure::New { .. }
        | Failure::Folder { .. }
        | Failure::Threads(_) => ExitCode::from(2),
    }
}

/// Gives the program as many threads as it is asked to take.
fn in_threads(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global()?;
    }
    execute(arguments)
}

fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let mut progress = Bar::new(arguments.quiet);
    match &arguments.command {
        Command::Run { film, pictures } => run(film, pictures, &mut progress, &mut out),
        Command::Simulate { film, restart } => {
            let (scene, folder) = open(film)?;
            let summary = pipeline::simulate(&scene, &folder, *restart, &mut progress)?;
            progress.clear();
            clear_leftovers(&folder, None)?;
            let inspection = Inspection::of(&folder)?;
            write_curves_of_film(&folder, &inspection)?;
            writeln!(out, "{}", sentence("frames computed", summary, &folder))?;
            out.flush()?;
            say_verdict(&inspection, &scene);
            Ok(())
        }
        Command::Render { film, pictures } => {
            let (mut scene, folder) = open(film)?;
            let frames = pictures.apply(&mut scene)?;
            let summary = pipeline::render_frames(&scene, &folder, &frames, &mut progress)?;
            progress.clear();
            clear_leftovers(&folder, Some(&scene.output))?;
            Ok(writeln!(out, "{}", sentence("pictures made", summary, &folder))?)
        }
        Command::Gallery { scenes, out: folder, work } => gallery(scenes, folder, work, &mut progress, &mut out),
        Command::Check { scene: file, phases: true } => Ok(write!(out, "{}", check::phases(&read(file)?)?)?),
        Command::Check { scene: file, phases: false } => {
            let scene = read(file)?;
            for note in check::check(&scene)? {
                writeln!(out, "{note}")?;
            }
            Ok(writeln!(out, "{}: nothing is wrong", file.path.display())?)
        }
        Command::Inspect { folder, json, curves } => inspect(folder, *json, *curves, &mut out),
        Command::New { name } => new(name, &mut out),
        Command::Schema => Ok(writeln!(out, "{:#}", Scene::schema())?),
        Command::Completions { shell } => {
            // Through memory, because the generator panics if it cannot write.
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "immerse", &mut script);
            Ok(out.write_all(&script)?)
        }
        Command::Man => Ok(clap_mangen::Man::new(Arguments::command()).render(&mut out)?),
    }?;
    Ok(io::stdout().flush()?)
}

/// The scene, with the mesh of the command line if there is one.
fn read(file: &SceneFile) -> Result<Scene, Failure> {
    let mut scene = Scene::read(&file.path).map_err(PipelineError::from)?;
    if let Some(mesh) = &file.mesh {
        // Paths of a scene start in its folder, those of a command line where it is typed.
        scene.mesh = MeshSection::File(std::path::absolute(mesh).unwrap_or_else(|_| mesh.clone()));
    }
    count_classes(&mut scene)?;
    Ok(scene)
}

/// The scene and the folder of its film.
fn open(film: &Film) -> Result<(Scene, PathBuf), Failure> {
    let scene = read(&film.scene)?;
    let folder = film.out.clone().unwrap_or_else(|| Path::new("renders").join(&scene.name));
    Ok((scene, folder))
}

fn run(film: &Film, pictures: &PictureOptions, progress: &mut Bar, out: &mut impl Write) -> Result<(), Failure> {
    let (mut scene, folder) = open(film)?;
    let frames = pictures.apply(&mut scene)?;
    let mut picturing = progress.below();
    let [simulated, rendered] = pipeline::run(&scene, &folder, &frames, progress, &mut picturing)?;
    picturing.clear();
    progress.clear();
    clear_leftovers(&folder, Some(&scene.output))?;
    let inspection = Inspection::of(&folder)?;
    write_curves_of_film(&folder, &inspection)?;
    writeln!(out, "{}", sentence("frames computed", simulated, &folder))?;
    writeln!(out, "{}", sentence("pictures made", rendered, &folder))?;
    inspection.write_summary(out)?;
    if !inspection.checks.is_empty() {
        writeln!(out)?;
        inspection.write_checks(out)?;
    }
    out.flush()?;
    say_verdict(&inspection, &scene);
    all_is_well(&inspection)
}

/// Removes pictures of another film and says which, and names those of formats that were not made now, on a line each.
fn clear_leftovers(folder: &Path, output: Option<&OutputSection>) -> Result<(), PipelineError> {
    let Leftovers { removed, older } = film::clear_leftovers(folder, output).map_err(PipelineError::from)?;
    let named = |names: &[String]| match names.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names[..NAMED].join(", ")),
    };
    if !removed.is_empty() {
        let (count, names) = (removed.len(), named(&removed));
        say(format_args!("{}: removed what is not of this film ({count} files): {names}", folder.display()));
    }
    if !older.is_empty() {
        let (count, names) = (older.len(), named(&older));
        say(format_args!("{}: left from an earlier run, not made anew ({count} files): {names}", folder.display()));
    }
    Ok(())
}

/// Files that are listed by name.
const NAMED: usize = 8;

/// Says on standard error which frames ran into the limit of steps and what the result is not, on a line each.
fn say_verdict(inspection: &Inspection, scene: &Scene) {
    let lines = [step_limit_line(&inspection.frames), verdict(&inspection.frames, &scene.checks)];
    lines.iter().flatten().for_each(|line| say(format_args!("warning: {line}")));
}

/// One frame has no curves.
fn write_curves_of_film(folder: &Path, inspection: &Inspection) -> Result<(), DiskError> {
    if inspection.frames.len() > 1 { write_curves(folder, &inspection.frames) } else { Ok(()) }
}

fn inspect(folder: &Path, json: bool, curves: bool, out: &mut impl Write) -> Result<(), Failure> {
    let inspection = Inspection::of(folder)?;
    if curves {
        write_curves(folder, &inspection.frames)?;
    }
    if json {
        inspection.write_json(out)?;
    } else {
        inspection.write_tables(out)?;
    }
    for error in &inspection.damaged {
        say(format_args!("error: {error}"));
    }
    if inspection.damaged.is_empty() { Ok(()) } else { Err(Failure::NotWell) }
}

/// Says on standard error which checks do not hold and which frames do not verify.
fn all_is_well(inspection: &Inspection) -> Result<(), Failure> {
    let broken: Vec<&str> = inspection.checks.iter().filter(|check| !check.holds).map(|check| check.name).collect();
    if !broken.is_empty() {
        say(format_args!("error: the film does not hold to its [checks]: {}", broken.join(", ")));
    }
    for check in inspection.checks.iter().filter(|check| !check.holds) {
        check.reason.iter().for_each(|reason| say(format_args!("error: {}: {reason}", check.name)));
    }
    for error in &inspection.damaged {
        say(format_args!("error: {error}"));
    }
    if broken.is_empty() && inspection.damaged.is_empty() { Ok(()) } else { Err(Failure::NotWell) }
}

fn sentence(what: &str, summary: Summary, folder: &Path) -> String {
    let Summary { made, kept } = summary;
    let kept = if kept > 0 { format!(", {kept} were there") } else { String::new() };
    format!("{}: {made} {what}{kept}", folder.display())
}

fn new(name: &str, out: &mut impl Write) -> Result<(), Failure> {
    let path = PathBuf::from(if name.ends_with(".toml") { name.to_owned() } else { format!("{name}.toml") });
    let failed = |source| Failure::New { path: path.clone(), source };
    let mut file = OpenOptions::new().write(true).create_new(true).open(&path).map_err(failed)?;
    file.write_all(STARTER.as_bytes()).map_err(failed)?;
    Ok(writeln!(out, "{} is written; now: immerse run {}", path.display(), path.display())?)
}
