//! Which primitives can touch which tile.

use crate::render::Output;

/// The tiles of a picture: squares on a grid that starts in its upper left corner, of which those that
/// meet the window are made.
#[derive(Clone, Copy, Debug)]
pub struct Tiles {
    /// Pixels along a side.
    side: i32,
    /// Pixels around a tile that are drawn too, because the filter of its pixels reaches there.
    margin: i32,
    first: [i32; 2],
    count: [i32; 2],
}

impl Tiles {
    pub fn new(side: usize, margin: usize, output: &Output) -> Self {
        let [x, y, width, height] = output.window();
        let (first, end) = ([x / side, y / side], [(x + width).div_ceil(side), (y + height).div_ceil(side)]);
        Self {
            side: side as i32,
            margin: margin as i32,
            first: first.map(|value| value as i32),
            count: [0, 1].map(|axis| (end[axis] - first[axis]) as i32),
        }
    }

    /// Number of columns and rows.
    pub fn count(&self) -> [usize; 2] {
        self.count.map(|count| count as usize)
    }

    /// Upper left pixel of a tile.
    pub fn corner(&self, tile: usize) -> [i32; 2] {
        let place = [tile as i32 % self.count[0], tile as i32 / self.count[0]];
        [0, 1].map(|axis| (self.first[axis] + place[axis]) * self.side)
    }

    /// The tiles that are touched, with their margins, by pixels from the first to the last in x and y.
    fn touched(&self, bounds: [[i32; 2]; 2]) -> impl Iterator<Item = usize> {
        let span = |axis: usize| {
            let [first, last] = bounds[axis];
            let tile = |pixel: i32| pixel.div_euclid(self.side) - self.first[axis];
            [
                tile(first.saturating_sub(self.margin)).max(0),
                (tile(last.saturating_add(self.margin)) + 1).min(self.count[axis]),
            ]
        };
        let (across, columns) = (span(0), self.count[0]);
        let down = span(1);
        (down[0]..down[1])
            .flat_map(move |row| (across[0]..across[1]).map(move |column| (row * columns + column) as usize))
    }
}

/// For each tile, row by row, the primitives whose bounds touch it, in their own order.
#[derive(Clone, Debug)]
pub struct Bins {
    starts: Vec<usize>,
    items: Vec<u32>,
}

impl Bins {
    /// Sorts primitives that touch pixels from the first to the last in x and y.
    pub fn new(bounds: impl Iterator<Item = [[i32; 2]; 2]> + Clone, tiles: &Tiles) -> Self {
        let [columns, rows] = tiles.count();
        let mut starts = vec![0_usize; columns * rows + 1];
        for bound in bounds.clone() {
            tiles.touched(bound).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 0..columns * rows {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[columns * rows]];
        for (item, bound) in bounds.enumerate() {
            for tile in tiles.touched(bound) {
                items[next[tile]] = item as u32;
                next[tile] += 1;
            }
        }
        Self { starts, items }
    }

    /// The primitives of a tile.
    pub fn of(&self, tile: usize) -> &[u32] {
        &self.items[self.starts[tile]..self.starts[tile + 1]]
    }
}
