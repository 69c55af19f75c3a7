//! Vertices moved a little, so that nothing lies upon anything else by symmetry.

use glam::DVec3;

/// How far they are moved at most along each axis, as a share of the surface's size: far more than what rounding does to a point in which
/// planes meet, and far less than what a picture shows.
const SHARE: f64 = 1e-8;

/// Vertices moved, each in a direction of its own that depends on its number alone.
pub(super) fn in_general_position(positions: &[DVec3], size: f64) -> Vec<DVec3> {
    positions.iter().enumerate().map(|(v, place)| *place + direction(v as u64) * (size * SHARE)).collect()
}

/// Numbers from −1 to 1 that look random, from the number of a vertex (Steele, Lea and Flood's SplitMix64).
fn direction(vertex: u64) -> DVec3 {
    let number = |axis: u64| {
        let mut mixed = (3 * vertex + axis + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^= mixed >> 31;
        (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    DVec3::new(number(0), number(1), number(2))
}
