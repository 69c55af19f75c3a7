//! Which elements hang together.

/// The number that stands for all that were joined with `k`. `parents` holds for each number the one that it was joined
/// to, or itself.
pub(crate) fn root(parents: &mut [u32], mut k: u32) -> u32 {
    while parents[k as usize] != k {
        parents[k as usize] = parents[parents[k as usize] as usize];
        k = parents[k as usize];
    }
    k
}
