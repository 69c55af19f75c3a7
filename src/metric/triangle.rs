//! Angles and areas of triangles from their sides, to rounding.

/// The least slack of a triangle: by how much its longest side is shorter than the sum of the others, over the sum of
/// all.
///
/// Lengths that are rounded to double precision determine the angles of a triangle with the slack `s` up to `2⁻⁵² / √s`,
/// here 2·10⁻⁹ radians; of thinner ones, soon nothing is left. The solvers have no such limit: a sphere with one triangle
/// as thin as this is found from random frames within 0.1 %.
pub const TRIANGLE_MARGIN: f64 = 1e-14;

/// Where sides are as nearly one line as this, differences of rounded sums lose the angles.
const NEARLY_STRAIGHT: f64 = 1e-9;

/// Half-angle formula (App. D); `l[k]` is the side from corner `k` to `k + 1`, so opposite corner `k + 2`.
pub(super) fn angles(l: [f64; 3]) -> [f64; 3] {
    if slack(l) < NEARLY_STRAIGHT {
        return angles_of_thin(l);
    }
    let [a, b, c] = l;
    let sum = a + b + c;
    [0, 1, 2].map(|k| {
        let opposite = l[(k + 1) % 3];
        let (next, previous) = (l[k], l[(k + 2) % 3]);
        let above = (opposite + next - previous) * (opposite + previous - next);
        let below = sum * (next + previous - opposite);
        2.0 * libm::atan2(above.max(0.0).sqrt(), below.max(0.0).sqrt())
    })
}

/// The same from differences in Kahan's order, which are exact where they are small.
fn angles_of_thin(l: [f64; 3]) -> [f64; 3] {
    let mut order = [0, 1, 2];
    order.sort_unstable_by(|&x, &y| l[y].total_cmp(&l[x]));
    let [a, b, c] = order.map(|k| l[k]);
    // The perimeter, and it without twice each side.
    let whole = a + (b + c);
    let without = [c - (a - b), c + (a - b), a + (b - c)].map(|x| x.max(0.0));
    let mut angles = [0.0; 3];
    for (k, side) in order.into_iter().enumerate() {
        let (next, previous) = (without[(k + 1) % 3], without[(k + 2) % 3]);
        // The side `l[k]` is opposite corner k + 2.
        angles[(side + 2) % 3] = 2.0 * libm::atan2((next * previous).sqrt(), (whole * without[k]).sqrt());
    }
    angles
}

/// By how much the longest side is shorter than the sum of the others, over the sum of all.
pub(super) fn slack(l: [f64; 3]) -> f64 {
    let [a, b, c] = descending(l);
    (c - (a - b)) / (a + (b + c))
}

fn descending(mut l: [f64; 3]) -> [f64; 3] {
    l.sort_unstable_by(|x, y| y.total_cmp(x));
    l
}

/// Heron's formula in Kahan's stable order.
pub(super) fn area(l: [f64; 3]) -> f64 {
    let [a, b, c] = descending(l);
    0.25 * ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).max(0.0).sqrt()
}
