//! Work that is watched: a panic in it is a failure, and a signal ends it though it may not listen.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use super::panics;
use super::session::Session;
use crate::cli::failure::Failure;

/// How often one looks for signals and says how far the work is.
const GLANCE: Duration = Duration::from_millis(20);
/// After a signal the work may finish what it is at for so long.
const GRACE: Duration = Duration::from_millis(1500);
/// Within this time a second signal is the first one sent twice.
const TWICE: Duration = Duration::from_millis(30);
/// As on the main thread of a program.
const STACK: usize = 8 << 20;

/// Does the work on a thread of its own, so that it can be left when a signal comes and it does not end by itself. Where
/// the system gives no thread it is done on this one.
///
/// # Errors
/// That of the work, [`Failure::Panic`], [`Failure::Interrupted`].
pub(in crate::cli) fn supervised(
    session: &Arc<Session>,
    work: impl FnOnce() -> Result<(), Failure> + Send + 'static,
) -> Result<(), Failure> {
    panics::keep_quiet();
    let caught = |work: Box<dyn FnOnce() -> Result<(), Failure>>| {
        catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err(Failure::Panic { reason: panics::first() }))
    };
    // It goes to the thread only when there is one.
    let (give, take) = mpsc::sync_channel::<Box<dyn FnOnce() -> Result<(), Failure> + Send>>(1);
    let (tell, told) = mpsc::sync_channel(1);
    let thread = thread::Builder::new().name("work".to_owned()).stack_size(STACK).spawn(move || {
        if let Ok(work) = take.recv() {
            let _ = tell.send(caught(work));
        }
    });
    if thread.is_err() {
        return caught(Box::new(work));
    }
    let _ = give.send(Box::new(work));
    let mut asked_to_end = None;
    loop {
        match told.recv_timeout(GLANCE) {
            Ok(outcome) => return outcome,
            Err(RecvTimeoutError::Disconnected) => return Err(Failure::Panic { reason: panics::first() }),
            Err(RecvTimeoutError::Timeout) => session.log.tick(),
        }
        if let Some(signal) = session.signals.received() {
            let since = *asked_to_end.get_or_insert_with(Instant::now);
            if since.elapsed() > TWICE {
                session.signals.be_impatient();
            }
            if since.elapsed() > GRACE {
                return Err(Failure::Interrupted { signal });
            }
        }
    }
}
