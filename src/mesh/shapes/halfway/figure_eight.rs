//! Halfway models of torus eversions: rings whose cross-section is a figure eight.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A ring that is swept by a figure eight, which turns in its plane. After half a turn the ring is the same surface with its sides exchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureEight {
    /// Vertices around the axis. Vertex `i` of row `j` has number `j * columns + i`; every second row is shifted by half a column.
    pub columns: usize,
    /// Vertices around the figure eight.
    pub rows: usize,
    /// Circumference around the axis over 2π.
    pub ring_radius: f64,
    /// Length of the figure eight over 2π.
    pub tube_radius: f64,
    /// What the figure eight does besides while it turns.
    pub slides: bool,
}

impl FigureEight {
    /// Positions on the way, |V|: 0 is the halfway model, and so many radians to either side of it the eight has turned by as much.
    ///
    /// Where lengths are the same all along the eight, the one that lies is halfway, since an upright one is stretched less. On a torus of
    /// revolution, where one circle is longest, it also slides along itself as fast as it turns: the longest circle is outside in the
    /// beginning and in the end, and halfway, where the eight is upright, it passes through the crossing.
    pub fn at(&self, time: f64) -> Vec<DVec3> {
        let (tilt, slide) = if self.slides { (FRAC_PI_2 + time, FRAC_PI_2 + time) } else { (time, 0.0) };
        let (sine, cosine) = libm::sincos(tilt);
        let point = |[u, v]: [f64; 2]| {
            let along = LONG * libm::cos(v - slide);
            let across = SHORT * libm::sin(2.0 * (v - slide));
            let out = self.ring_radius + self.tube_radius * (cosine * along - sine * across);
            let (sin, cos) = libm::sincos(u);
            DVec3::new(out * cos, out * sin, self.tube_radius * (sine * along + cosine * across))
        };
        self.angles().map(point).collect()
    }

    /// The same vertices on a torus that does not meet itself, |V|.
    pub fn embedded(&self) -> Vec<DVec3> {
        let point = |[u, v]: [f64; 2]| {
            let ((sin, cos), (height, out)) = (libm::sincos(u), libm::sincos(v));
            DVec3::new((2.0 + out) * cos, (2.0 + out) * sin, height)
        };
        self.angles().map(point).collect()
    }

    /// Per vertex: the angle around the axis, and the one around the figure eight.
    fn angles(&self) -> impl Iterator<Item = [f64; 2]> {
        let FigureEight { columns, rows, .. } = *self;
        let angle = move |j: usize, i: usize| {
            let column = i as f64 + 0.5 * (j % 2) as f64;
            [TAU * column / columns as f64, TAU * j as f64 / rows as f64]
        };
        (0..rows).flat_map(move |j| (0..columns).map(move |i| angle(j, i)))
    }
}

/// Half the length of an eight (x, y) = (LONG cos t, SHORT sin 2t) that is 2π long.
const LONG: f64 = 1.2;
/// Half its height: the proportions are nearly those of an elastic rod.
const SHORT: f64 = 0.42;
