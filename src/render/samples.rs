//! Where in a pixel the samples lie, and how they are weighted into a picture.

/// Subpixels per pixel: vertices and samples lie on this grid.
pub const SUBPIXELS: i64 = 256;

/// Sample places within a pixel in sixteenths, on rotated grids: no two share a row or a column
/// (up to the symmetry of the one in the middle).
const ONE: [[i64; 2]; 1] = [[8, 8]];
const FOUR: [[i64; 2]; 4] = [[6, 2], [14, 6], [2, 10], [10, 14]];
const EIGHT: [[i64; 2]; 8] = [[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]];
const SIXTEEN: [[i64; 2]; 16] = [
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

/// The sample places of one pixel in subpixels, x to the right and y down.
pub fn pattern(samples: usize) -> Vec<[i64; 2]> {
    let sixteenths: &[[i64; 2]] = match samples {
        1 => &ONE,
        4 => &FOUR,
        8 => &EIGHT,
        _ => &SIXTEEN,
    };
    sixteenths.iter().map(|place| place.map(|value| value * SUBPIXELS / 16)).collect()
}

/// Radius of the reconstruction filter in pixels; it reaches into the eight neighbours.
const FILTER_RADIUS: f32 = 1.5;

/// Weights of the samples of a pixel and its neighbours, row by row, that sum to 1.
///
/// A Blackman-Harris bell: no negative lobes, hence no ringing at the outline. With one sample per
/// pixel there is nothing to reconstruct from, and the sample itself is the pixel.
pub fn filter_weights(pattern: &[[i64; 2]]) -> Vec<f32> {
    let mut weights = Vec::with_capacity(9 * pattern.len());
    for neighbour in 0..9_i64 {
        for place in pattern {
            let offset = |axis: i64, place: i64| (axis - 1) as f32 + place as f32 / SUBPIXELS as f32 - 0.5;
            weights.push(bell(offset(neighbour % 3, place[0])) * bell(offset(neighbour / 3, place[1])));
        }
    }
    if pattern.len() == 1 {
        weights = (0..9).map(|neighbour| if neighbour == 4 { 1.0 } else { 0.0 }).collect();
    }
    let sum: f32 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}

fn bell(offset: f32) -> f32 {
    if offset.abs() >= FILTER_RADIUS {
        return 0.0;
    }
    let phase = std::f32::consts::PI * (offset / FILTER_RADIUS + 1.0);
    0.358_75 - 0.488_29 * libm::cosf(phase) + 0.141_28 * libm::cosf(2.0 * phase) - 0.011_68 * libm::cosf(3.0 * phase)
}
