//! Work in parallel whose results are taken in order.

use std::ops::Range;

use rayon::prelude::*;

/// Makes `count` things, some at a time in parallel, and hands them on in order while the next ones are made. Of things
/// that are made and not yet taken there are at most twice as many as are made at a time.
///
/// `prepare` is told which things are next, and gives what `make` needs for them.
///
/// # Errors
/// The first error in order; what comes after it is not taken.
pub(in crate::film::pictures) fn in_order<P: Sync, T: Send, E: Send>(
    count: usize,
    at_a_time: usize,
    mut prepare: impl FnMut(Range<usize>) -> Result<P, E>,
    make: impl Fn(&P, usize) -> Result<T, E> + Sync,
    mut take: impl FnMut(T) -> Result<(), E> + Send,
) -> Result<(), E> {
    let mut made: Vec<Result<T, E>> = Vec::new();
    for start in (0..count).step_by(at_a_time.max(1)) {
        let wave = start..(start + at_a_time.max(1)).min(count);
        let prepared = prepare(wave.clone())?;
        let before = std::mem::take(&mut made);
        let (taken, next) = rayon::join(
            || before.into_iter().try_for_each(|thing| take(thing?)),
            || wave.into_par_iter().map(|index| make(&prepared, index)).collect::<Vec<_>>(),
        );
        taken?;
        made = next;
    }
    made.into_iter().try_for_each(|thing| take(thing?))
}
