//! Signed distance of a tree of solids: negative inside, exact or a little too small outside.

use glam::{DMat3, DVec3};

use crate::mesh::shapes::error::{ShapeError, ShapeFault};
use crate::mesh::shapes::limits::{finite, invalid, positive};
use crate::mesh::shapes::shape::{Body, Operation, Solid};

const SHAPE: &str = "implicit";

/// A checked solid, ready to be evaluated.
pub(super) enum Field {
    Sphere { center: DVec3, radius: f64 },
    Capsule { from: DVec3, to: DVec3, radii: [f64; 2] },
    Torus { center: DVec3, axis: DVec3, major_radius: f64, minor_radius: f64 },
    Ellipsoid { center: DVec3, radii: DVec3, to_local: DMat3 },
    Group(Vec<Part>),
}

pub(super) struct Part {
    field: Field,
    operation: Operation,
    blend: f64,
}

impl Field {
    pub(super) fn new(body: &Body) -> Result<Field, ShapeError> {
        Field::inside("", body)
    }

    /// `place` is the path of the solid that the body is of, such as `parts[1].group[0]`; empty for the outermost one.
    fn inside(place: &str, body: &Body) -> Result<Field, ShapeError> {
        let of = |kind: &str, name: &str| match place {
            "" => name.to_owned(),
            place => format!("{place}.{kind}.{name}"),
        };
        Ok(match body {
            Body::Sphere { center, radius } => {
                finite(SHAPE, &of("sphere", "center"), center)?;
                positive(SHAPE, &of("sphere", "radius"), *radius)?;
                Field::Sphere { center: DVec3::from(*center), radius: *radius }
            }
            Body::Capsule { from, to, radii } => {
                finite(SHAPE, &of("capsule", "from"), from)?;
                finite(SHAPE, &of("capsule", "to"), to)?;
                for radius in radii {
                    positive(SHAPE, &of("capsule", "radii"), *radius)?;
                }
                Field::Capsule { from: DVec3::from(*from), to: DVec3::from(*to), radii: *radii }
            }
            Body::Torus { center, axis, major_radius, minor_radius } => {
                finite(SHAPE, &of("torus", "center"), center)?;
                finite(SHAPE, &of("torus", "axis"), axis)?;
                positive(SHAPE, &of("torus", "major_radius"), *major_radius)?;
                positive(SHAPE, &of("torus", "minor_radius"), *minor_radius)?;
                let axis = DVec3::from(*axis)
                    .try_normalize()
                    .ok_or_else(|| invalid(SHAPE, of("torus", "axis"), ShapeFault::NoDirection))?;
                let (major_radius, minor_radius) = (*major_radius, *minor_radius);
                Field::Torus { center: DVec3::from(*center), axis, major_radius, minor_radius }
            }
            Body::Ellipsoid { center, radii, rotation } => {
                finite(SHAPE, &of("ellipsoid", "center"), center)?;
                finite(SHAPE, &of("ellipsoid", "rotation"), rotation)?;
                for radius in radii {
                    positive(SHAPE, &of("ellipsoid", "radii"), *radius)?;
                }
                Field::Ellipsoid {
                    center: DVec3::from(*center),
                    radii: DVec3::from(*radii),
                    to_local: turned(*rotation).transpose(),
                }
            }
            Body::Group(solids) => {
                let list = if place.is_empty() { "parts".to_owned() } else { format!("{place}.group") };
                if solids.is_empty() {
                    return Err(invalid(SHAPE, list, ShapeFault::EmptyGroup));
                }
                let parts = solids.iter().enumerate().map(|(k, solid)| Part::new(&format!("{list}[{k}]"), solid));
                Field::Group(parts.collect::<Result<_, _>>()?)
            }
        })
    }

