use glam::{DMat3, DVec3};
use nalgebra::Matrix3;
use rayon::prelude::*;

/// What a camera has to know of a set of positions: its moments and its outermost points.
///
/// Extents of all frames of a film merge into one, so a camera can be set up once and held.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    count: f64,
    sum: DVec3,
    /// Sum of p pᵀ.
    squares: DMat3,
    /// Sum of p |p|².
    cubes: DVec3,
    /// For each of a fixed set of directions the outermost point; empty before the first point.
    outermost: Vec<DVec3>,
}

/// Positions that are looked at in one go.
const PIECE: usize = 4096;
/// How many directions are probed for outermost points. A sphere is missed by less than 1 %.
const DIRECTIONS: usize = 512;

impl Extent {
    /// The extent of some positions; those that are not finite are left out.
    pub fn of(positions: &[DVec3]) -> Self {
        let directions = directions();
        // In fixed pieces, for the same bits on any number of threads.
        let pieces: Vec<Self> = positions.par_chunks(PIECE).map(|piece| Self::of_piece(piece, &directions)).collect();
        let mut extent = Self::default();
        pieces.iter().for_each(|piece| extent.merge_along(piece, &directions));
        extent
    }

    fn of_piece(positions: &[DVec3], directions: &[DVec3]) -> Self {
        let mut extent = Self::default();
        for &position in positions.iter().filter(|position| position.is_finite()) {
            extent.count += 1.0;
            extent.sum += position;
            extent.squares += outer(position);
            extent.cubes += position * position.length_squared();
            if extent.outermost.is_empty() {
                extent.outermost = vec![position; DIRECTIONS];
            }
            for (best, &direction) in extent.outermost.iter_mut().zip(directions) {
                if position.dot(direction) > best.dot(direction) {
                    *best = position;
                }
            }
        }
        extent
    }

    /// Adds another frame.
    pub fn merge(&mut self, other: &Extent) {
        let directions = directions();
        self.merge_along(other, &directions);
    }

    fn merge_along(&mut self, other: &Extent, directions: &[DVec3]) {
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.cubes += other.cubes;
        if self.outermost.is_empty() {
            self.outermost.clone_from(&other.outermost);
        }
        for ((best, &point), &direction) in self.outermost.iter_mut().zip(&other.outermost).zip(directions) {
            if point.dot(direction) > best.dot(direction) {
                *best = point;
            }
        }
    }

    /// The outermost points, which stand for the convex hull.
    pub(super) fn outermost(&self) -> &[DVec3] {
        &self.outermost
    }

    /// The least height along a direction; 0 if there is nothing.
    pub fn lowest(&self, up: DVec3) -> f64 {
        self.outermost.iter().map(|point| point.dot(up)).reduce(f64::min).unwrap_or(0.0)
    }

    /// Middle of the box around the outermost points, and their greatest distance from it.
    pub(super) fn ball(&self) -> Option<(DVec3, f64)> {
        let low = self.outermost.iter().copied().reduce(DVec3::min)?;
        let high = self.outermost.iter().copied().reduce(DVec3::max)?;
        let center = (low + high) / 2.0;
        let radius = self.outermost.iter().map(|point| point.distance(center)).fold(0.0, f64::max);
        Some((center, radius))
    }

    /// Mean of q |q|², where q is the offset from the mean: it points to where the surface is wide and
    /// open, from the bottom of a bowl to its opening.
    fn open_side(&self, mean: DVec3) -> DVec3 {
        let count = self.count.max(1.0);
        let (squares, cubes) = (self.squares * (1.0 / count), self.cubes / count);
        let trace = squares.x_axis.x + squares.y_axis.y + squares.z_axis.z;
        cubes - squares * mean * 2.0 + mean * (2.0 * mean.length_squared() - trace)
    }

    /// Principal axes, longest first, with the variances along them.
    pub(super) fn principal_axes(&self) -> [(DVec3, f64); 3] {
        let mean = self.sum / self.count.max(1.0);
        let covariance = self.squares * (1.0 / self.count.max(1.0)) - outer(mean);
        let eigen = Matrix3::from_column_slice(&covariance.to_cols_array()).symmetric_eigen();
        let largest = eigen.eigenvalues.max().max(f64::MIN_POSITIVE);
        let open_side = self.open_side(mean) / (largest * largest.sqrt());
        let mut axes = [0, 1, 2].map(|column| {
            let axis = DVec3::from_slice(eigen.eigenvectors.column(column).as_slice());
            (signed(axis, open_side), eigen.eigenvalues[column].max(0.0))
        });
        axes.sort_by(|a, b| b.1.total_cmp(&a.1));
        axes
    }
}

/// An axis has no sign of its own. It is turned to the open side, or where there is none, so that its
/// largest coordinate is positive.
fn signed(axis: DVec3, open_side: DVec3) -> DVec3 {
    let openness = axis.dot(open_side);
    let largest = axis.to_array().into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
    let sign = if openness.abs() > 0.05 { openness } else { largest };
    if sign < 0.0 { -axis } else { axis }
}

fn outer(vector: DVec3) -> DMat3 {
    DMat3::from_cols(vector * vector.x, vector * vector.y, vector * vector.z)
}

/// The directions that are probed.
fn directions() -> Vec<DVec3> {
    (0..DIRECTIONS).map(|index| fibonacci_direction(index, DIRECTIONS)).collect()
}

/// Directions spread evenly over the sphere along a spiral.
fn fibonacci_direction(index: usize, count: usize) -> DVec3 {
    let height = 1.0 - (2 * index + 1) as f64 / count as f64;
    let angle = index as f64 * std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let radius = (1.0 - height * height).sqrt();
    DVec3::new(radius * libm::cos(angle), height, radius * libm::sin(angle))
}
