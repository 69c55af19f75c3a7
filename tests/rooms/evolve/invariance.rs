//! What must not matter does not: signs of frames, reference edges, numbering, rigid motion, scale.

use crate::support::{Random, diameter, distance_up_to_rigid_motion, random_metric, scene, surface};
use glam::{DMat3, DQuat, DVec3};
use immerse::algebra::Complex;
use immerse::evolve::{Frame, Phase, Schedule, TimeStep, Unobserved};
use immerse::frames::{Method, Shell, StepOptions, Stepper, random_frames};
use immerse::immersion::{Periods, Poisson, edge_vectors, frames_of_edge_vectors, frames_of_positions, rims};
use immerse::mesh::{EdgeId, Mesh, Surface};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::spin::{Homology, SpinStructure};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Another description of a surface: face `f` of the old one is face `faces[f]` of the new one, with its corner
/// `corners[f]` in front, and its frame has the other sign if `signs[f]`; vertex `v` becomes `vertices[v]`.
struct Change {
    vertices: Vec<usize>,
    faces: Vec<usize>,
    corners: Vec<usize>,
    signs: Vec<bool>,
}

impl Change {
    fn none(mesh: &Mesh) -> Change {
        let faces = mesh.face_count();
        Change {
            vertices: (0..mesh.vertex_count()).collect(),
            faces: (0..faces).collect(),
            corners: vec![0; faces],
            signs: vec![false; faces],
        }
    }

    fn mesh(&self, mesh: &Mesh) -> Mesh {
        let mut faces = vec![[0; 3]; mesh.face_count()];
        for f in mesh.faces() {
            let corners = mesh.corners(f).map(|v| self.vertices[v.index()] as u32);
            faces[self.faces[f.index()]] = std::array::from_fn(|k| corners[(k + self.corners[f.index()]) % 3]);
        }
        Mesh::from_faces(mesh.vertex_count(), &faces).expect("the same surface")
    }

    /// Per old edge: the new one, and whether it now has the other direction.
    fn edges(&self, old: &Mesh, new: &Mesh) -> Vec<(EdgeId, bool)> {
        let ends: HashMap<[usize; 2], EdgeId> =
            new.edges().map(|e| (new.edge_vertices(e).map(|v| v.index()), e)).collect();
        let find = |e| {
            let [a, b] = old.edge_vertices(e).map(|v| self.vertices[v.index()]);
            ends.get(&[a, b]).map_or_else(|| (ends[&[b, a]], true), |&edge| (edge, false))
        };
        old.edges().map(find).collect()
    }

    fn positions(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let mut moved = vec![DVec3::ZERO; positions.len()];
        positions.iter().zip(&self.vertices).for_each(|(p, &v)| moved[v] = *p);
        moved
    }

    fn lengths(&self, edges: &[(EdgeId, bool)], lengths: &[f64]) -> Vec<f64> {
        let mut moved = vec![0.0; lengths.len()];
        lengths.iter().zip(edges).for_each(|(l, (e, _))| moved[e.index()] = *l);
        moved
    }
}

/// A frame field with all it depends on.
struct State {
    mesh: Mesh,
    metric: Metric,
    spin: SpinStructure,
    frames: Vec<DQuat>,
}

