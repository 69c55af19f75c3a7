//! Inner products that do not depend on the number of threads.

use rayon::prelude::*;

/// Length of the pieces whose sums are added in order.
const PIECE: usize = 4096;

/// `Σ product(a_k, b_k)`, summed in fixed pieces.
pub fn inner_product<T: Copy + Sync>(a: &[T], b: &[T], product: impl Fn(T, T) -> f64 + Sync) -> f64 {
    let pieces: Vec<f64> = a
        .par_chunks(PIECE)
        .zip(b.par_chunks(PIECE))
        .map(|(a, b)| a.iter().zip(b).map(|(a, b)| product(*a, *b)).sum::<f64>())
        .collect();
    pieces.iter().sum()
}
