//! What the memory gives: a = b + s c, as in the STREAM benchmark.

use std::{hint::black_box, time::Instant};

use rayon::prelude::*;
use serde_json::{Value, json};

/// 128 MiB an array, far more than caches hold.
const LENGTH: usize = 1 << 24;
const PIECE: usize = 1 << 16;
const REPEATS: usize = 9;

/// The best of several passes on all threads, 24 bytes a number (what is read to be overwritten is not counted).
pub fn run() -> Value {
    let mut a = vec![0.0; LENGTH];
    let b = vec![1.0; LENGTH];
    let c = vec![2.0; LENGTH];
    let mut best = f64::INFINITY;
    for pass in 0..REPEATS {
        let scale = black_box(pass as f64);
        let begin = Instant::now();
        a.par_chunks_mut(PIECE).zip(b.par_chunks(PIECE)).zip(c.par_chunks(PIECE)).for_each(|((a, b), c)| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + scale * c;
            }
        });
        best = best.min(begin.elapsed().as_secs_f64());
        black_box(&a);
    }
    json!({ "bytes_per_second": (3 * size_of::<f64>() * LENGTH) as f64 / best })
}
