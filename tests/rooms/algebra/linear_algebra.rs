//! Block matrices, their preconditioner and both solvers against dense linear algebra.

use crate::support::Random;
use glam::{DMat4, DVec3, DVec4, Mat4};
use immerse::algebra::{
    Block, BlockMatrix, BlockPattern, BlockVector, ConjugateGradient, IncompleteCholesky, PairBlocks, SolveReport,
    SparseCholesky,
};
use nalgebra::{DMatrix, DVector};

fn random_block(random: &mut Random) -> DMat4 {
    DMat4::from_cols_array(&std::array::from_fn(|_| 2.0 * random.unit() - 1.0))
}

fn random_vectors(n: usize, random: &mut Random) -> Vec<DVec4> {
    (0..n).map(|_| DVec4::from_array(std::array::from_fn(|_| 2.0 * random.unit() - 1.0))).collect()
}

/// A symmetric matrix on a graph: a diagonal block per row, an off-diagonal block per pair.
struct Blocks {
    pairs: Vec<(usize, usize)>,
    diagonal: Vec<DMat4>,
    across: Vec<DMat4>,
}

impl Blocks {
    /// A positive definite one.
    fn random(rows: usize, pairs: &[(usize, usize)], random: &mut Random) -> Blocks {
        let across = pairs.iter().map(|_| random_block(random)).collect();
        // Three blocks of norm below 4 on either side of a diagonal above 12.
        let diagonal = (0..rows)
            .map(|_| {
                let b = random_block(random);
                b * b.transpose() + DMat4::from_diagonal(DVec4::splat(12.5))
            })
            .collect();
        Blocks { pairs: pairs.to_vec(), diagonal, across }
    }

    /// M + Δt L for springs of weight 1, along a random axis stiff and else soft.
    fn springs(rows: usize, pairs: &[(usize, usize)], dt: f64, random: &mut Random) -> Blocks {
        let mut diagonal = vec![DMat4::IDENTITY; rows];
        let across = pairs.iter().map(|&(a, b)| {
            let axis = random_vectors(1, random)[0].normalize();
            let spring = (DMat4::from_cols(axis * axis.x, axis * axis.y, axis * axis.z, axis * axis.w)
                + DMat4::from_diagonal(DVec4::splat(0.1)))
                * dt;
            diagonal[a] += spring;
            diagonal[b] += spring;
            spring * -1.0
        });
        let across = across.collect();
        Blocks { pairs: pairs.to_vec(), diagonal, across }
    }

    fn pattern(&self) -> BlockPattern {
        BlockPattern::new(self.diagonal.len(), self.pairs.iter().copied())
    }

    fn assembled<B: Block>(&self, pattern: &BlockPattern) -> BlockMatrix<B> {
        let mut matrix = BlockMatrix::default();
        let pair = |&k: &usize| {
            (PairBlocks { first: B::ZERO, second: B::ZERO, across: B::round(self.across[k]) }, [DVec4::ZERO; 2])
        };
        let row = |k: usize| (B::round(self.diagonal[k]), DVec4::ZERO);
        matrix.assemble(pattern, &mut BlockVector::default(), row, |k| k, pair);
        matrix
    }

    fn dense(&self) -> DMatrix<f64> {
        let n = 4 * self.diagonal.len();
        let mut all = DMatrix::zeros(n, n);
        let mut put = |row: usize, column: usize, block: &DMat4| {
            for r in 0..4 {
                for c in 0..4 {
                    all[(4 * row + r, 4 * column + c)] = block.col(c)[r];
                }
            }
        };
        self.diagonal.iter().enumerate().for_each(|(k, block)| put(k, k, block));
        for (&(row, column), block) in self.pairs.iter().zip(&self.across) {
            put(row, column, block);
            put(column, row, &block.transpose());
        }
        all
    }

    fn times(&self, x: &[DVec4]) -> Vec<DVec4> {
        let mut product: Vec<DVec4> = self.diagonal.iter().zip(x).map(|(block, x)| *block * *x).collect();
        for (&(a, b), block) in self.pairs.iter().zip(&self.across) {
            product[a] += *block * x[b];
            product[b] += block.transpose() * x[a];
        }
        product
    }

    /// Factorizes and solves from scratch, in the precision of B.
    fn solve<B: Block>(&self, b: &[DVec4], tolerance: f64, max_iterations: usize) -> (Vec<DVec4>, SolveReport) {
        let pattern = self.pattern();
        let matrix = self.assembled::<B>(&pattern);
        let mut factor = IncompleteCholesky::default();
        factor.factorize(&pattern, &matrix);
        let (mut right, mut x) = (BlockVector::default(), BlockVector::default());
        right.set(&pattern, |row| b[row]);
        let mut solver = ConjugateGradient::default();
        let report = solver.solve(&pattern, &matrix, &factor, &right, &mut x, tolerance, max_iterations);
        ((0..b.len()).map(|row| x.at(&pattern, row)).collect(), report)
    }

