//! Block matrices, their preconditioner and both solvers against dense linear algebra.

mod support;

use glam::{DMat4, DVec3, DVec4};
use immerse::algebra::{BlockMatrix, BlockPattern, ConjugateGradient, IncompleteCholesky, SparseCholesky};
use nalgebra::{DMatrix, DVector};
use support::Random;

fn random_block(random: &mut Random) -> DMat4 {
    DMat4::from_cols_array(&std::array::from_fn(|_| 2.0 * random.unit() - 1.0))
}

fn random_vectors(n: usize, random: &mut Random) -> Vec<DVec4> {
    (0..n).map(|_| DVec4::from_array(std::array::from_fn(|_| 2.0 * random.unit() - 1.0))).collect()
}

/// A symmetric positive definite matrix on a graph.
fn random_matrix(rows: usize, pairs: &[(usize, usize)], random: &mut Random) -> BlockMatrix {
    let off_diagonal = pairs.iter().map(|_| random_block(random)).collect();
    // Three blocks of norm below 4 on either side of a diagonal above 12.
    let diagonal = (0..rows)
        .map(|_| {
            let b = random_block(random);
            b * b.transpose() + DMat4::from_diagonal(DVec4::splat(12.5))
        })
        .collect();
    BlockMatrix { diagonal, off_diagonal }
}

fn dense(matrix: &BlockMatrix, pairs: &[(usize, usize)]) -> DMatrix<f64> {
    let n = 4 * matrix.diagonal.len();
    let mut all = DMatrix::zeros(n, n);
    let mut put = |row: usize, column: usize, block: &DMat4| {
        for r in 0..4 {
            for c in 0..4 {
                all[(4 * row + r, 4 * column + c)] = block.col(c)[r];
            }
        }
    };
    matrix.diagonal.iter().enumerate().for_each(|(k, block)| put(k, k, block));
    for (&(row, column), block) in pairs.iter().zip(&matrix.off_diagonal) {
        put(row, column, block);
        put(column, row, &block.transpose());
    }
    all
}

fn flat(x: &[DVec4]) -> DVector<f64> {
    DVector::from_iterator(4 * x.len(), x.iter().flat_map(|v| v.to_array()))
}

/// The edges of a cube's graph, so every row has three neighbours, on either side of the diagonal.
const CUBE: [(usize, usize); 12] =
    [(0, 1), (2, 1), (2, 3), (0, 3), (4, 5), (6, 5), (6, 7), (4, 7), (0, 4), (5, 1), (2, 6), (7, 3)];

/// A tree whose parents come after their children, as elimination without fill wants it.
const TREE: [(usize, usize); 7] = [(0, 2), (3, 1), (2, 5), (5, 3), (4, 6), (6, 7), (5, 7)];

#[test]
fn product_is_the_dense_one() {
    let mut random = Random::new(1);
    let matrix = random_matrix(8, &CUBE, &mut random);
    let pattern = BlockPattern::new(8, CUBE.into_iter());
    let x = random_vectors(8, &mut random);
    let mut product = vec![DVec4::ONE; 8];
    matrix.multiply(&pattern, &x, &mut product);
    assert!((flat(&product) - dense(&matrix, &CUBE) * flat(&x)).amax() < 1e-13);
}

#[test]
fn incomplete_factorization_of_a_tree_is_complete() {
    let mut random = Random::new(2);
    let matrix = random_matrix(8, &TREE, &mut random);
    let pattern = BlockPattern::new(8, TREE.into_iter());
    let mut factor = IncompleteCholesky::default();
    factor.factorize(&pattern, &matrix);
    assert_eq!(factor.replaced_pivots, 0);
    let b = random_vectors(8, &mut random);
    let mut x = random_vectors(8, &mut random);
    factor.solve(&pattern, &matrix, &b, &mut x);
    assert!((dense(&matrix, &TREE) * flat(&x) - flat(&b)).amax() < 1e-12);

    // The cube's graph has cycles, which need fill.
    let matrix = random_matrix(8, &CUBE, &mut random);
    let pattern = BlockPattern::new(8, CUBE.into_iter());
    factor.factorize(&pattern, &matrix);
    factor.solve(&pattern, &matrix, &b, &mut x);
    assert!((dense(&matrix, &CUBE) * flat(&x) - flat(&b)).amax() > 1e-6);
}

