//! How far surfaces reach, and which way they lie.

use glam::DVec3;
use rayon::prelude::*;

use super::moments::Moments;
use crate::algebra::{principal_axes, upright_sign};

/// What a camera has to know of a surface: its moments and its outermost points.
///
/// Extents of all frames of a film merge into one, in which each counts the same, so a camera can be set up once and
/// held. Neither the unit of length nor the place in space nor, as far as the shape is the same, the number of
/// triangles makes a difference.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    /// The first point. All that follows is relative to it, which is exact where a surface lies far from the origin.
    origin: DVec3,
    /// Of weight 1 for every surface.
    moments: Moments,
    /// For each of a fixed set of directions the outermost point; empty before the first point.
    outermost: Vec<DVec3>,
}

/// Positions or triangles that are looked at in one go.
const PIECE: usize = 4096;
/// Points of which a ball is made.
const TOGETHER: usize = 32;
/// How many directions are probed for outermost points. A sphere is missed by less than 1 %.
const DIRECTIONS: usize = 512;
/// Variances that differ by no more than this share are those of something round, whose axes mean nothing.
const ROUND: f64 = 0.01;
/// Axes of what is round all over: it is seen with z, the height, upward.
const AXES: [DVec3; 3] = [DVec3::X, DVec3::Z, DVec3::Y];

impl Extent {
    /// The extent of some points; those that are not finite are left out.
    pub fn of(points: &[DVec3]) -> Self {
        Self::weighted_by_area(points, &[])
    }

    /// The extent of a surface with its corners in these positions. Triangles without finite corners, or with a corner that has
    /// no position, are left out.
    pub fn of_surface(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        Self::weighted_by_area(positions, triangles)
    }

    /// Without any area every point weighs the same.
    fn weighted_by_area(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let Some(&origin) = positions.iter().find(|position| position.is_finite()) else { return Self::default() };
        let together = |pieces: Vec<Moments>| pieces.into_iter().fold(Moments::default(), Moments::with);
        // In fixed pieces, for the same bits on any number of threads.
        let place = |vertex: u32| positions.get(vertex as usize).map_or(DVec3::NAN, |&position| position - origin);
        let of_triangle = |corners: &[u32; 3]| Moments::of_triangle(corners.map(place));
        let of_triangles = |piece: &[[u32; 3]]| piece.iter().map(of_triangle).fold(Moments::default(), Moments::with);
        let surface = together(triangles.par_chunks(PIECE).map(of_triangles).collect());
        let of_points = |piece: &[DVec3]| {
            Moments::of(piece.iter().filter(|point| point.is_finite()).map(|&point| (point - origin, 1.0)))
        };
        let points = || together(positions.par_chunks(PIECE).map(of_points).collect());
        let moments = if surface.weight > 0.0 { surface } else { points() };
        let directions = directions();
        let outermost = positions
            .par_chunks(PIECE)
            .map(|piece| {
                let finite: Vec<DVec3> = piece.iter().copied().filter(|point| point.is_finite()).collect();
                outermost(&finite, origin, &directions)
            })
            .collect::<Vec<_>>()
            .concat();
        let outermost = outermost_of(&outermost, origin, &directions);
        Self { origin, moments: moments.normalized(), outermost }
    }

    /// Adds another frame.
    pub fn merge(&mut self, other: &Extent) {
        if self.outermost.is_empty() {
            self.origin = other.origin;
        }
        self.moments = self.moments.with(other.moments.moved(other.origin - self.origin));
        let both = [self.outermost.as_slice(), &other.outermost].concat();
        self.outermost = outermost_of(&both, self.origin, &directions());
    }

    /// The outermost points, which stand for the convex hull.
    pub(in crate::render) fn outermost(&self) -> &[DVec3] {
        &self.outermost
    }

    /// The least height along a direction; 0 if there is nothing.
    pub fn lowest(&self, up: DVec3) -> f64 {
        self.outermost.iter().map(|point| point.dot(up)).reduce(f64::min).unwrap_or(0.0)
    }

    /// Middle of the box around the outermost points, and their greatest distance from it.
    pub(in crate::render) fn ball(&self) -> Option<(DVec3, f64)> {
        let low = self.outermost.iter().copied().reduce(DVec3::min)?;
        let high = self.outermost.iter().copied().reduce(DVec3::max)?;
        let center = low + (high - low) / 2.0;
        let radius = self.outermost.iter().map(|point| point.distance(center)).fold(0.0, f64::max);
        Some((center, radius))
    }

    /// Principal axes, longest first, with the variances along them. They point to the open side: the mean of q |q|²,
    /// where q is the offset from the mean, points to where the surface is wide and open, from the bottom of a bowl to its
    /// opening.
    pub(in crate::render) fn principal_axes(&self) -> [(DVec3, f64); 3] {
        let axes = principal_axes(self.moments.second, ROUND, AXES);
        let largest = axes[0].1.max(f64::MIN_POSITIVE);
        let open_side = self.moments.third / largest / largest.sqrt();
        axes.map(|(axis, variance)| (signed(axis, open_side), variance))
    }
}

/// An axis has no sign of its own. It is turned to the open side, or where there is none, so that its
/// largest coordinate is positive.
fn signed(axis: DVec3, open_side: DVec3) -> DVec3 {
    let openness = axis.dot(open_side);
    axis * if openness.abs() > 0.05 { openness.signum() } else { upright_sign(axis) }
}

/// For each direction the first of the outermost of some points; nothing if there is none.
///
/// Of points that follow each other, which mostly lie together, none is looked at where the ball around them does not reach
/// beyond what was found.
fn outermost(points: &[DVec3], origin: DVec3, directions: &[DVec3]) -> Vec<DVec3> {
    let Some(&first) = points.first() else { return Vec::new() };
    let mut best = vec![(first, f64::MIN); directions.len()];
    for neighbors in points.chunks(TOGETHER) {
        let ball = Ball::around(neighbors, origin);
        for (best, &direction) in best.iter_mut().zip(directions) {
            if ball.farthest(direction) <= best.1 {
                continue;
            }
            for &point in neighbors {
                let reach = (point - origin).dot(direction);
                if reach > best.1 {
                    *best = (point, reach);
                }
            }
        }
    }
    best.into_iter().map(|(point, _)| point).collect()
}

/// A ball that has points inside, also after rounding.
struct Ball {
    center: DVec3,
    radius: f64,
}

impl Ball {
    fn around(points: &[DVec3], origin: DVec3) -> Ball {
        let center = points.iter().fold(DVec3::ZERO, |sum, &point| sum + (point - origin)) / points.len() as f64;
        let radius = points.iter().map(|&point| (point - origin).distance(center)).fold(0.0, f64::max);
        Ball { center, radius: radius + 1e-12 * (radius + center.length()) }
    }

    /// Along a direction.
    fn farthest(&self, direction: DVec3) -> f64 {
        self.center.dot(direction) + self.radius
    }
}

/// Of points that are outermost among some, those that are so among all.
fn outermost_of(points: &[DVec3], origin: DVec3, directions: &[DVec3]) -> Vec<DVec3> {
    // Each piece has one point per direction, in order.
    let Some(count) = points.len().checked_div(directions.len()).filter(|&count| count > 0) else { return Vec::new() };
    let reach = |point: &DVec3, direction: DVec3| (*point - origin).dot(direction);
    let best = |(k, &direction): (usize, &DVec3)| {
        let candidates = (0..count).map(|piece| points[piece * directions.len() + k]);
        candidates.reduce(|a, b| if reach(&b, direction) > reach(&a, direction) { b } else { a })
    };
    directions.iter().enumerate().filter_map(best).collect()
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
