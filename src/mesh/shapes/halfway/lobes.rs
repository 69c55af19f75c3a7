//! Halfway models of sphere eversions: spheres that a rotation takes to themselves with their sides exchanged.

use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A sphere on its way between a halfway model and an embedded one, after A. and W. Bednorz, *Analytic sphere eversion using ruled
/// surfaces*, Differential Geometry and its Applications 64 (2019): a tube of lines, twisted and closed up by an inversion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Halfway {
    /// Lobes n: 2 for Morin's surface, 3 for Boy's surface, twice covered.
    pub lobes: usize,
    /// Where on the way: 0 is the halfway model, positive and negative numbers lie on either side of it.
    pub time: f64,
}

impl Halfway {
    /// Places of all vertices of a sphere around the origin, |V|. The turn by π/n about the z axis, together with the reflection
    /// z ↦ −z, becomes the turn by (n + 1) π/n of the halfway model.
    pub fn of_sphere(&self, sphere: &[DVec3]) -> Vec<DVec3> {
        sphere.iter().map(|p| self.point(*p)).collect()
    }

    /// Where a point of a sphere around the origin goes.
    fn point(&self, p: DVec3) -> DVec3 {
        let (n, t) = (self.lobes as f64, self.time);
        let bend = 2.0 * (STRETCH * SHRINK).sqrt();
        let middle = DVec3::new(0.0, 0.0, (STRETCH - SHRINK) / (bend * (STRETCH + SHRINK)));
        let around = p.truncate().length();
        let latitude = libm::atan2(p.z, around);
        // The limit at the poles, which have no longitude.
        if (FRAC_PI_2 - latitude.abs()).abs() < NEAR_A_POLE {
            return DVec3::new(0.0, 0.0, -1.0 / bend) - middle;
        }
        let longitude = libm::atan2(p.y, p.x);
        let [(sin, cos), (sin_less, cos_less), (sin_more, cos_more)] =
            [1.0, n - 1.0, n].map(|k| libm::sincos(k * longitude));
        let (sine, cosine) = libm::sincos(latitude);
        let height = RULING * sine / libm::pow(cosine, n);
        let x = t * cos + sin_less - height * sin;
        let y = t * sin + cos_less + height * cos;
        let z = height * sin_more - t / n * cos_more;
        let narrow = 1.0 + NARROWING * (x * x + y * y);
        let power = libm::pow(narrow, (n - 1.0) / (2.0 * n));
        let (x, y, z) = (x / power, y / power, z / narrow);
        let (radius, growth) = (x * x + y * y, libm::exp(bend * z));
        let inverted = DVec3::new(x, y, (STRETCH - SHRINK * radius) / bend) * (growth / (STRETCH + SHRINK * radius));
        inverted - middle
    }
}

/// ω of the paper, along the lines.
const RULING: f64 = 2.0;
/// η, with ξ = 1: how ends of the lines come together.
const NARROWING: f64 = 0.75;
/// α of the inversion.
const STRETCH: f64 = 1.0;
/// β of the inversion.
const SHRINK: f64 = 0.1;
/// In radians.
const NEAR_A_POLE: f64 = 1e-9;
