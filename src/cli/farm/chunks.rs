//! Frames cut into pieces, one for each task.

/// About so many frames a task: each passes once over the film, which has to be worth it.
const FRAMES: usize = 10;
/// Slurm takes arrays of 1001 tasks where nobody has said otherwise.
const MOST_TASKS: usize = 1000;

/// How many frames a task has at most.
pub(super) fn frames_per_task(count: usize) -> usize {
    count.div_ceil(count.div_ceil(FRAMES).clamp(1, MOST_TASKS)).max(1)
}

/// The pieces of some frames, as evenly as can be, in words.
pub(super) fn chunks(frames: &[usize]) -> Vec<String> {
    let tasks = frames.len().div_ceil(frames_per_task(frames.len()));
    let start = |task: usize| task * frames.len() / tasks;
    (0..tasks).map(|task| in_words(&frames[start(task)..start(task + 1)])).collect()
}

/// Frames in order as they are typed: `1-20,30-40:2`.
pub(super) fn in_words(frames: &[usize]) -> String {
    let mut parts = Vec::new();
    let mut rest = frames;
    while let [first, more @ ..] = rest {
        let step = more.first().map_or(1, |next| next - first);
        let as_far = more.iter().zip(1..).take_while(|&(&frame, k)| frame == first + k * step).count();
        // Two frames that are apart are no span.
        let length = if as_far == 1 && step > 1 { 0 } else { as_far };
        parts.push(match (length, step) {
            (0, _) => first.to_string(),
            (_, 1) => format!("{first}-{}", first + length),
            _ => format!("{first}-{}:{step}", first + length * step),
        });
        rest = &more[length..];
    }
    parts.join(",")
}

#[cfg(test)]
mod tests;
