//! Principal axes of second moments, which say where a surface is long and where it is short.

use glam::{DMat3, DVec3};
use nalgebra::Matrix3;

/// Moments along the two short axes of a line differ by rounding, relative to the long one.
const ROUNDING: f64 = 1e-12;
/// Coordinate axes that are as near to a plane, up to rounding, are taken in their order.
const AS_NEAR: f64 = 1e-6;

/// Unit axes of a symmetric matrix of second moments and the moments along them, largest first. Signs are left open.
///
/// Moments that differ by no more than a share `tie` leave their axes open; rounding must not choose them. Such axes
/// are taken along `preferred`, an orthonormal basis, as far as those that are not tied let them.
pub fn principal_axes(moments: DMat3, tie: f64, preferred: [DVec3; 3]) -> [(DVec3, f64); 3] {
    if !moments.is_finite() {
        return preferred.map(|axis| (axis, 0.0));
    }
    let eigen = Matrix3::from_column_slice(&moments.to_cols_array()).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let [long, middle, short] = order.map(|column| eigen.eigenvalues[column].max(0.0));
    let [a, _, c] = order.map(|column| DVec3::from_slice(eigen.eigenvectors.column(column).as_slice()));
    let is_tie = |more: f64, less: f64| more - less <= tie * more + ROUNDING * long;
    let axes = match (is_tie(long, middle), is_tie(middle, short)) {
        (true, true) => preferred,
        (true, false) => {
            let [first, second] = plane_axes(c, preferred);
            [first, second, c]
        }
        (false, true) => {
            let [first, second] = plane_axes(a, preferred);
            [a, first, second]
        }
        (false, false) => order.map(|column| DVec3::from_slice(eigen.eigenvectors.column(column).as_slice())),
    };
    let [x, y, z] = axes;
    [(x, long), (y, middle), (z, short)]
}

/// Two unit vectors that span the plane across `normal`: the first is nearest to one of the axes.
fn plane_axes(normal: DVec3, preferred: [DVec3; 3]) -> [DVec3; 2] {
    let height = |axis: &DVec3| axis.dot(normal).abs();
    let lowest = preferred.iter().map(height).fold(f64::MAX, f64::min);
    let nearest = preferred.into_iter().find(|axis| height(axis) <= lowest + AS_NEAR).unwrap_or(preferred[0]);
    let first = (nearest - normal * nearest.dot(normal)).normalize();
    [first, normal.cross(first)]
}

/// The sign, as a factor, that makes the largest coordinate of an axis positive. Of coordinates that are as large, up
/// to rounding, the first one counts.
pub fn upright_sign(axis: DVec3) -> f64 {
    let largest = axis.abs().max_element();
    let first = axis.to_array().into_iter().find(|x| x.abs() >= largest * (1.0 - AS_NEAR)).unwrap_or(1.0);
    if first < 0.0 { -1.0 } else { 1.0 }
}
