//! Where pictures stand on a contact sheet, and which.

/// Rows of small pictures with a thin margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sheet {
    columns: usize,
    rows: usize,
    /// Width and height of each picture.
    pub tile: [usize; 2],
    margin: usize,
}

const WIDEST_SHAPE: [f64; 2] = [16.0, 9.0];

impl Sheet {
    /// Places so many pictures of a shape on a sheet about as wide as is said, as near to 16:9 as there are few gaps.
    /// Pictures do not get larger than they are; one alone is as it is.
    pub fn of(count: usize, [width, height]: [usize; 2], wide: usize) -> Sheet {
        if count <= 1 {
            return Sheet { columns: 1, rows: 1, tile: [width, height], margin: 0 };
        }
        let goal = WIDEST_SHAPE[0] / WIDEST_SHAPE[1];
        let badness = |columns: usize| {
            let rows = count.div_ceil(columns);
            let aspect = (columns * width) as f64 / (rows * height) as f64;
            let gaps = (columns * rows) as f64 / count as f64;
            (aspect / goal).max(goal / aspect) * gaps * gaps
        };
        let columns = (1..=count).min_by(|&a, &b| badness(a).total_cmp(&badness(b))).unwrap_or(1);
        let margin = (wide / 240).max(1);
        let across = (wide.saturating_sub(margin * (columns + 1)) / columns).clamp(1, width);
        let down = ((across * height) as f64 / width as f64).round().max(1.0) as usize;
        Sheet { columns, rows: count.div_ceil(columns), tile: [across, down], margin }
    }

    /// Width and height of the whole.
    pub fn size(&self) -> [usize; 2] {
        let along = |tiles: usize, length: usize| tiles * (length + self.margin) + self.margin;
        [along(self.columns, self.tile[0]), along(self.rows, self.tile[1])]
    }

    /// Upper left corner of a picture, counted from 0.
    pub fn place(&self, index: usize) -> [usize; 2] {
        let [width, height] = self.tile;
        [
            self.margin + index % self.columns * (width + self.margin),
            self.margin + index / self.columns * (height + self.margin),
        ]
    }
}

/// So many of these frames, evenly over all: from the first to the last, or in a film that loops, as far from the
/// last to the first as from one to the next.
pub(super) fn evenly(frames: &[usize], count: usize, looping: bool) -> Vec<usize> {
    if count >= frames.len() {
        return frames.to_vec();
    }
    let place = |index: usize| {
        if looping {
            index * frames.len() / count
        } else {
            // Rounded to the nearest.
            (2 * index * (frames.len() - 1) + count - 1) / (2 * (count - 1).max(1))
        }
    };
    (0..count).map(|index| frames[place(index)]).collect()
}
