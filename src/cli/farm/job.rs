//! What a film or a sweep takes, as steps of one task or many.

use std::path::{Path, PathBuf};

use super::chunks::{chunks, frames_per_task, in_words};
use super::words::{line_of, program, text_of};
use crate::cli::arguments::FrameRange;
use crate::cli::check::check;
use crate::cli::failure::{Failure, PipelineError};
use crate::cli::progress::Log;
use crate::cli::set_up::folder_of;
use crate::cli::sweep;
use crate::film::Plan;
use crate::scene::Scene;

/// What is to be done, step by step.
pub(super) struct Job {
    /// Of the scene.
    pub name: String,
    /// Of the film, or of the sweep.
    pub folder: PathBuf,
    /// This program.
    pub program: String,
    /// The frames that become pictures, as they are typed, and how many of them a task has. A sweep has none of its own.
    pub frames: Option<(String, usize)>,
    pub steps: Vec<Step>,
}

/// A part of the work that waits for the one before it.
pub(super) struct Step {
    /// Names files and jobs.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub what: &'static str,
    /// The arguments of the program.
    pub words: Vec<String>,
    pub tasks: Tasks,
}

/// What is done at the same time.
pub(super) enum Tasks {
    One,
    /// Arguments that each has beside those of the step: frames.
    Frames(Vec<Vec<String>>),
    /// The same: settings and a folder. Whether its checks hold is told by the step after it.
    Runs(Vec<Vec<String>>),
}

impl Job {
    /// Checks all that is asked for.
    pub fn of(what: &sweep::Request, frames: Option<&FrameRange>, log: &Log) -> Result<Job, Failure> {
        let (runs, scenes) = what.runs()?;
        let Some(first) = scenes.first() else { return Err(Failure::Sweep(0)) };
        if !what.is_sweep() {
            check(first, log)?;
            let folder = match what.out {
                Some(folder) => folder.to_owned(),
                None => folder_of(first, what.scene, Path::new("renders"))?,
            };
            let settings = runs.first().map_or(&[][..], |run| &run.settings);
            return film(first, &folder, &scene_of(what, settings)?, frames);
        }
        if frames.is_some() {
            return Err(Failure::Farm("--frames: a sweep makes pictures of all frames; leave it out".to_owned()));
        }
        scenes.iter().try_for_each(|scene| Plan::of(scene).map(drop)).map_err(PipelineError::from)?;
        let folder = what.folder(first)?;
        let mut tasks = Vec::new();
        for run in &runs {
            let mut words = vec!["run".to_owned()];
            words.extend(scene_of(what, &run.settings)?);
            words.extend(out(&folder.join(&run.name))?);
            tasks.push(words);
        }
        let assemble = [vec!["sweep".to_owned()], scene_of(what, what.set)?, out(&folder)?].concat();
        let steps = vec![
            Step::of("runs", "Makes the films of the sweep, one a task.", Vec::new(), Tasks::Runs(tasks)),
            Step::of(
                "assemble",
                "Puts the table and the picture of the sweep together; makes what is not there.",
                assemble,
                Tasks::One,
            ),
        ];
        Ok(Job { name: first.name.clone(), folder, program: program()?, frames: None, steps })
    }

    /// What it is, for people.
    pub fn in_words(&self) -> String {
        let tasks: Vec<String> =
            self.steps.iter().map(|step| format!("{} {}", step.tasks.count(), step.name)).collect();
        format!("tasks: {}", tasks.join(", "))
    }
}

/// The steps of a film.
fn film(scene: &Scene, folder: &Path, scene_words: &[String], frames: Option<&FrameRange>) -> Result<Job, Failure> {
    let count = scene.clock.frames;
    let chosen = frames.map_or_else(|| Ok((1..=count).collect()), |range| range.frames(count))?;
    let of_frames = |words: &str| vec!["--frames".to_owned(), words.to_owned()];
    let command = |name: &str| Ok::<_, Failure>([vec![name.to_owned()], scene_words.to_vec(), out(folder)?].concat());
    let all = in_words(&chosen);
    let mut steps =
        vec![Step::of("simulate", "Computes the frames, one after the other.", command("simulate")?, Tasks::One)];
    // A film that only has moving pictures is made in one piece.
    if scene.output.png || scene.output.exr {
        let tasks = chunks(&chosen).iter().map(|chunk| of_frames(chunk)).collect();
        let words = [command("render")?, vec!["--share".to_owned()]].concat();
        steps.push(Step::of(
            "pictures",
            "Makes pictures of some frames, several tasks at a time.",
            words,
            Tasks::Frames(tasks),
        ));
    }
    let words = [command("run")?, if frames.is_some() { of_frames(&all) } else { Vec::new() }].concat();
    let what = "Verifies what is there, makes what is not, puts moving pictures, page and exports together, and looks whether the checks hold.";
    steps.push(Step::of("assemble", what, words, Tasks::One));
    let frames = Some((all, frames_per_task(chosen.len())));
    Ok(Job { name: scene.name.clone(), folder: folder.to_owned(), program: program()?, frames, steps })
}

impl Step {
    fn of(name: &'static str, what: &'static str, words: Vec<String>, tasks: Tasks) -> Step {
        Step { name, what, words, tasks }
    }
}

impl Tasks {
    pub fn count(&self) -> usize {
        match self {
            Tasks::One => 1,
            Tasks::Frames(tasks) | Tasks::Runs(tasks) => tasks.len(),
        }
    }
}

/// The scene with its settings and its mesh, as arguments that mean the same everywhere.
fn scene_of(what: &sweep::Request, settings: &[String]) -> Result<Vec<String>, Failure> {
    let mut words = vec![text_of(what.scene)?];
    for setting in settings {
        words.extend(["--set".to_owned(), line_of(setting)?]);
    }
    if let Some(mesh) = what.mesh {
        words.extend(["--mesh".to_owned(), text_of(mesh)?]);
    }
    Ok(words)
}

fn out(folder: &Path) -> Result<Vec<String>, Failure> {
    Ok(vec!["--out".to_owned(), text_of(folder)?])
}