    /// Signed distance, for ellipsoids and blends to first order.
    pub(super) fn at(&self, p: DVec3) -> f64 {
        match self {
            Field::Sphere { center, radius } => p.distance(*center) - radius,
            Field::Capsule { from, to, radii } => round_cone(p, *from, *to, *radii),
            Field::Torus { center, axis, major_radius, minor_radius } => {
                let d = p - center;
                let height = d.dot(*axis);
                libm::hypot((d - height * axis).length() - major_radius, height) - minor_radius
            }
            Field::Ellipsoid { center, radii, to_local } => {
                let q = *to_local * (p - center);
                let (scaled, gradient) = ((q / *radii).length(), (q / (*radii * *radii)).length());
                if gradient > 0.0 { scaled * (scaled - 1.0) / gradient } else { -radii.min_element() }
            }
            Field::Group(parts) => {
                let first = parts.first().map_or(f64::INFINITY, |part| part.field.at(p));
                parts.iter().skip(1).fold(first, |before, part| {
                    let here = part.field.at(p);
                    match part.operation {
                        Operation::Union => smooth_min(before, here, part.blend),
                        Operation::Difference => -smooth_min(-before, here, part.blend),
                        Operation::Intersection => -smooth_min(-before, -here, part.blend),
                    }
                })
            }
        }
    }

    /// Number of solids that are no groups.
    pub(super) fn solids(&self) -> usize {
        match self {
            Field::Group(parts) => parts.iter().map(|part| part.field.solids()).sum(),
            _ => 1,
        }
    }

    /// A box around the solid: smallest and largest corner.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        match self {
            Field::Sphere { center, radius } => [*center - *radius, *center + *radius],
            Field::Capsule { from, to, radii: [r, s] } => [(*from - *r).min(*to - *s), (*from + *r).max(*to + *s)],
            Field::Torus { center, major_radius, minor_radius, .. } => {
                let reach = major_radius + minor_radius;
                [*center - reach, *center + reach]
            }
            Field::Ellipsoid { center, radii, .. } => {
                let reach = radii.max_element();
                [*center - reach, *center + reach]
            }
            Field::Group(parts) => {
                let [mut low, mut high] = [DVec3::INFINITY, DVec3::NEG_INFINITY];
                for (k, part) in parts.iter().enumerate() {
                    if k == 0 || part.operation == Operation::Union {
                        let [l, h] = part.field.bounds();
                        // A rounded joint adds at most a quarter of its width.
                        low = low.min(l - 0.25 * part.blend);
                        high = high.max(h + 0.25 * part.blend);
                    }
                }
                [low, high]
            }
        }
    }
}

impl Part {
    fn new(place: &str, solid: &Solid) -> Result<Part, ShapeError> {
        if !(solid.blend.is_finite() && solid.blend >= 0.0) {
            return Err(invalid(SHAPE, format!("{place}.blend"), ShapeFault::NotAWidth(solid.blend)));
        }
        Ok(Part { field: Field::inside(place, &solid.body)?, operation: solid.operation, blend: solid.blend })
    }
}

/// The rotation by angles in degrees about x, then y, then z.
fn turned(rotation: [f64; 3]) -> DMat3 {
    let [x, y, z] = rotation.map(|degrees| libm::sincos(degrees.to_radians()));
    let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, x.1, x.0), DVec3::new(0.0, -x.0, x.1));
    let about_y = DMat3::from_cols(DVec3::new(y.1, 0.0, -y.0), DVec3::Y, DVec3::new(y.0, 0.0, y.1));
    let about_z = DMat3::from_cols(DVec3::new(z.1, z.0, 0.0), DVec3::new(-z.0, z.1, 0.0), DVec3::Z);
    about_z * about_y * about_x
}

/// The minimum, with the kink rounded by a parabola where the arguments differ by less than `width`.
fn smooth_min(a: f64, b: f64, width: f64) -> f64 {
    let overlap = width - (a - b).abs();
    if overlap <= 0.0 { a.min(b) } else { a.min(b) - 0.25 * overlap * overlap / width }
}

/// Distance to the hull of two balls.
fn round_cone(p: DVec3, from: DVec3, to: DVec3, [r, s]: [f64; 2]) -> f64 {
    let axis = to - from;
    let length = axis.length();
    let taper = r - s;
    if length <= taper.abs() {
        // One ball contains the other.
        return if r >= s { p.distance(from) - r } else { p.distance(to) - s };
    }
    let axis = axis / length;
    let along = (p - from).dot(axis);
    let across = (p - from - along * axis).length();
    // The cone touches the balls where its normal leans by this sine toward the thinner end.
    let sine = taper / length;
    let cosine = (1.0 - sine * sine).sqrt();
    let foot = along * cosine - across * sine;
    if foot <= 0.0 {
        p.distance(from) - r
    } else if foot >= length * cosine {
        p.distance(to) - s
    } else {
        across * cosine + along * sine - r
    }
}
