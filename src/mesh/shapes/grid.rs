//! Connectivity of rows of vertices that close up sideways.
//!
//! Vertex `i` of row `j` has number `j * columns + i`.

/// How the rows lie to each other.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Rows {
    /// Odd rows are shifted by half a column, so that triangles are isosceles.
    Staggered,
    /// All rows alike; cells are cut along the diagonal that goes up and to the right.
    Aligned,
}

impl Rows {
    /// How many half columns row `j` is shifted.
    pub(super) fn half_columns(self, j: usize) -> usize {
        match self {
            Rows::Staggered => j % 2,
            Rows::Aligned => 0,
        }
    }

    /// Where vertex `i` of row `j` is, in columns.
    pub(super) fn column(self, i: usize, j: usize) -> f64 {
        i as f64 + 0.5 * self.half_columns(j) as f64
    }
}

/// The faces of `rows` rows of cells between `vertex_rows` rows of vertices, counterclockwise when columns
/// go to the right and rows upward. With as many rows of vertices as of cells, the last row is glued to
/// the first, and the number of rows has to be even if they are staggered.
pub(super) fn grid_faces(columns: usize, rows: usize, vertex_rows: usize, layout: Rows) -> Vec<[u32; 3]> {
    let vertex = |i: usize, j: usize| ((j % vertex_rows) * columns + i % columns) as u32;
    let mut faces = Vec::with_capacity(2 * columns * rows);
    for j in 0..rows {
        for i in 0..columns {
            let (a, b, c, d) = (vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
            if layout == Rows::Staggered && j % 2 == 0 {
                faces.extend([[a, b, d], [b, c, d]]);
            } else {
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    faces
}
