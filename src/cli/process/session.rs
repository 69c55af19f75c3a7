//! What a command has at hand while it works.

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::signals::Signals;
use crate::cli::failure::{Failure, PipelineError};
use crate::cli::progress::Log;
use crate::film::{DiskError, FolderLock};

/// Messages, signals, and the folders that nobody else writes into meanwhile.
#[derive(Debug)]
pub(in crate::cli) struct Session {
    pub log: Log,
    pub signals: Signals,
    locks: Mutex<Vec<FolderLock>>,
}

/// How a lock is taken.
type TryTake = fn(&Path, &str) -> Result<FolderLock, DiskError>;

/// How long one waits for a folder. Two runs in one folder are mostly a mistake, but one of them may be about to end.
const PATIENCE: Duration = Duration::from_secs(5);
const BETWEEN_TRIES: Duration = Duration::from_millis(50);

impl Session {
    pub fn new(log: Log, signals: Signals) -> Session {
        Session { log, signals, locks: Mutex::default() }
    }

    /// Keeps others out of a folder until the end of the program, or until it is let go.
    ///
    /// # Errors
    /// [`DiskError::Busy`] if somebody else is still there after a while, [`Failure::Interrupted`], other errors of
    /// [`FolderLock::try_take`].
    pub fn hold(&self, folder: &Path) -> Result<(), Failure> {
        self.wait_for(folder, FolderLock::try_take)
    }

    /// Keeps others out of a folder but those who share it, too.
    ///
    /// # Errors
    /// As [`Session::hold`].
    pub fn share(&self, folder: &Path) -> Result<(), Failure> {
        self.wait_for(folder, FolderLock::try_share)
    }

    fn wait_for(&self, folder: &Path, take: TryTake) -> Result<(), Failure> {
        let began = Instant::now();
        let mut has_said_so = false;
        loop {
            match take(folder, &command_line()) {
                Err(DiskError::Busy { holder, .. }) if began.elapsed() < PATIENCE => {
                    if !has_said_so {
                        let (folder, seconds) = (folder.display(), PATIENCE.as_secs());
                        self.log.note(format_args!("{folder}: waiting up to {seconds} s for {holder}"));
                        has_said_so = true;
                    }
                    thread::sleep(BETWEEN_TRIES);
                    self.go_on()?;
                }
                Err(error) => return Err(PipelineError::from(error).into()),
                Ok(lock) => {
                    if !lock.keeps_others_out() {
                        self.log.warning(format_args!(
                            "{}: this file system has no locks; see to it that nobody else writes there",
                            folder.display()
                        ));
                    }
                    self.locks().push(lock);
                    return Ok(());
                }
            }
        }
    }

    /// Lets others into a folder again.
    pub fn let_go(&self, folder: &Path) {
        self.locks().retain(|lock| lock.folder() != folder);
    }

    /// Lets others into all folders again. What was not finished in them goes.
    pub fn let_all_go(&self) {
        self.locks().clear();
    }

    /// An error as soon as a signal asks the program to end.
    ///
    /// # Errors
    /// [`Failure::Interrupted`]
    pub fn go_on(&self) -> Result<(), Failure> {
        match self.signals.received() {
            Some(signal) => Err(Failure::Interrupted { signal }),
            None => Ok(()),
        }
    }

    fn locks(&self) -> MutexGuard<'_, Vec<FolderLock>> {
        self.locks.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What was typed, for people.
fn command_line() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("immerse".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