impl State {
    /// Random frames, so that there are rims everywhere.
    fn random(genus: usize, boundaries: usize) -> State {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut Random::new(1));
        let homology = Homology::new(&mesh, &metric);
        let class = vec![true; homology.betti()];
        let spin = SpinStructure::of_class(&mesh, &metric, &homology, &class).expect("a class");
        let frames = random_frames(mesh.face_count(), 2);
        State { mesh, metric, spin, frames }
    }

    /// The same in other words. A new reference edge at direction z turns the coordinates of a face by 1/z,
    /// φ' = φ/z, which takes λ' = c λ with conj(c)² = z (Sec. 3); τ follows.
    fn changed(&self, change: &Change) -> State {
        let mesh = change.mesh(&self.mesh);
        let edges = change.edges(&self.mesh, &mesh);
        let metric = Metric::new(&mesh, change.lengths(&edges, self.metric.edge_lengths())).expect("the same metric");
        let factor: Vec<Complex> = self
            .mesh
            .faces()
            .map(|f| {
                let z = self.metric.direction(f.halfedge(change.corners[f.index()]));
                let c = if z == Complex::ONE { z } else { Complex::from_angle(-0.5 * z.angle()) };
                if change.signs[f.index()] { -c } else { c }
            })
            .collect();
        let mut frames = self.frames.clone();
        for f in self.mesh.faces() {
            frames[change.faces[f.index()]] = factor[f.index()] * self.frames[f.index()];
        }
        let mut transports = vec![Complex::ONE; edges.len()];
        for e in self.mesh.interior_edges() {
            let h = self.mesh.edge_halfedge(e);
            let (i, j) = (h.face().index(), self.mesh.twin(h).expect("interior").face().index());
            let tau = factor[j] * self.spin.across(&self.mesh, h) * factor[i].conjugate();
            let (edge, _) = edges[e.index()];
            // Named from the other face where that one comes first now.
            let same_side = mesh.edge_halfedge(edge).face().index() == change.faces[i];
            transports[edge.index()] = if same_side { tau } else { tau.conjugate() };
        }
        let spin = SpinStructure::from_transports(&mesh, transports).expect("unit transports");
        State { mesh, metric, spin, frames }
    }

    /// The step of a simulation, three times: positions and rims.
    fn relax(mut self, method: Method) -> (Vec<DVec3>, HashSet<EdgeId>) {
        let shell = Shell::new(&self.mesh, &self.metric, &self.spin, None).expect("a shell");
        let homology = Homology::new(&self.mesh, &self.metric);
        let poisson = Poisson::new(&self.mesh, &self.metric, &[]).expect("weights");
        let periods = Periods::new(&self.mesh, &self.metric, &homology, &poisson);
        let mut stepper = Stepper::new(&shell);
        let dt = if method == Method::Gradient { 0.01 } else { 3.0 };
        let options = StepOptions { method, stiffness: [1.0, 0.1, 0.8, 0.3], crease: 1.0, dt, solver_tolerance: 1e-14 };
        let mut positions = Vec::new();
        for _ in 0..3 {
            assert!(stepper.advance(&shell, &options, &mut self.frames).converged);
            let mut vectors = edge_vectors(&self.mesh, &self.metric, &self.frames);
            let harmonic = periods.harmonic_part(&self.mesh, &self.metric, &vectors);
            vectors.iter_mut().zip(harmonic).for_each(|(v, h)| *v -= 0.5 * h);
            self.frames = frames_of_edge_vectors(&self.mesh, &self.metric, &vectors, &self.frames);
            let vectors = edge_vectors(&self.mesh, &self.metric, &self.frames);
            positions = poisson.solve(&self.mesh, &self.metric, &vectors, &[]);
            let target = frames_of_positions(&self.mesh, &self.metric, &positions, &self.frames);
            self.frames.iter_mut().zip(target).for_each(|(q, t)| *q = (*q * 0.7 + t * 0.3).normalize());
        }
        let rims = rims(&shell, &frames_of_positions(&self.mesh, &self.metric, &positions, &self.frames));
        (positions, rims.into_iter().collect())
    }
}

const METHODS: [Method; 3] = [Method::Implicit, Method::Gradient, Method::Newton];

/// The sign of λ and of τ around a face is a choice without meaning: not a bit changes.
#[test]
fn sign_gauge() {
    for (genus, boundaries) in [(1, 0), (0, 2)] {
        let state = State::random(genus, boundaries);
        let mut random = Random::new(3);
        let mut change = Change::none(&state.mesh);
        change.signs.iter_mut().for_each(|sign| *sign = random.bit());
        for method in METHODS {
            let changed = state.changed(&change).relax(method);
            let same = state.changed(&Change::none(&state.mesh)).relax(method);
            assert!(same.1.len() > 10, "{} rims are too few to tell", same.1.len());
            assert_eq!(same, changed, "{method:?}");
        }
    }
}

/// So is the edge at which the coordinates of a face begin, and the numbering of vertices and faces.
#[test]
fn reference_edges_and_numbering() {
    for (genus, boundaries) in [(2, 0), (1, 1)] {
        let state = State::random(genus, boundaries);
        let mut random = Random::new(4);
        let mut change = Change::none(&state.mesh);
        for step in 0..3 {
            if step != 1 {
                change.corners.iter_mut().for_each(|corner| *corner = random.below(3));
            }
            if step > 0 {
                change.vertices = random.shuffled(state.mesh.vertex_count());
                change.faces = random.shuffled(state.mesh.face_count());
            }
            change.signs.iter_mut().for_each(|sign| *sign = random.bit());
            for method in METHODS {
                let changed = state.changed(&change);
                let edges = change.edges(&state.mesh, &changed.mesh);
                let (there, rims_there) = changed.relax(method);
                let (here, rims_here) = state.changed(&Change::none(&state.mesh)).relax(method);
                // Not up to a rigid motion but in place, except for the vertex at which the solve is fixed.
                let far = change.positions(&here).iter().zip(&there).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
                assert!(far < 1e-9 * diameter(&here), "{method:?}: {far}");
                assert_eq!(rims_here.iter().map(|e| edges[e.index()].0).collect::<HashSet<_>>(), rims_there);
            }
        }
    }
}

