//! How many runs there is room for at a time.

use std::fs;

use crate::cli::forecast::memory_of_run;
use crate::scene::Scene;

/// How many runs of a surface with so many faces at a time, and with how many threads each. A run on one thread is the most
/// economical; results do not depend on it.
pub(super) fn room_for(runs: usize, processors: usize, scene: &Scene, faces: usize) -> [usize; 2] {
    let most = available_memory().map_or(usize::MAX, |bytes| bytes / memory_of_run(scene, faces));
    let at_once = processors.min(runs).min(most).max(1);
    [at_once, (processors / at_once).max(1)]
}

/// Bytes that Linux says programs can have without others being swapped out.
fn available_memory() -> Option<usize> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?.checked_mul(1024)
}
