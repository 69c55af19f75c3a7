//! Fields of a frame against closed forms, and the ranges that pictures show of them.

use std::f64::consts::PI;

use crate::support::{Random, random_metric, scene, surface};
use glam::{DQuat, DVec3};
use immerse::frames::{Shell, energy};
use immerse::immersion::{
    ConformalFactor, FieldInput, Fields, gaussian_curvatures, mean_curvatures, rimless_frames, spin_of_immersion,
};
use immerse::immersion::{FieldName, FieldValues};
use immerse::mesh::{Mesh, Surface};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::render::{ColorMap, Field, FieldSpread, Legend};
use immerse::spin::SpinStructure;

const STIFFNESS: [f64; 4] = [1.0, 1e-4, 1.0, 0.1];

/// A frame with a metric of its own.
struct State {
    metric: Metric,
    positions: Vec<DVec3>,
    frames: Vec<DQuat>,
    spin: SpinStructure,
}

impl State {
    /// The surface itself, in its own metric.
    fn exact(mesh: &Mesh, positions: Vec<DVec3>) -> State {
        let metric = Metric::new(mesh, lengths_of_positions(mesh, &positions)).unwrap();
        let spin = spin_of_immersion(mesh, &metric, &positions).unwrap();
        let frames =
            rimless_frames(mesh, &metric, &Shell::new(mesh, &metric, &spin, None).expect("a shell"), &positions);
        State { metric, positions, frames, spin }
    }

    fn input(&self) -> FieldInput<'_> {
        FieldInput { metric: &self.metric, positions: &self.positions, frames: &self.frames, spin: &self.spin }
    }

    fn field(&self, mesh: &Mesh, name: FieldName) -> FieldValues {
        Fields::new(std::sync::Arc::new(mesh.clone()), self.metric.clone(), STIFFNESS).of(name, &self.input()).unwrap()
    }
}

fn shape(text: &str) -> Surface {
    let scene = scene(&format!("[mesh]\n{text}"));
    scene.surface().unwrap()
}

fn embedded_shape(text: &str) -> (Mesh, Vec<DVec3>) {
    let Surface { mesh, positions, .. } = shape(text);
    (mesh, positions.unwrap())
}

fn assert_all(values: &[f64], expected: f64, tolerance: f64) {
    for (k, value) in values.iter().enumerate() {
        assert!((value - expected).abs() <= tolerance, "value {k} is {value}, not {expected}");
    }
}

fn doubles(values: &FieldValues) -> Vec<f64> {
    values.all().iter().map(|&value| f64::from(value)).collect()
}

