//! Where in a pixel the samples lie.

/// Sample places within a pixel in sixteenths, on rotated grids: no two share a row or a column
/// (up to the symmetry of the one in the middle).
const ONE: [[i32; 2]; 1] = [[8, 8]];
const FOUR: [[i32; 2]; 4] = [[6, 2], [14, 6], [2, 10], [10, 14]];
const EIGHT: [[i32; 2]; 8] = [[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]];
const SIXTEEN: [[i32; 2]; 16] = [
    [9, 9],
    [7, 5],
    [5, 10],
    [12, 7],
    [3, 6],
    [10, 13],
    [13, 11],
    [11, 3],
    [6, 14],
    [8, 1],
    [4, 2],
    [2, 12],
    [0, 8],
    [15, 4],
    [14, 15],
    [1, 0],
];

/// The sample places of one pixel in sixteenths, x to the right and y down.
#[derive(Clone, Copy, Debug)]
pub struct SamplePattern<const S: usize> {
    pub x: [i32; S],
    pub y: [i32; S],
}

impl<const S: usize> SamplePattern<S> {
    /// The pattern of 1, 4, 8 or 16 samples.
    pub fn new() -> Self {
        let places: &[[i32; 2]] = match S {
            1 => &ONE,
            4 => &FOUR,
            8 => &EIGHT,
            _ => &SIXTEEN,
        };
        let place = |axis: usize| std::array::from_fn(|sample| places[sample % places.len()][axis]);
        Self { x: place(0), y: place(1) }
    }

    /// A value for each sample from its place in sixteenths.
    #[inline(always)]
    pub fn map<T: Copy + Default>(&self, value: impl Fn(i32, i32) -> T) -> [T; S] {
        let mut values = [T::default(); S];
        for (result, (&x, &y)) in values.iter_mut().zip(self.x.iter().zip(&self.y)) {
            *result = value(x, y);
        }
        values
    }

    /// A sample's place in pixels.
    pub fn place(&self, sample: usize) -> [f32; 2] {
        [self.x[sample] as f32 / 16.0, self.y[sample] as f32 / 16.0]
    }

    /// Mean place in pixels of the samples whose bits are set; the middle if none is.
    pub fn middle(&self, mask: u32) -> [f32; 2] {
        let seen = (0..S).filter(|sample| mask >> sample & 1 == 1);
        let (x, y, count) = seen.fold((0, 0, 0), |(x, y, count), s| (x + self.x[s], y + self.y[s], count + 1));
        if count == 0 { [0.5; 2] } else { [x, y].map(|sum| sum as f32 / (16 * count) as f32) }
    }
}