    fn residual(&self, b: &[DVec4], x: &[DVec4]) -> f64 {
        let squared = |v: &[DVec4]| v.iter().map(|v| v.length_squared()).sum::<f64>();
        let rest: Vec<DVec4> = b.iter().zip(self.times(x)).map(|(b, q)| *b - q).collect();
        (squared(&rest) / squared(b)).sqrt()
    }
}

fn flat(x: &[DVec4]) -> DVector<f64> {
    DVector::from_iterator(4 * x.len(), x.iter().flat_map(|v| v.to_array()))
}

/// The edges of a cube's graph, so every row has three neighbours, on either side of the diagonal.
const CUBE: [(usize, usize); 12] =
    [(0, 1), (2, 1), (2, 3), (0, 3), (4, 5), (6, 5), (6, 7), (4, 7), (0, 4), (5, 1), (2, 6), (7, 3)];

/// A tree, a path beside it and a row alone.
const FOREST: [(usize, usize); 9] = [(0, 2), (3, 1), (2, 5), (5, 3), (4, 6), (6, 7), (5, 7), (8, 9), (10, 9)];

/// The faces of a torus of squares cut in two, named in no particular order.
fn honeycomb(columns: usize, rows: usize, random: &mut Random) -> Vec<(usize, usize)> {
    let names = random.shuffled(2 * columns * rows);
    let face = |c: usize, r: usize, k: usize| names[2 * ((r % rows) * columns + c % columns) + k];
    let cell = |c: usize, r: usize| {
        [(face(c, r, 0), face(c, r, 1)), (face(c, r, 1), face(c + 1, r, 0)), (face(c, r, 1), face(c, r + 1, 0))]
    };
    (0..rows).flat_map(|r| (0..columns).flat_map(move |c| cell(c, r))).collect()
}

#[test]
fn residual_is_that_of_the_dense_product() {
    let mut random = Random::new(1);
    // The larger one has strips, and seams between them.
    for pairs in [CUBE.to_vec(), honeycomb(100, 60, &mut random)] {
        let rows = 2 * pairs.len() / 3;
        let blocks = Blocks::random(rows, &pairs, &mut random);
        let pattern = blocks.pattern();
        let (b, x) = (random_vectors(rows, &mut random), random_vectors(rows, &mut random));
        let [mut right, mut at, mut rest] = [(); 3].map(|_| BlockVector::default());
        right.set(&pattern, |row| b[row]);
        at.set(&pattern, |row| x[row]);
        let product = if rows == 8 {
            let product = blocks.dense() * flat(&x);
            product.as_slice().chunks(4).map(DVec4::from_slice).collect()
        } else {
            blocks.times(&x)
        };
        for (precision, allowed) in [(64, 1e-13), (32, 1e-4)] {
            if precision == 64 {
                blocks.assembled::<DMat4>(&pattern).residual(&pattern, &right, &at, &mut rest);
            } else {
                blocks.assembled::<Mat4>(&pattern).residual(&pattern, &right, &at, &mut rest);
            }
            for row in 0..rows {
                let error = (rest.at(&pattern, row) - (b[row] - product[row])).abs().max_element();
                assert!(error < allowed, "row {row} of {rows} in {precision} bits is off by {error}");
            }
        }
    }
}