#[test]
fn pivots_that_are_not_positive_are_replaced() {
    let pattern = BlockPattern::new(2, [(0, 1)].into_iter());
    let matrix = BlockMatrix { diagonal: vec![DMat4::IDENTITY; 2], off_diagonal: vec![DMat4::IDENTITY * 2.0] };
    let mut factor = IncompleteCholesky::default();
    factor.factorize(&pattern, &matrix);
    assert_eq!(factor.replaced_pivots, 1);
}

#[test]
fn conjugate_gradients_solve_what_a_dense_factorization_solves() {
    let mut random = Random::new(3);
    let matrix = random_matrix(8, &CUBE, &mut random);
    let pattern = BlockPattern::new(8, CUBE.into_iter());
    let b = random_vectors(8, &mut random);
    let expected = dense(&matrix, &CUBE).cholesky().expect("positive definite").solve(&flat(&b));
    let mut solver = ConjugateGradient::default();
    let mut x = random_vectors(8, &mut random);
    let report = solver.solve(&pattern, &matrix, &b, &mut x, 1e-13, 100);
    assert!(report.converged && report.residual < 1e-12 && report.iterations <= 33, "{report:?}");
    assert!((flat(&x) - &expected).amax() < 1e-12);

    // From the solution there is nothing to do; with too few iterations it says so.
    let report = solver.solve(&pattern, &matrix, &b, &mut x, 1e-2, 100);
    assert!(report.converged && report.iterations <= 2, "{report:?}");
    let report = solver.solve(&pattern, &matrix, &b, &mut random_vectors(8, &mut random), 1e-10, 2);
    assert!(!report.converged && report.iterations == 2 && report.residual > 1e-10, "{report:?}");
}

/// More rows than one piece of a sum has.
#[test]
fn conjugate_gradients_on_a_long_cycle() {
    let n = 10_000;
    let mut random = Random::new(4);
    let pairs: Vec<(usize, usize)> = (0..n).map(|k| (k, (k + 1) % n)).collect();
    let matrix = random_matrix(n, &pairs, &mut random);
    let pattern = BlockPattern::new(n, pairs.iter().copied());
    let expected = random_vectors(n, &mut random);
    let mut b = vec![DVec4::ZERO; n];
    matrix.multiply(&pattern, &expected, &mut b);
    let mut x = vec![DVec4::ZERO; n];
    let report = ConjugateGradient::default().solve(&pattern, &matrix, &b, &mut x, 1e-13, 100);
    assert!(report.converged, "{report:?}");
    assert!((flat(&x) - flat(&expected)).amax() < 1e-11);
}

#[test]
fn sparse_factorization_solves_what_a_dense_one_solves() {
    let (n, mut random) = (40, Random::new(5));
    let mut lower = Vec::new();
    let mut all = DMatrix::zeros(n, n);
    for row in 0..n {
        for column in 0..row {
            if random.below(5) == 0 {
                let value = random.unit() - 0.5;
                // In two parts, which are summed.
                lower.extend([(row, column, 0.25 * value), (row, column, 0.75 * value)]);
                all[(row, column)] = value;
                all[(column, row)] = value;
            }
        }
        lower.push((row, row, 12.0));
        all[(row, row)] = 12.0;
    }
    let factor = SparseCholesky::new(n, &lower).expect("positive definite");
    let b: Vec<DVec3> = (0..n).map(|_| random.vector()).collect();
    let mut x = b.clone();
    factor.solve(&mut x);
    let solver = all.cholesky().expect("positive definite");
    for axis in 0..3 {
        let expected = solver.solve(&DVector::from_iterator(n, b.iter().map(|v| v[axis])));
        assert!((0..n).all(|k| (x[k][axis] - expected[k]).abs() < 1e-13));
    }
}

#[test]
fn indefinite_matrices_are_refused() {
    let error = SparseCholesky::new(2, &[(0, 0, 1.0), (1, 1, 1.0), (1, 0, 2.0)]).expect_err("indefinite");
    assert!(error.to_string().contains("2 unknowns cannot be factorized"), "{error}");
    assert!(SparseCholesky::new(1, &[(0, 0, 0.0)]).is_err());
}
