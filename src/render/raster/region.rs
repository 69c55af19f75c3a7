//! Rectangles of pixels.

/// A rectangle of pixels, ends excluded.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    pub x: [i32; 2],
    pub y: [i32; 2],
}

impl Region {
    /// What two rectangles have in common, if anything.
    pub fn common(&self, other: &Region) -> Option<Region> {
        let span = |a: [i32; 2], b: [i32; 2]| [a[0].max(b[0]), a[1].min(b[1])];
        let common = Region { x: span(self.x, other.x), y: span(self.y, other.y) };
        (common.x[0] < common.x[1] && common.y[0] < common.y[1]).then_some(common)
    }

    pub fn width(&self) -> i32 {
        self.x[1] - self.x[0]
    }

    pub fn height(&self) -> i32 {
        self.y[1] - self.y[0]
    }

    /// Its upper and lower half, or left and right if it is one row.
    pub fn halves(&self) -> [Region; 2] {
        if self.height() > 1 {
            let middle = self.y[0] + self.height() / 2;
            [Region { y: [self.y[0], middle], ..*self }, Region { y: [middle, self.y[1]], ..*self }]
        } else {
            let middle = self.x[0] + self.width() / 2;
            [Region { x: [self.x[0], middle], ..*self }, Region { x: [middle, self.x[1]], ..*self }]
        }
    }

    /// The pixel at a place in rows of the region.
    pub fn pixel(&self, index: usize) -> [i32; 2] {
        [self.x[0] + index as i32 % self.width(), self.y[0] + index as i32 / self.width()]
    }

    /// Place of a pixel in rows of the region.
    pub fn index(&self, x: i32, y: i32) -> usize {
        ((y - self.y[0]) * self.width() + x - self.x[0]) as usize
    }
}