/// A pair is assembled where it belongs, whichever of its rows comes first, and also across a seam.
#[test]
fn pairs_add_to_both_rows() {
    let mut random = Random::new(2);
    for pairs in [CUBE.to_vec(), honeycomb(100, 60, &mut random)] {
        let rows = 2 * pairs.len() / 3;
        let pattern = BlockPattern::new(rows, pairs.iter().copied());
        let (mut matrix, mut gathered) = (BlockMatrix::<DMat4>::default(), BlockVector::default());
        let springs: Vec<(DVec4, DVec4)> =
            pairs.iter().map(|_| (random_vectors(1, &mut random)[0], random_vectors(1, &mut random)[0])).collect();
        let outer = <DMat4 as Block>::outer;
        let pair = |&k: &usize| {
            let (a, b) = springs[k];
            (PairBlocks { first: outer(a, a), second: outer(b, b), across: outer(a, -b) }, [a, -b])
        };
        matrix.assemble(&pattern, &mut gathered, |_| (DMat4::IDENTITY, DVec4::X), |k| k, pair);
        let x = random_vectors(rows, &mut random);
        let [mut zero, mut at, mut rest] = [(); 3].map(|_| BlockVector::default());
        zero.set(&pattern, |_| DVec4::ZERO);
        at.set(&pattern, |row| x[row]);
        matrix.residual(&pattern, &zero, &at, &mut rest);
        let (mut product, mut pulls) = (x.clone(), vec![DVec4::X; rows]);
        for (&(i, j), &(a, b)) in pairs.iter().zip(&springs) {
            let stretch = a.dot(x[i]) - b.dot(x[j]);
            product[i] += a * stretch;
            product[j] -= b * stretch;
            pulls[i] += a;
            pulls[j] -= b;
        }
        for row in 0..rows {
            assert!((rest.at(&pattern, row) + product[row]).abs().max_element() < 1e-13, "row {row} of {rows}");
            assert!((gathered.at(&pattern, row) - pulls[row]).abs().max_element() < 1e-13, "row {row} of {rows}");
        }
    }
}

#[test]
fn incomplete_factorization_of_a_forest_is_complete() {
    let mut random = Random::new(2);
    let blocks = Blocks::random(12, &FOREST, &mut random);
    let b = random_vectors(12, &mut random);
    let (x, report) = blocks.solve::<DMat4>(&b, 1e-12, 100);
    assert_eq!((report.iterations, report.replaced_pivots, report.converged), (1, 0, true));
    assert!((blocks.dense() * flat(&x) - flat(&b)).amax() < 1e-12);

    // The cube's graph has cycles, which need fill.
    let blocks = Blocks::random(8, &CUBE, &mut random);
    let (_, report) = blocks.solve::<DMat4>(&b[..8], 1e-12, 100);
    assert!(report.iterations > 4 && report.converged, "{report:?}");
}

/// Kershaw's matrix is positive definite, but a pivot of its incomplete factorization is not.
#[test]
fn pivots_that_are_not_positive_are_replaced() {
    let across = [-2.0, -2.0, -2.0, 2.0].map(|entry| DMat4::IDENTITY * entry).to_vec();
    let pairs = vec![(0, 1), (1, 2), (2, 3), (3, 0)];
    let blocks = Blocks { pairs, diagonal: vec![DMat4::IDENTITY * 3.0; 4], across };
    let b = random_vectors(4, &mut Random::new(7));
    for (x, report) in [blocks.solve::<DMat4>(&b, 1e-12, 100), blocks.solve::<Mat4>(&b, 1e-5, 100)] {
        assert_eq!(report.replaced_pivots, 1);
        assert!(report.converged && blocks.residual(&b, &x) < 2e-5, "{report:?}");
    }
}

#[test]
fn conjugate_gradients_solve_what_a_dense_factorization_solves() {
    let mut random = Random::new(3);
    let blocks = Blocks::random(8, &CUBE, &mut random);
    let b = random_vectors(8, &mut random);
    let expected = blocks.dense().cholesky().expect("positive definite").solve(&flat(&b));
    let (x, report) = blocks.solve::<DMat4>(&b, 1e-13, 100);
    assert!(report.converged && report.residual < 1e-12 && report.iterations <= 33, "{report:?}");
    assert!((flat(&x) - &expected).amax() < 1e-12);

    // With too few iterations it says so; from nothing there is nothing to do.
    let (_, report) = blocks.solve::<DMat4>(&b, 1e-10, 2);
    assert!(!report.converged && report.iterations == 2 && report.residual > 1e-10, "{report:?}");
    let (x, report) = blocks.solve::<DMat4>(&[DVec4::ZERO; 8], 1e-10, 100);
    assert!(report.converged && report.iterations == 0 && report.residual == 0.0 && x == [DVec4::ZERO; 8]);
}

/// Single precision begins again with what is left, and gets further than it could in one go.
#[test]
fn single_precision_reaches_what_its_matrix_allows() {
    let mut random = Random::new(4);
    let pairs = honeycomb(100, 60, &mut random);
    let blocks = Blocks::springs(12_000, &pairs, 10.0, &mut random);
    let b = random_vectors(12_000, &mut random);
    for tolerance in [1e-2, 1e-3, 1e-6] {
        let (x, report) = blocks.solve::<Mat4>(&b, tolerance, 500);
        let residual = blocks.residual(&b, &x);
        assert!(report.converged && report.residual <= tolerance, "{tolerance}: {report:?}");
        assert!((residual / report.residual - 1.0).abs() < 0.3 + 1e-7 / tolerance, "{residual} is not {report:?}");
    }
    // Below the rounding of its entries it says that it does not get there.
    let (x, report) = blocks.solve::<Mat4>(&b, 1e-12, 500);
    assert!(report.residual > 1e-12 && report.residual < 1e-6 && report.iterations < 500, "{report:?}");
    assert!(blocks.residual(&b, &x) < 1e-5);
}

