//! Which primitives can touch which tile.

use std::ops::Range;

use super::Output;

/// For each tile, row by row, the primitives whose bounds touch it, in their own order.
#[derive(Clone, Debug)]
pub struct Bins {
    starts: Vec<usize>,
    items: Vec<u32>,
}

impl Bins {
    /// Sorts primitives with these pixel bounds into tiles of `tile` pixels plus a margin.
    pub fn new(
        bounds: impl Iterator<Item = [[f32; 2]; 2]> + Clone,
        tile: usize,
        margin: usize,
        output: &Output,
    ) -> Self {
        let columns = output.width().div_ceil(tile);
        let rows = output.height().div_ceil(tile);
        let span = |low: f32, high: f32, count: usize| -> Range<usize> {
            let tile_size = tile as f32;
            let first = ((low - margin as f32) / tile_size).floor().clamp(0.0, count as f32) as usize;
            let last = ((high + margin as f32) / tile_size).floor().clamp(-1.0, count as f32 - 1.0) as i64;
            first..(last + 1) as usize
        };
        let tiles = |[low, high]: [[f32; 2]; 2]| {
            let across = span(low[0], high[0], columns);
            span(low[1], high[1], rows).flat_map(move |row| across.clone().map(move |column| row * columns + column))
        };
        let mut starts = vec![0_usize; columns * rows + 1];
        for bound in bounds.clone() {
            tiles(bound).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 0..columns * rows {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[columns * rows]];
        for (item, bound) in bounds.enumerate() {
            for tile in tiles(bound) {
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
