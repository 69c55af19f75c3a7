//! How many runs there is room for at a time.

use std::fs;

use crate::scene::Scene;

/// Bytes that a simulation takes for each face, about; a million faces take 2.7 GiB.
const OF_FACE: usize = 3 << 10;
/// Bytes that pictures in the making take for each pixel, about.
const OF_PIXEL: usize = 250;
/// Bytes of the program itself.
const OF_PROGRAM: usize = 64 << 20;

/// How many runs of a surface with so many faces at a time, and with how many threads each. A run on one thread is the most
/// economical; results do not depend on it.
pub(super) fn room_for(runs: usize, processors: usize, scene: &Scene, faces: usize) -> [usize; 2] {
    let [width, height] = scene.output.size;
    let each = OF_PROGRAM + OF_FACE.saturating_mul(faces) + OF_PIXEL.saturating_mul(width.saturating_mul(height));
    let most = available_memory().map_or(usize::MAX, |bytes| bytes / each);
    let at_once = processors.min(runs).min(most).max(1);
    [at_once, (processors / at_once).max(1)]
}

/// Bytes that Linux says programs can have without others being swapped out.
fn available_memory() -> Option<usize> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?.checked_mul(1024)
}
