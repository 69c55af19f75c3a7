//! Moments of points and of surfaces.

use glam::{DMat3, DVec3};

/// Weight, mean and central moments of points.
///
/// They are kept about the mean and moved from one mean to another, never taken as differences of large sums: a surface
/// that lies far from the origin has the moments that it has there.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    /// Sum of the weights w.
    pub weight: f64,
    /// Weighted mean.
    pub mean: DVec3,
    /// Sum of w q qᵀ, where q is the offset from the mean.
    pub second: DMat3,
    /// Sum of w q |q|².
    pub third: DVec3,
}

impl Default for Moments {
    fn default() -> Self {
        // The default of a matrix is the identity.
        Moments { weight: 0.0, mean: DVec3::ZERO, second: DMat3::ZERO, third: DVec3::ZERO }
    }
}

impl Moments {
    /// Of weighted points.
    pub fn of(points: impl Iterator<Item = (DVec3, f64)> + Clone) -> Moments {
        let (weight, sum) = points.clone().fold((0.0, DVec3::ZERO), |(weight, sum), (p, w)| (weight + w, sum + p * w));
        if weight <= 0.0 {
            return Moments::default();
        }
        let mean = sum / weight;
        let (second, third) = points.fold((DMat3::ZERO, DVec3::ZERO), |(second, third), (p, w)| {
            let q = p - mean;
            (second + outer(q) * w, third + q * (w * q.length_squared()))
        });
        Moments { weight, mean, second, third }
    }

    /// Of a triangle as a surface of uniform weight per area. Moments up to the third are exact with corners, middles of
    /// edges and centroid weighted 1/20, 2/15 and 9/20.
    pub fn of_triangle([a, b, c]: [DVec3; 3]) -> Moments {
        let area = 0.5 * (b - a).cross(c - a).length();
        let points = [
            (a, area / 20.0),
            (b, area / 20.0),
            (c, area / 20.0),
            ((a + b) / 2.0, area * (2.0 / 15.0)),
            ((b + c) / 2.0, area * (2.0 / 15.0)),
            ((c + a) / 2.0, area * (2.0 / 15.0)),
            ((a + b + c) / 3.0, area * (9.0 / 20.0)),
        ];
        if area.is_finite() { Moments::of(points.into_iter()) } else { Moments::default() }
    }

    /// Of both together.
    pub fn with(self, other: Moments) -> Moments {
        let weight = self.weight + other.weight;
        if weight <= 0.0 {
            return self;
        }
        let mean = self.mean + (other.mean - self.mean) * (other.weight / weight);
        let (a, b) = (self.about(mean), other.about(mean));
        Moments { weight, mean, second: a.second + b.second, third: a.third + b.third }
    }

    /// The same points with a total weight of 1; nothing stays nothing.
    pub fn normalized(self) -> Moments {
        if self.weight <= 0.0 {
            return self;
        }
        let Moments { weight, mean, second, third } = self;
        Moments { weight: 1.0, mean, second: second * (1.0 / weight), third: third / weight }
    }

    /// Moved by a vector.
    pub fn moved(self, by: DVec3) -> Moments {
        Moments { mean: self.mean + by, ..self }
    }

    /// Moments about another point than the mean.
    fn about(self, point: DVec3) -> Moments {
        let d = self.mean - point;
        let trace = self.second.x_axis.x + self.second.y_axis.y + self.second.z_axis.z;
        let third = self.third + self.second * d * 2.0 + d * (trace + self.weight * d.length_squared());
        Moments { mean: point, second: self.second + outer(d) * self.weight, third, ..self }
    }
}

fn outer(vector: DVec3) -> DMat3 {
    DMat3::from_cols(vector * vector.x, vector * vector.y, vector * vector.z)
}
