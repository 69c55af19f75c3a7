//! As many threads as the system gives.

use std::io;
use std::num::{NonZeroU16, NonZeroUsize};
use std::sync::mpsc;
use std::thread;

use rayon::{ThreadBuilder, ThreadPoolBuildError, ThreadPoolBuilder};

/// Where Slurm says how many processors a task has.
const OF_SLURM: &str = "SLURM_CPUS_PER_TASK";

/// Makes the pool that all work is done in, with this number of threads, or as many as Slurm gives processors to the task, or one
/// for every processor. If the system does not give that many, what it gives must do: results do not depend on it. Returns the
/// warnings that this deserves.
///
/// Where there is not a single one, the calling thread is the pool.
///
/// # Errors
/// If there is a pool already.
pub(in crate::cli) fn make_pool(wanted: Option<NonZeroUsize>) -> Result<Vec<String>, ThreadPoolBuildError> {
    let mut warnings = Vec::new();
    let of_slurm = if wanted.is_none() { processors_of_task(&mut warnings) } else { None };
    let wanted = wanted.or(of_slurm).or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    // Threads come first: a pool that cannot have all of its own leaves the program without any.
    let mut waiting = Vec::new();
    let mut refused = None;
    while waiting.len() < wanted && refused.is_none() {
        match waiting_thread(waiting.len()) {
            Ok(thread) => waiting.push(thread),
            Err(error) => refused = Some(error),
        }
    }
    let count = waiting.len();
    let pool = ThreadPoolBuilder::new().num_threads(count.max(1));
    if count == 0 {
        pool.use_current_thread().spawn_handler(|_| Ok(())).build_global()?;
    } else {
        let mut waiting = waiting.into_iter();
        let begin = |work| {
            let thread = waiting.next().ok_or_else(|| io::Error::other("there are no more threads"))?;
            thread.send(work).map_err(|_| io::Error::other("a thread has ended"))
        };
        pool.spawn_handler(begin).build_global()?;
    }
    warnings.extend(refused.map(|error| {
        let given = if count < 2 { "one".to_owned() } else { count.to_string() };
        format!("the system does not give {wanted} threads ({error}); going on with {given}")
    }));
    Ok(warnings)
}

/// What Slurm says, if it does. A number that no machine has is none.
fn processors_of_task(warnings: &mut Vec<String>) -> Option<NonZeroUsize> {
    let text = std::env::var_os(OF_SLURM)?;
    let number = text.to_str().and_then(|text| text.parse::<NonZeroU16>().ok());
    if number.is_none() {
        let text = text.to_string_lossy();
        warnings.push(format!("{OF_SLURM} is {text:?}, which is no number of processors; all of them are used"));
    }
    number.map(NonZeroUsize::from)
}

/// A thread that waits for what it is to do.
fn waiting_thread(number: usize) -> io::Result<mpsc::SyncSender<ThreadBuilder>> {
    let (give, take) = mpsc::sync_channel::<ThreadBuilder>(1);
    thread::Builder::new().name(format!("pool {number}")).spawn(move || {
        if let Ok(work) = take.recv() {
            work.run();
        }
    })?;
    Ok(give)
}
