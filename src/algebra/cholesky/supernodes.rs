//! Which columns of a sparse Cholesky factor are eliminated together, and which rows they fill. No number of the matrix
//! enters here, so neither does the processor: the order is faer's approximate minimum degree, the columns are faer's
//! relaxed supernodes.

use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, SymbolicCholeskyRaw, factorize_symbolic_cholesky};
use faer::sparse::{Pair, SymbolicSparseColMat};

/// Runs of columns with the same rows below them, in the order of elimination.
#[derive(Debug)]
pub(super) struct Supernodes {
    /// Per unknown: its row in the order of elimination.
    pub row_of_unknown: Vec<u32>,
    /// Per row: its supernode.
    pub of_row: Vec<u32>,
    /// Per supernode, and once more for the end: its first column.
    begins: Vec<usize>,
    /// The rows below all supernodes, ascending in each.
    below: Vec<u32>,
    /// Per supernode, and once more for the end: where its rows begin.
    below_begins: Vec<usize>,
    /// Per supernode, and once more for the end: where its panel begins, columns of equal height one after the other.
    panel_begins: Vec<usize>,
}

impl Supernodes {
    /// Of the matrix with these places in its lower triangle, the diagonal included.
    pub fn new(size: usize, places: impl Iterator<Item = (usize, usize)>) -> Result<Supernodes, String> {
        let places: Vec<_> = places.map(|(row, col)| Pair { row, col }).collect();
        let (matrix, _) = SymbolicSparseColMat::<usize>::try_new_from_indices(size, size, &places)
            .map_err(|error| format!("{error:?}"))?;
        drop(places);
        let always = SupernodalThreshold::FORCE_SUPERNODAL;
        let how = CholeskySymbolicParams { supernodal_flop_ratio_threshold: always, ..Default::default() };
        let symbolic = factorize_symbolic_cholesky(matrix.as_ref(), Side::Lower, Default::default(), how)
            .map_err(|error| format!("{error:?}"))?;
        let (SymbolicCholeskyRaw::Supernodal(raw), Some(order)) = (symbolic.raw(), symbolic.perm()) else {
            return Err("its columns were not ordered".to_owned());
        };
        let row_of_unknown = order.arrays().1.iter().map(|&row| row as u32).collect();
        let count = raw.n_supernodes();
        let begins: Vec<usize> = raw.supernode_begin().iter().copied().chain([size]).collect();
        let mut of_row = vec![0; size];
        let (mut below, mut below_begins, mut panel_begins) = (Vec::new(), vec![0], vec![0]);
        let mut end = 0;
        for s in 0..count {
            let columns = begins[s + 1] - begins[s];
            of_row[begins[s]..begins[s + 1]].fill(s as u32);
            let rows = &raw.row_idx()[raw.col_ptr_for_row_idx()[s]..][..raw.nnz_per_super()[s]];
            below.extend(rows.iter().map(|&row| row as u32));
            below_begins.push(below.len());
            end += columns * (columns + rows.len());
            panel_begins.push(end);
        }
        Ok(Supernodes { row_of_unknown, of_row, begins, below, below_begins, panel_begins })
    }

    /// Of the matrix that has a full block of `size` rows and columns wherever this one has a number.
    pub fn in_blocks_of(&self, size: usize) -> Supernodes {
        let several = |rows: &[u32]| -> Vec<u32> {
            rows.iter().flat_map(|row| (0..size as u32).map(move |k| row * size as u32 + k)).collect()
        };
        let scaled = |begins: &[usize]| -> Vec<usize> { begins.iter().map(|begin| begin * size).collect() };
        Supernodes {
            row_of_unknown: several(&self.row_of_unknown),
            of_row: self.of_row.iter().flat_map(|s| std::iter::repeat_n(*s, size)).collect(),
            begins: scaled(&self.begins),
            below: several(&self.below),
            below_begins: scaled(&self.below_begins),
            panel_begins: scaled(&scaled(&self.panel_begins)),
        }
    }

    pub fn count(&self) -> usize {
        self.panel_begins.len() - 1
    }

    /// Numbers in all panels.
    pub fn len(&self) -> usize {
        self.panel_begins[self.count()]
    }

    /// The columns of a supernode.
    pub fn columns(&self, s: usize) -> std::ops::Range<usize> {
        self.begins[s]..self.begins[s + 1]
    }

    /// The rows below its columns.
    pub fn below(&self, s: usize) -> &[u32] {
        &self.below[self.below_begins[s]..self.below_begins[s + 1]]
    }

    /// Rows of its panel: those of its columns, and those below.
    pub fn height(&self, s: usize) -> usize {
        self.begins[s + 1] - self.begins[s] + self.below_begins[s + 1] - self.below_begins[s]
    }

    /// Where its panel is among all.
    pub fn panel(&self, s: usize) -> std::ops::Range<usize> {
        self.panel_begins[s]..self.panel_begins[s + 1]
    }

    /// Where the number at `(row, column)` of the lower triangle is among all panels; `None` where the factor has none.
    pub fn place(&self, row: usize, column: usize) -> Option<usize> {
        let s = self.of_row[column] as usize;
        let columns = self.columns(s);
        let local = if row < columns.end {
            row - columns.start
        } else {
            columns.len() + self.below(s).binary_search(&(row as u32)).ok()?
        };
        Some(self.panel_begins[s] + (column - columns.start) * self.height(s) + local)
    }
}
