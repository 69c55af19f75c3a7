//! Fields at boundaries, pins and pinch points, where a surface has less around a vertex than elsewhere.

use std::f64::consts::{PI, TAU};

use crate::support::Random;
use glam::{DVec2, DVec3};
use immerse::immersion::FieldName;
use immerse::immersion::{gaussian_curvatures, mean_curvatures, pinch_points};
use immerse::mesh::{Mesh, VertexId, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::render::FieldSpread;

/// A disk of rings, mapped by its polar coordinates; vertices are moved about in it by a share of their distance, those
/// of the boundary along it.
fn mapped_disk(rings: usize, noise: f64, map: impl Fn(f64, f64) -> DVec3) -> (Mesh, Vec<DVec3>) {
    let surface = shapes::disk(1.0, rings).unwrap();
    let (mesh, flat) = (surface.mesh, surface.positions.unwrap());
    let mut random = Random::new(3);
    let place = |v: VertexId| {
        let shift = (random.vector().truncate() * noise / rings as f64).clamp_length_max(noise / rings as f64);
        let p = flat[v.index()].truncate();
        let moved = p + shift;
        let moved = if mesh.is_boundary_vertex(v) { moved.normalize() } else { moved };
        let angle = libm::atan2(moved.y, moved.x);
        map(moved.length(), angle)
    };
    let positions = mesh.vertices().map(place).collect();
    (mesh, positions)
}

fn hemisphere(radius: f64, rings: usize, noise: f64) -> (Mesh, Vec<DVec3>) {
    mapped_disk(rings, noise, |r, angle| {
        let (sine, cosine) = (r * PI / 2.0).sin_cos();
        DVec3::new(sine * angle.cos(), sine * angle.sin(), cosine) * radius
    })
}

/// Rings around an axis: radius and height as functions of a parameter from 0 to 1, with rows staggered and uneven.
fn revolved(columns: usize, rows: usize, noise: f64, profile: impl Fn(f64) -> DVec2) -> (Mesh, Vec<DVec3>) {
    let mesh = shapes::cylinder(1.0, 1.0, columns, rows).unwrap();
    let flat = mesh.positions.unwrap();
    let mut random = Random::new(9);
    let place = |v: VertexId| {
        let p = flat[v.index()];
        let inside = if mesh.mesh.is_boundary_vertex(v) { 0.0 } else { 1.0 };
        let angle = libm::atan2(p.y, p.x) + noise * random.vector().x * TAU / columns as f64;
        let profile = profile((p.z + 0.5 + inside * noise * random.vector().x / rows as f64).clamp(0.0, 1.0));
        DVec3::new(profile.x * angle.cos(), profile.x * angle.sin(), profile.y)
    };
    let positions = mesh.mesh.vertices().map(place).collect();
    (mesh.mesh, positions)
}

/// The largest deviation at the boundary, and inside.
fn deviations(mesh: &Mesh, values: &[f64], expected: impl Fn(VertexId) -> f64) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for v in mesh.vertices() {
        let slot = &mut largest[usize::from(!mesh.is_boundary_vertex(v))];
        *slot = slot.max((values[v.index()] - expected(v)).abs());
    }
    largest
}

#[test]
fn an_open_cylinder_has_a_mean_curvature_of_one_half_at_its_rim_too() {
    for (columns, rows, height) in [(40, 12, 2.0), (24, 2, 0.5), (64, 5, 1.0), (31, 30, 6.0)] {
        let surface = shapes::cylinder(1.0, height, columns, rows).unwrap();
        let (mesh, positions) = (surface.mesh, surface.positions.unwrap());
        let [rim, inside] = deviations(&mesh, &mean_curvatures(&mesh, &positions), |_| 0.5);
        assert!(rim < 0.01 && inside < 0.01, "{columns} x {rows}: {rim} at the rim, {inside} inside");
    }
    for noise in [0.1, 0.25] {
        let (mesh, positions) = revolved(48, 16, noise, |t| DVec2::new(1.0, 2.0 * t));
        let [rim, inside] = deviations(&mesh, &mean_curvatures(&mesh, &positions), |_| 0.5);
        assert!(rim < 2.0 * inside, "noise {noise}: {rim} at the rim, {inside} inside");
    }
}

#[test]
fn a_hemisphere_has_one_over_its_radius_at_its_rim_too() {
    for rings in [8, 16, 32] {
        let (mesh, positions) = hemisphere(2.0, rings, 0.0);
        let values = mean_curvatures(&mesh, &positions);
        let [rim, _] = deviations(&mesh, &values, |_| 0.5);
        assert!(rim < 0.05, "{rings} rings: {rim}");
        let metric = Metric::new(&mesh, lengths_of_positions(&mesh, &positions)).unwrap();
        let [rim, _] = deviations(&mesh, &gaussian_curvatures(&mesh, &metric), |_| 0.25);
        assert!(rim < 0.06, "{rings} rings: Gaussian curvature is {rim} off");
    }
    let (mesh, positions) = hemisphere(2.0, 24, 0.2);
    let [rim, inside] = deviations(&mesh, &mean_curvatures(&mesh, &positions), |_| 0.5);
    assert!(rim < 1.5 * inside.max(0.05), "uneven triangles: {rim} at the rim, {inside} inside");
}