/// Regular n-gons of radius r over each other, m of them, all quadrilaterals cut into two triangles.
fn prism(n: usize, m: usize, radius: f64, step: f64) -> (Mesh, Vec<DVec3>) {
    let place = |k: usize| {
        let angle = 2.0 * PI * (k % n) as f64 / n as f64;
        DVec3::new(radius * angle.cos(), radius * angle.sin(), step * (k / n) as f64)
    };
    let positions = (0..n * m).map(place).collect();
    let mut faces = Vec::new();
    for row in 0..m - 1 {
        for k in 0..n {
            let at = |row: usize, k: usize| (row * n + k % n) as u32;
            let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k + 1), at(row + 1, k)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    (Mesh::from_faces(n * m, &faces).unwrap(), positions)
}

/// An icosahedron: 5 triangles of side a around each vertex.
fn icosahedron(radius: f64) -> (Mesh, Vec<DVec3>) {
    let (mesh, mut positions) = embedded_shape("shape = 'sphere'\nsubdivisions = 1");
    positions.iter_mut().for_each(|p| *p = p.normalize() * radius);
    assert_eq!(mesh.face_count(), 20);
    (mesh, positions)
}

#[test]
fn a_scaled_surface_has_the_scale_as_length_error() {
    let (mesh, positions) = surface(1, 1);
    let mut state = State::exact(&mesh, positions);
    for (scale, ratio) in [(1.0, 0.0), (1.01, 0.01), (0.75, 0.25)] {
        state.positions = state.positions.iter().map(|p| *p * scale).collect();
        let FieldValues::PerFace(errors) = state.field(&mesh, FieldName::LengthError) else { panic!("not per face") };
        assert_all(&errors.iter().map(|&e| f64::from(e)).collect::<Vec<_>>(), ratio, 1e-7);
        state.positions.iter_mut().for_each(|p| *p /= scale);
    }
    // One edge of a triangle of side 1 becomes 1.3: the root mean square over its three edges.
    let triangle = Mesh::from_faces(3, &[[0, 1, 2]]).unwrap();
    let metric = Metric::new(&triangle, vec![1.0; 3]).unwrap();
    let height = (1.0_f64 - 0.65 * 0.65).sqrt();
    state.positions = vec![DVec3::ZERO, DVec3::new(1.3, 0.0, 0.0), DVec3::new(0.65, height, 0.0)];
    let input = FieldInput { metric: &metric, positions: &state.positions, ..state.input() };
    let errors = Fields::new(std::sync::Arc::new(triangle.clone()), metric.clone(), STIFFNESS)
        .of(FieldName::LengthError, &input)
        .unwrap();
    assert_all(&doubles(&errors), 0.3 / 3.0_f64.sqrt(), 1e-7);
}

#[test]
fn gaussian_curvature_is_one_over_the_square_of_the_radius() {
    // Five angles of 60 degrees around each vertex, and a third of five triangles.
    let (mesh, positions) = icosahedron(2.0);
    let state = State::exact(&mesh, positions);
    let side = 2.0 / (2.0 * PI / 5.0).sin();
    let expected = (PI / 3.0) / (5.0 / 3.0 * 3.0_f64.sqrt() / 4.0 * side * side);
    assert_all(&gaussian_curvatures(&mesh, &state.metric), expected, 1e-12);
    assert!((expected - 0.25).abs() < 0.08, "{expected}");

    // Many triangles: 1/r² everywhere but at the vertices of degree five, where areas are those of another tiling.
    let (mesh, positions) = embedded_shape("shape = 'sphere'\nsubdivisions = 32\nradius = 2");
    let values = gaussian_curvatures(&mesh, &State::exact(&mesh, positions).metric);
    let near = values.iter().filter(|k| (**k - 0.25).abs() < 0.01).count();
    assert!(near as f64 > 0.98 * values.len() as f64, "{near} of {}", values.len());

    // Over any metric of a closed surface it integrates to 2π times the Euler characteristic.
    let (mesh, _) = surface(2, 0);
    let metric = random_metric(&mesh, &mut Random::new(3));
    let curvatures = gaussian_curvatures(&mesh, &metric);
    let total: f64 = curvatures.iter().zip(metric.vertex_areas(&mesh)).map(|(k, area)| k * area).sum();
    assert!((total + 4.0 * PI).abs() < 1e-9, "{total}");
}

#[test]
fn flat_surfaces_have_no_gaussian_curvature_even_at_their_boundary() {
    let Surface { mesh, edge_lengths, .. } = shape("shape = 'flat_torus'\ncolumns = 12\nrows = 10");
    let metric = Metric::new(&mesh, edge_lengths.unwrap()).unwrap();
    assert_all(&gaussian_curvatures(&mesh, &metric), 0.0, 1e-10);
    let (mesh, positions) = prism(7, 5, 1.3, 0.4);
    assert_all(&gaussian_curvatures(&mesh, &State::exact(&mesh, positions).metric), 0.0, 1e-10);
    // No interior vertex at all.
    let metric = Metric::new(&Mesh::from_faces(3, &[[0, 1, 2]]).unwrap(), vec![1.0; 3]).unwrap();
    assert_eq!(gaussian_curvatures(&Mesh::from_faces(3, &[[0, 1, 2]]).unwrap(), &metric), [0.0; 3]);
    // A cap of a sphere has at its rim what it has inside.
    let (mesh, positions) = icosahedron(1.0);
    let full = gaussian_curvatures(&mesh, &State::exact(&mesh, positions.clone()).metric)[0];
    let star: Vec<[u32; 3]> = mesh.triangles().into_iter().filter(|face| face.contains(&0)).collect();
    let mut used: Vec<u32> = star.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |v: u32| used.binary_search(&v).unwrap() as u32;
    let cap = Mesh::from_faces(6, &star.iter().map(|face| face.map(number)).collect::<Vec<_>>()).unwrap();
    let places: Vec<DVec3> = used.iter().map(|&v| positions[v as usize]).collect();
    let metric = Metric::new(&cap, lengths_of_positions(&cap, &places)).unwrap();
    assert_all(&gaussian_curvatures(&cap, &metric), full, 1e-12);
}

#[test]
fn mean_curvature_is_one_over_the_radius_and_positive_where_the_front_bulges() {
    // Per vertex and side of a prism: half the bending angle 2π/n, over the side that belongs to it.
    let (n, radius) = (12, 1.5);
    let (mesh, positions) = prism(n, 4, radius, 0.7);
    let side = 2.0 * radius * (PI / n as f64).sin();
    let expected = 0.5 * (2.0 * PI / n as f64) / side;
    assert_all(&mean_curvatures(&mesh, &positions), expected, 1e-12);
    assert!((expected - 0.5 / radius).abs() < 0.01, "half of 1/r");
    let inverted: Vec<DVec3> = positions.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect();
    assert_all(&mean_curvatures(&mesh, &inverted), -expected, 1e-12);

    let (mesh, positions) = embedded_shape("shape = 'sphere'\nsubdivisions = 32\nradius = 2");
    let mut values = mean_curvatures(&mesh, &positions);
    values.sort_by(f64::total_cmp);
    let [low, middle, high] = [0.02, 0.5, 0.98].map(|q| values[(q * values.len() as f64) as usize]);
    assert!((middle - 0.5).abs() < 0.005 && low > 0.48 && high < 0.52, "{low} {middle} {high}");

    let (mesh, _) = prism(5, 3, 1.0, 1.0);
    assert_all(&mean_curvatures(&mesh, &vec![DVec3::ONE; 15]), 0.0, 0.0);
}

#[test]
fn the_conformal_factor_of_scaled_lengths_is_the_logarithm_of_the_scale() {
    let mut random = Random::new(5);
    for (genus, boundaries) in [(0, 0), (1, 0), (0, 2)] {
        let (mesh, positions) = surface(genus, boundaries);
        let first = lengths_of_positions(&mesh, &positions);
        let factor = ConformalFactor::new(&mesh, first.clone()).unwrap();
        assert_all(&factor.of(&mesh, &first), 0.0, 0.0);
        let scaled: Vec<f64> = first.iter().map(|length| 1.7 * length).collect();
        assert_all(&factor.of(&mesh, &scaled), 1.7_f64.ln(), 1e-12);
        // Any u at the vertices comes back.
        let u: Vec<f64> = mesh.vertices().map(|_| random.unit() - 0.5).collect();
        let conformal: Vec<f64> = mesh
            .edges()
            .zip(&first)
            .map(|(e, length)| {
                let [a, b] = mesh.edge_vertices(e);
                length * (0.5 * (u[a.index()] + u[b.index()])).exp()
            })
            .collect();
        for (found, wanted) in factor.of(&mesh, &conformal).iter().zip(&u) {
            assert!((found - wanted).abs() < 1e-12, "{found} instead of {wanted}");
        }
    }
}

#[test]
fn the_energy_density_integrates_to_the_energy() {
    let (mesh, positions) = surface(1, 1);
    let mut state = State::exact(&mesh, positions);
    let mut random = Random::new(7);
    state.frames.iter_mut().for_each(|frame| *frame = (*frame + random.frame() * 0.2).normalize());
    let shell = Shell::new(&mesh, &state.metric, &state.spin, None).expect("a shell");
    let density = doubles(&state.field(&mesh, FieldName::EnergyDensity));
    let total: f64 = density.iter().zip(state.metric.face_areas()).map(|(density, area)| density * area).sum();
    let expected = energy(&shell, STIFFNESS, &state.frames);
    assert!(expected > 1.0 && (total / expected - 1.0).abs() < 1e-6, "{total} instead of {expected}");

    // On the frames of a surface in its own metric there is bending only (Eq. 15): ε w (2 sin(α/4))²/2 per edge.
    let n = 9;
    let (mesh, positions) = prism(n, 2, 1.0, 0.5);
    let state = State::exact(&mesh, positions);
    let side = 2.0 * (PI / n as f64).sin();
    let weight = 3.0 * 0.25 / (2.0 * 0.5 * side);
    let per_edge = 0.5 * 1e-4 * weight * (2.0 * (PI / n as f64 / 2.0).sin()).powi(2);
    // Half of one such edge belongs to each face of half a rectangle.
    let expected = 0.5 * per_edge / (0.25 * side);
    assert_all(&doubles(&state.field(&mesh, FieldName::EnergyDensity)), expected, 1e-6 * expected);
}

#[test]
fn the_bending_angle_of_a_prism_is_that_between_its_sides() {
    let n = 10;
    let (mesh, positions) = prism(n, 4, 1.0, 0.5);
    let bending = doubles(&State::exact(&mesh, positions).field(&mesh, FieldName::BendingAngle));
    // A face has one bent edge and a diagonal, and a third edge unless that is at the end.
    let angle = 360.0 / n as f64;
    for (f, value) in mesh.faces().zip(bending) {
        let edges = f.halfedges().into_iter().filter(|h| mesh.twin(*h).is_some()).count();
        assert!((value - angle / (edges as f64).sqrt()).abs() < 1e-5, "{value} with {edges} edges");
    }
}

#[test]
fn generators_are_numbered_along_their_strips() {
    let (mesh, positions) = surface(1, 0);
    let state = State::exact(&mesh, positions);
    let homology = immerse::spin::Homology::new(&mesh, &state.metric);
    let FieldValues::PerFace(numbers) = state.field(&mesh, FieldName::Generators) else { panic!("not per face") };
    let faces = |k: usize| homology.generators()[k].strip.exits().iter().map(|h| h.face().index());
    assert!(faces(0).all(|f| numbers[f] == 1.0));
    assert!(faces(1).all(|f| numbers[f] == 2.0 || faces(0).any(|g| g == f)));
    let all: std::collections::BTreeSet<usize> = faces(0).chain(faces(1)).collect();
    assert!(numbers.iter().enumerate().all(|(f, number)| all.contains(&f) == (*number > 0.0)));
    assert!(numbers.contains(&0.0) && numbers.contains(&2.0));
}

#[test]
fn fields_are_the_same_bits_on_any_number_of_threads() {
    let (mesh, positions) = embedded_shape("shape = 'sphere'\nsubdivisions = 16");
    let mut state = State::exact(&mesh, positions);
    let mut random = Random::new(11);
    state.positions.iter_mut().for_each(|p| *p += 0.02 * random.vector());
    let names = [
        FieldName::LengthError,
        FieldName::GaussianCurvature,
        FieldName::MeanCurvature,
        FieldName::ConformalFactor,
        FieldName::EnergyDensity,
        FieldName::BendingAngle,
        FieldName::Generators,
    ];
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| names.map(|name| state.field(&mesh, name)))
    };
    assert_eq!(on(1), on(5));
}

