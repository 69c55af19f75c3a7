//! Work in parallel whose results are taken in order.

use std::ops::Range;

use rayon::prelude::*;

/// Makes `count` things, some at a time in parallel, and hands them on in order while the next ones are made. Of things
/// that are made and not yet taken there are at most twice as many as are made at a time.
///
/// `prepare` is told which things are next, and gives what `make` needs for them.
///
/// # Errors
/// The first error in order. What has been made nevertheless is still handed on, and nothing else is made.
pub(in crate::film) fn in_order<P: Sync, T: Send, E: Send>(
    count: usize,
    at_a_time: usize,
    mut prepare: impl FnMut(Range<usize>) -> Result<P, E>,
    make: impl Fn(&P, usize) -> Result<T, E> + Sync,
    mut take: impl FnMut(T) -> Result<(), E> + Send,
) -> Result<(), E> {
    let mut made: Vec<Result<T, E>> = Vec::new();
    for start in (0..count).step_by(at_a_time.max(1)) {
        let wave = start..(start + at_a_time.max(1)).min(count);
        let prepared = match prepare(wave.clone()) {
            Ok(prepared) => prepared,
            Err(error) => return take_all(made, &mut take).and(Err(error)),
        };
        let before = std::mem::take(&mut made);
        let (taken, next) = rayon::join(
            || take_all(before, &mut take),
            || wave.into_par_iter().map(|index| make(&prepared, index)).collect::<Vec<_>>(),
        );
        made = next;
        if taken.is_err() {
            return taken.and(take_all(made, &mut take));
        }
    }
    take_all(made, &mut take)
}

/// Hands on what there is, and gives the first error.
fn take_all<T, E>(made: Vec<Result<T, E>>, take: &mut impl FnMut(T) -> Result<(), E>) -> Result<(), E> {
    let mut outcome = Ok(());
    for thing in made {
        let taken = thing.and_then(&mut *take);
        outcome = outcome.and(taken);
    }
    outcome
}
