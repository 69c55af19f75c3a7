//! Factorizations that are done side by side: branches of the elimination tree, and strips of its trunk.

use crate::support::Random;
use glam::{DMat3, DVec3};
use immerse::algebra::{BlockCholesky, Complex, SparseCholesky};

/// A strip of a plane of `columns` by `rows` squares, rolled up, with one diagonal in each.
fn tube(columns: usize, rows: usize) -> Vec<(usize, usize)> {
    let at = |c: usize, r: usize| r * columns + c % columns;
    let squares = (0..rows - 1).flat_map(|r| (0..columns).map(move |c| (c, r)));
    let of_squares =
        squares.flat_map(|(c, r)| [(at(c + 1, r), at(c, r)), (at(c, r + 1), at(c, r)), (at(c + 1, r + 1), at(c, r))]);
    let last = (0..columns).map(|c| (at(c + 1, rows - 1), at(c, rows - 1)));
    of_squares.chain(last).collect()
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

#[test]
fn blocks_are_solved_to_the_same_bits_on_any_number_of_threads() {
    let (rows, pairs) = (60 * 60, tube(60, 60));
    let mut random = Random::new(3);
    let across: Vec<DMat3> =
        pairs.iter().map(|_| DMat3::from_cols(random.vector(), random.vector(), random.vector())).collect();
    let mut diagonal = vec![DMat3::from_diagonal(DVec3::splat(0.1)); rows];
    // u uᵀ with u = (B, 1) adds Bᵀ to the pair, B Bᵀ and 1 to its rows.
    for (&(a, b), block) in pairs.iter().zip(&across) {
        diagonal[a] += *block * block.transpose();
        diagonal[b] += DMat3::IDENTITY;
    }
    let right: Vec<DVec3> = (0..rows).map(|_| random.vector()).collect();
    let solved = |threads| {
        on_threads(threads, || {
            let mut factor = BlockCholesky::new(rows, &pairs).expect("an order");
            let mut x = right.clone();
            factor.factorize(&diagonal, &across).expect("positive definite");
            factor.solve(&mut x);
            x
        })
    };
    let x = solved(1);
    let mut rest = right.clone();
    (0..rows).for_each(|row| rest[row] -= diagonal[row] * x[row]);
    for (&(a, b), block) in pairs.iter().zip(&across) {
        rest[a] -= *block * x[b];
        rest[b] -= block.transpose() * x[a];
    }
    let largest = |v: &[DVec3]| v.iter().map(|v| v.length()).fold(0.0, f64::max);
    assert!(largest(&rest) < 1e-11 * largest(&x), "{} of {}", largest(&rest), largest(&x));
    for threads in [2, 4] {
        assert!(solved(threads) == x, "{threads} threads");
    }
    // One row in the middle of a branch, one in the trunk, wherever that is.
    for row in [17, rows / 2, rows - 1] {
        let mut wrong = diagonal.clone();
        wrong[row] = DMat3::IDENTITY * -1.0;
        let mut factor = BlockCholesky::new(rows, &pairs).expect("an order");
        assert!(factor.factorize(&wrong, &across).is_err(), "{row}");
        assert!(factor.factorize(&diagonal, &across).is_ok(), "{row}");
    }
}

#[test]
fn complex_matrices_are_solved_side_by_side_too() {
    let (rows, pairs) = (120 * 110, tube(120, 110));
    let mut random = Random::new(4);
    let mut lower: Vec<(usize, usize, Complex)> =
        (0..rows).map(|row| (row, row, Complex { re: 6.1, im: 0.0 })).collect();
    for &(a, b) in &pairs {
        let v = random.vector();
        let unit = v.x.hypot(v.y);
        let value = Complex { re: v.x / unit, im: v.y / unit };
        lower.push((a.max(b), a.min(b), value));
    }
    let right: Vec<glam::DQuat> = (0..rows)
        .map(|_| {
            let v = random.vector();
            glam::DQuat::from_xyzw(v.x, v.y, v.z, 1.0)
        })
        .collect();
    let solved = |threads| {
        on_threads(threads, || {
            let factor = SparseCholesky::new(rows, &lower).expect("positive definite");
            let mut x = right.clone();
            factor.solve(&mut x);
            x
        })
    };
    let x = solved(1);
    assert!(solved(3) == x);
    // a + b j, on which complex numbers act from the left.
    let times = |c: Complex, q: glam::DQuat| {
        glam::DQuat::from_xyzw(
            c.re * q.x + c.im * q.w,
            c.re * q.y - c.im * q.z,
            c.re * q.z + c.im * q.y,
            c.re * q.w - c.im * q.x,
        )
    };
    let mut rest = right.clone();
    for &(a, b, value) in &lower {
        rest[a] -= times(value, x[b]);
        if a != b {
            rest[b] -= times(Complex { im: -value.im, ..value }, x[a]);
        }
    }
    assert!(rest.iter().all(|q| q.length() < 1e-10), "{:?}", rest.iter().map(|q| q.length()).fold(0.0, f64::max));
}