/// Where curvature changes toward the boundary, so do the values there: errors go down with the square of the length of
/// edges on even triangles.
#[test]
fn values_at_the_rim_converge() {
    let cone = |t: f64| DVec2::new(1.0 + t, t);
    let catenoid = |t: f64| DVec2::new((2.0 * t - 1.0).cosh(), 2.0 * t - 1.0);
    let bowl = |t: f64| DVec2::new(0.5 + t, (0.5 + t) * (0.5 + t));
    let at_rim = |columns: usize, rows: usize, profile: fn(f64) -> DVec2, curvature: fn(DVec3) -> f64| {
        let (mesh, positions) = revolved(columns, rows, 0.0, profile);
        let values = mean_curvatures(&mesh, &positions);
        deviations(&mesh, &values, |v| curvature(positions[v.index()]))[0]
    };
    // Half of 1/r times the cosine of the slope.
    let of_cone: fn(DVec3) -> f64 = |p| 0.5 / (p.truncate().length() * 2.0_f64.sqrt());
    // z = r²: (2/(1 + 4r²)^1.5 + 2/(1 + 4r²)^0.5)/2, bulging to the front, which is outside.
    let of_bowl: fn(DVec3) -> f64 = |p| {
        let slope = 1.0 + 4.0 * p.truncate().length_squared();
        slope.powf(-1.5) + slope.powf(-0.5)
    };
    type Profile = (&'static str, fn(f64) -> DVec2, fn(DVec3) -> f64);
    let profiles: [Profile; 3] = [("cone", cone, of_cone), ("catenoid", catenoid, |_| 0.0), ("bowl", bowl, of_bowl)];
    for (name, profile, curvature) in profiles {
        let sign = {
            let (mesh, positions) = revolved(32, 8, 0.0, profile);
            let inner = mesh.vertices().find(|&v| !mesh.is_boundary_vertex(v)).unwrap();
            mean_curvatures(&mesh, &positions)[inner.index()] * curvature(positions[inner.index()])
        };
        assert!(sign >= 0.0 || name == "catenoid", "{name}: the front is the outer side");
        let [coarse, fine] = [(32, 8), (128, 32)].map(|(columns, rows)| at_rim(columns, rows, profile, curvature));
        assert!(fine < 1e-4 || (fine < coarse / 6.0 && fine < 0.02), "{name}: {coarse}, then {fine}");
    }
}

#[test]
fn what_is_flat_has_no_curvature_up_to_its_boundary() {
    for noise in [0.0, 0.3] {
        let (mesh, positions) = mapped_disk(9, noise, |r, angle| DVec3::new(r * angle.cos(), r * angle.sin(), 0.0));
        assert!(mean_curvatures(&mesh, &positions).iter().all(|value| *value == 0.0), "noise {noise}");
        let metric = Metric::new(&mesh, lengths_of_positions(&mesh, &positions)).unwrap();
        let [rim, inside] = deviations(&mesh, &gaussian_curvatures(&mesh, &metric), |_| 0.0);
        assert!(rim < 1e-9 && inside < 1e-9, "noise {noise}: {rim}, {inside}");
    }
    // Without an interior vertex.
    let mesh = Mesh::from_faces(4, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let square = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
    assert_eq!(mean_curvatures(&mesh, &square), [0.0; 4]);
}

#[test]
fn curvatures_at_pinch_points_and_degenerate_vertices_are_numbers() {
    // A star over a curve like an 8, and one that is collapsed.
    let count = 12;
    let faces: Vec<[u32; 3]> = (0..count).map(|k| [0, 1 + k, 1 + (k + 1) % count]).collect();
    let mesh = Mesh::from_faces(count as usize + 1, &faces).unwrap();
    let ring = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(count);
        DVec3::new(angle.sin(), 0.6 * (2.0 * angle).sin(), 0.8)
    };
    let positions: Vec<DVec3> = std::iter::once(DVec3::ZERO).chain((0..count).map(ring)).collect();
    assert_eq!(pinch_points(&mesh, &positions), [VertexId(0)], "the star is figure-8");
    assert!(mean_curvatures(&mesh, &positions).iter().all(|value| value.is_finite()));
    let collapsed = vec![DVec3::ONE; positions.len()];
    assert_eq!(mean_curvatures(&mesh, &collapsed), vec![0.0; positions.len()]);
}

/// Curvatures have a unit; colours must not call them rounding because it is small.
#[test]
fn ranges_of_curvatures_follow_the_unit_of_length() {
    let range = |name: FieldName, value: f32| {
        let mut spread = FieldSpread::default();
        spread.add(&[value, -value]);
        spread.range(name)
    };
    for unit in [1e-9_f32, 1.0, 1e7] {
        assert!((range(FieldName::MeanCurvature, 0.5 / unit)[1] * unit - 0.5).abs() < 1e-6);
        assert!((range(FieldName::GaussianCurvature, 0.5 / (unit * unit))[1] * unit * unit - 0.5).abs() < 1e-6);
    }
    assert_eq!(range(FieldName::ConformalFactor, 1e-16), [-1.0, 1.0]);
    assert_eq!(range(FieldName::MeanCurvature, 0.0), [-1.0, 1.0]);
}
