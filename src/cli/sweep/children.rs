//! The runs of a sweep as programs of their own, several at a time.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::combinations::Run;
use super::request::Request;
use crate::cli::failure::Failure;
use crate::cli::process::Session;

/// How often one looks who is done.
const GLANCE: Duration = Duration::from_millis(20);
/// After a signal, which those who sit at a terminal have got as well, they may end by themselves for so long.
const GRACE: Duration = Duration::from_millis(1000);

/// What all runs have in common.
pub(super) struct Work<'a> {
    pub request: &'a Request<'a>,
    /// Of the sweep.
    pub folder: &'a Path,
    /// How many at a time, and with how many threads each.
    pub at_once: usize,
    pub threads: usize,
}

/// A run that has ended.
pub(super) struct Ended {
    /// Its number among all, from 0.
    pub index: usize,
    /// `None` if it was killed.
    pub code: Option<i32>,
    pub seconds: f64,
}

/// A run that goes on.
struct Running {
    index: usize,
    child: Child,
    since: Instant,
}

impl Work<'_> {
    /// Runs them all, and tells of each as it ends. A run that fails does not end the others.
    pub fn run(
        &self,
        runs: &[Run],
        session: &Session,
        mut tell: impl FnMut(&Ended) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut waiting = runs.iter().enumerate();
        let mut running: Vec<Running> = Vec::new();
        loop {
            while running.len() < self.at_once.max(1)
                && let Some((index, run)) = waiting.next()
            {
                match self.begin(run) {
                    Ok(child) => running.push(Running { index, child, since: Instant::now() }),
                    Err(source) => {
                        end(&mut running);
                        return Err(Failure::Folder { path: self.folder.to_owned(), source });
                    }
                }
            }
            if running.is_empty() {
                return Ok(());
            }
            thread::sleep(GLANCE);
            let outcome = session.go_on().and_then(|()| gather(&mut running, &mut tell));
            if outcome.is_err() {
                end(&mut running);
                return outcome;
            }
        }
    }

    /// What the run says goes into a file beside the folder of its film.
    fn begin(&self, run: &Run) -> io::Result<Child> {
        fs::create_dir_all(self.folder)?;
        let log = File::create(log_of(self.folder, run))?;
        let mut command = Command::new(std::env::current_exe()?);
        command.arg("run").args(self.request.scene_of(&run.settings)).arg("--out").arg(self.folder.join(&run.name));
        command.arg("--quiet").arg("--threads").arg(self.threads.to_string());
        if self.request.restart {
            command.arg("--restart");
        }
        command.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log).spawn()
    }
}

/// Where a run says what it has to say.
pub(super) fn log_of(folder: &Path, run: &Run) -> PathBuf {
    folder.join(format!("{}.log", run.name))
}

/// Tells of those that have ended.
fn gather(running: &mut Vec<Running>, tell: &mut impl FnMut(&Ended) -> Result<(), Failure>) -> Result<(), Failure> {
    let mut going_on = Vec::new();
    let mut outcome = Ok(());
    for mut run in running.drain(..) {
        match run.child.try_wait() {
            Ok(None) => going_on.push(run),
            ended => {
                let code = ended.ok().flatten().and_then(|status| status.code());
                let ended = Ended { index: run.index, code, seconds: run.since.elapsed().as_secs_f64() };
                outcome = outcome.and_then(|()| tell(&ended));
            }
        }
    }
    *running = going_on;
    outcome
}

/// Ends those that do not end by themselves. What they have finished stays.
fn end(running: &mut [Running]) {
    let since = Instant::now();
    for run in running {
        while matches!(run.child.try_wait(), Ok(None)) {
            if since.elapsed() > GRACE {
                let _ = run.child.kill();
                let _ = run.child.wait();
            } else {
                thread::sleep(GLANCE);
            }
        }
    }
}