#[test]
fn conjugate_gradients_on_a_long_cycle() {
    let n = 10_000;
    let mut random = Random::new(4);
    let pairs: Vec<(usize, usize)> = (0..n).map(|k| (k, (k + 1) % n)).collect();
    let blocks = Blocks::random(n, &pairs, &mut random);
    let expected = random_vectors(n, &mut random);
    let (x, report) = blocks.solve::<DMat4>(&blocks.times(&expected), 1e-13, 100);
    assert!(report.converged, "{report:?}");
    assert!((flat(&x) - flat(&expected)).amax() < 1e-11);
}

/// Strips are cut by the size of the graph, never by the number of threads.
#[test]
fn solutions_do_not_depend_on_the_number_of_threads() {
    let mut random = Random::new(5);
    let pairs = honeycomb(160, 125, &mut random);
    let blocks = Blocks::springs(40_000, &pairs, 100.0, &mut random);
    let b = random_vectors(40_000, &mut random);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let (x, report) = pool.install(|| blocks.solve::<Mat4>(&b, 1e-3, 500));
        (x.iter().map(|v| v.to_array().map(f64::to_bits)).collect::<Vec<_>>(), report)
    };
    let one = on(1);
    assert!(one.1.converged && on(2) == one && on(4) == one);
}

/// Textbook conjugate gradients with an incomplete factorization in the order of the names: iterations that it takes.
fn textbook_iterations(blocks: &Blocks, b: &[DVec4], tolerance: f64) -> usize {
    let n = b.len();
    let mut earlier = vec![Vec::new(); n];
    for (&(i, j), block) in blocks.pairs.iter().zip(&blocks.across) {
        let block = if i > j { *block } else { block.transpose() };
        earlier[i.max(j)].push((i.min(j), block));
    }
    let mut inverse: Vec<DMat4> = Vec::new();
    for (diagonal, earlier) in blocks.diagonal.iter().zip(&earlier) {
        let taken = earlier.iter().map(|&(k, block)| block * inverse[k] * block.transpose());
        inverse.push(taken.fold(*diagonal, |pivot, taken| pivot - taken).inverse());
    }
    let precondition = |r: &[DVec4]| {
        let mut z = r.to_vec();
        for row in 0..n {
            let rest = earlier[row].iter().fold(z[row], |rest, &(k, block)| rest - block * z[k]);
            z[row] = inverse[row] * rest;
        }
        let mut rest = vec![DVec4::ZERO; n];
        for row in (0..n).rev() {
            z[row] -= inverse[row] * rest[row];
            earlier[row].iter().for_each(|&(k, block)| rest[k] += block.transpose() * z[row]);
        }
        z
    };
    let dot = |a: &[DVec4], b: &[DVec4]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
    let (mut r, mut p, mut rz) = (b.to_vec(), vec![DVec4::ZERO; n], f64::INFINITY);
    let goal = tolerance * tolerance * dot(b, b);
    let mut iterations = 0;
    while dot(&r, &r) > goal {
        let z = precondition(&r);
        let next = dot(&r, &z);
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = *z + *p * (next / rz));
        rz = next;
        let q = blocks.times(&p);
        let alpha = rz / dot(&p, &q);
        r.iter_mut().zip(&q).for_each(|(r, q)| *r -= *q * alpha);
        iterations += 1;
    }
    iterations
}

/// Neither strips nor single precision nor the wait for a recomputed residual cost more than an iteration or two.
#[test]
fn strips_cost_no_iterations() {
    let mut random = Random::new(6);
    let pairs = honeycomb(160, 125, &mut random);
    for (dt, tolerance) in [(10.0, 1e-2), (10.0, 1e-3), (100.0, 1e-3)] {
        let blocks = Blocks::springs(40_000, &pairs, dt, &mut random);
        let b = random_vectors(40_000, &mut random);
        let (_, report) = blocks.solve::<Mat4>(&b, tolerance, 500);
        let textbook = textbook_iterations(&blocks, &b, tolerance);
        eprintln!("dt {dt}, tolerance {tolerance}: {} iterations, textbook {textbook}", report.iterations);
        assert!(report.converged && report.iterations <= textbook + 1, "{report:?}, textbook {textbook}");
    }
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