/// A surface with handles, a deformed map of it to start from, and a metric of neither.
fn deformed(genus: usize, boundaries: usize) -> Surface {
    let (mesh, mut positions) = surface(genus, boundaries);
    let mut random = Random::new(5);
    positions.iter_mut().for_each(|p| *p += 0.05 * random.vector());
    let lengths = lengths_of_positions(&mesh, &positions);
    positions.iter_mut().for_each(|p| *p = DVec3::new(1.3 * p.x, p.y + 0.2 * p.x, 0.9 * p.z));
    Surface { mesh, positions: Some(positions), coordinates: None, edge_lengths: Some(lengths), repairs: Vec::new() }
}

/// A few steps of all kinds from the given map.
fn relax(surface: &Surface) -> Arc<Frame> {
    let scene = scene("[spin]\nclass = 'immersion'\n[start]\nfrom = 'mesh'");
    let mut simulation = scene.simulation_of(surface.clone()).expect("a simulation");
    let mut phases = Schedule::default().phases().to_vec();
    phases.truncate(4);
    for (k, phase) in phases.iter_mut().enumerate() {
        let accelerate = k == 3;
        let tight = Phase { solver_tolerance: 1e-14, tolerance_radians: 1e-20, ..*phase };
        *phase = Phase { dt: TimeStep::FaceAreas(3.0), min_steps: 3, max_steps: 3, accelerate, ..tight };
    }
    simulation.change_phases(|own| own.clone_from(&phases)).expect("phases");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    assert_eq!(frame.report.cursor.steps, 12);
    frame
}

#[track_caller]
fn assert_same(a: &Frame, b: &Frame, positions_a: &[DVec3]) {
    let distance = distance_up_to_rigid_motion(positions_a, &b.positions);
    assert!(distance < 1e-9 * diameter(positions_a), "{distance}");
    let (a, b) = (&a.report, &b.report);
    for (x, y) in [
        (a.l2_length_error, b.l2_length_error),
        (a.max_length_error, b.max_length_error),
        (a.median_length_error, b.median_length_error),
        (a.p95_length_error, b.p95_length_error),
        (a.period_error, b.period_error),
    ] {
        assert!((x - y).abs() < 1e-9, "{a:?}\n{b:?}");
    }
    assert!((a.energy - b.energy).abs() < 1e-9 * a.energy);
    assert_eq!((a.rims, a.pinch_points), (b.rims, b.pinch_points));
}

#[test]
fn whole_relaxation_under_relabelling() {
    for (genus, boundaries) in [(1, 0), (2, 1)] {
        let surface = deformed(genus, boundaries);
        let here = relax(&surface);
        assert!(here.report.l2_length_error > 1e-4, "nothing is left to compare");
        let mut random = Random::new(6);
        let mut change = Change::none(&surface.mesh);
        change.corners.iter_mut().for_each(|corner| *corner = random.below(3));
        change.vertices = random.shuffled(surface.mesh.vertex_count());
        change.faces = random.shuffled(surface.mesh.face_count());
        let mesh = change.mesh(&surface.mesh);
        let edges = change.edges(&surface.mesh, &mesh);
        let there = relax(&Surface {
            coordinates: None,
            positions: surface.positions.as_ref().map(|p| change.positions(p)),
            edge_lengths: surface.edge_lengths.as_ref().map(|l| change.lengths(&edges, l)),
            mesh,
            repairs: Vec::new(),
        });
        assert_same(&here, &there, &change.positions(&here.positions));
    }
}

#[test]
fn whole_relaxation_under_rigid_motion_and_scale() {
    let surface = deformed(2, 1);
    let here = relax(&surface);
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 2.0);
    for scale in [1.0, 1000.0, 1e-3] {
        let mut other = surface.clone();
        let place = |p: &mut DVec3| *p = scale * (turn * *p + DVec3::new(3.0, -4.0, 5.0));
        other.positions.iter_mut().flatten().for_each(place);
        other.edge_lengths.iter_mut().flatten().for_each(|l| *l *= scale);
        let there = relax(&other);
        let scaled: Vec<DVec3> = here.positions.iter().map(|p| scale * *p).collect();
        assert_same(&here, &there, &scaled);
        assert_eq!(here.report.spin_class, there.report.spin_class);
        assert!((there.report.rim_length - scale * here.report.rim_length).abs() <= 1e-9 * scale);
    }
}