#[test]
fn ranges_leave_out_spikes_and_read_well() {
    let range = |name: FieldName, values: &[f32]| {
        let mut spread = FieldSpread::default();
        spread.add(values);
        spread.range(name)
    };
    // 0.01 to 1 and one spike: 98 of 101 are up to 0.98 or 0.99.
    let mut values: Vec<f32> = (1..=100).map(|k| k as f32 / 100.0).collect();
    values.push(1000.0);
    assert_eq!(range(FieldName::LengthError, &values), [0.0, 1.0]);
    assert_eq!(range(FieldName::MeanCurvature, &values), [-1.0, 1.0]);
    assert_eq!(range(FieldName::ConformalFactor, &[0.1, -0.23, 0.0]), [-0.25, 0.25]);
    assert_eq!(range(FieldName::BendingAngle, &[36.0, 36.0]), [0.0, 40.0]);
    assert_eq!(range(FieldName::LengthError, &[0.3, f32::NAN, f32::INFINITY]), [0.0, 0.3]);
    assert_eq!(range(FieldName::LengthError, &[1e-16; 3]), [0.0, 0.01], "one per cent where lengths are exact");
    assert_eq!(range(FieldName::EnergyDensity, &[0.0; 5]), [0.0, 1.0]);
    assert_eq!(range(FieldName::EnergyDensity, &[]), [0.0, 1.0]);
    assert_eq!(range(FieldName::Generators, &[0.0, 4.0, 1.0]), [0.0, 4.0]);

    // A film is the sum of its frames, in any order.
    let spread = |frames: &[&[f32]]| {
        let mut spread = FieldSpread::default();
        frames.iter().for_each(|frame| spread.add(frame));
        spread
    };
    let mut merged = spread(&[&[3.0, -1.0]]);
    merged.merge(&spread(&[&[0.5]]));
    assert_eq!(merged, spread(&[&[0.5], &[3.0, -1.0]]));
    assert_eq!(merged.extremes(), Some([-1.0, 3.0]));
    assert_eq!(FieldSpread::default().extremes(), None);
}

#[test]
fn files_have_ratios_and_legends_have_per_cent() {
    let field = Field::new(FieldName::LengthError, FieldValues::PerFace(vec![0.01]));
    assert_eq!((field.name.as_str(), field.values.all()), ("length_error", [0.01_f32].as_slice()));
    let legend = |field, range| Legend::new(field, ColorMap::Viridis, range, None);
    let error = legend(FieldName::LengthError, [0.0, 0.05]);
    assert_eq!((error.title.as_str(), error.unit.as_str(), error.range), ("length error", "%", [0.0, 5.0]));
    let angle = legend(FieldName::BendingAngle, [0.0, 30.0]);
    assert_eq!((angle.unit.as_str(), angle.range), ("°", [0.0, 30.0]));
    let density = legend(FieldName::EnergyDensity, [0.0, 30.0]);
    assert_eq!((density.unit.as_str(), density.range), ("", [0.0, 30.0]));
}
