//! The theorems of the paper about spin structures and rims, on surfaces of genus 0 to 3 with and without boundary.

use crate::support::{Random, random_metric, random_strip, surface};
use glam::DQuat;
use immerse::frames::Shell;
use immerse::immersion::{frames_of_positions, is_figure_8, pinch_points, spin_of_immersion};
use immerse::mesh::VertexId;
use immerse::spin::{ChangeOfMetric, Homology, SpinStructure, Strip};
use std::collections::HashSet;
use std::f64::consts::TAU;

const SURFACES: [(usize, usize); 8] = [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (0, 3), (1, 2), (2, 1)];

fn random_class(count: usize, random: &mut Random) -> Vec<bool> {
    (0..count).map(|_| random.bit()).collect()
}

/// Theorem 4.2: q_f(γ) = q_τ(γ) + Σ s_ij for any generic map, any spin structure, any signs of λ, any strip.
#[test]
fn rim_bits_relate_map_and_spin_structure() {
    let mut random = Random::new(1);
    let (mut figure_8, mut rimmed) = (0, 0);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        for _ in 0..4 {
            let metric = random_metric(&mesh, &mut random);
            let homology = Homology::new(&mesh, &metric);
            let class = random_class(homology.betti(), &mut random);
            let spin = SpinStructure::of_class(&mesh, &metric, &homology, &class).unwrap();
            let shell = Shell::new(&mesh, &metric, &spin, None).expect("a shell");
            // Every vertex anywhere: a map as generic, and as far from an immersion, as can be.
            let positions: Vec<_> = (0..mesh.vertex_count()).map(|_| random.vector()).collect();
            let mut frames = frames_of_positions(&mesh, &metric, &positions, &vec![DQuat::IDENTITY; mesh.face_count()]);
            frames.iter_mut().for_each(|q| *q = if random.bit() { *q } else { -*q });
            let rims: HashSet<_> = immerse::immersion::rims(&shell, &frames).into_iter().collect();

            let mut strips: Vec<Strip> = (0..60).map(|_| random_strip(&mesh, &mut random)).collect();
            strips.extend(homology.generators().iter().map(|g| g.strip.clone()));
            strips.extend(mesh.vertices().filter_map(|v| Strip::around_vertex(&mesh, v)));
            for strip in strips {
                let crossed = strip.exits().iter().filter(|&&h| rims.contains(&mesh.edge(h))).count();
                let extrinsic = is_figure_8(&mesh, &positions, &strip);
                assert_eq!(extrinsic, spin.is_figure_8(&mesh, &metric, &strip) ^ (crossed % 2 == 1));
                figure_8 += usize::from(extrinsic);
                rimmed += crossed;
            }
        }
    }
    assert!(figure_8 > 100 && rimmed > 1000, "the maps were too tame: {figure_8} figure-8 strips, {rimmed} rims");
}

/// Eq. 23: the product of τ around an interior vertex is exp(i Ω/2), which says figure-0 and Ω at once.
#[test]
fn product_around_vertices_is_half_the_curvature() {
    let mut random = Random::new(2);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let homology = Homology::new(&mesh, &metric);
        let class = random_class(homology.betti(), &mut random);
        let spin = SpinStructure::of_class(&mesh, &metric, &homology, &class).unwrap();
        for v in mesh.vertices() {
            let Some(star) = Strip::around_vertex(&mesh, v) else { continue };
            let product = star.transport(|h| spin.across(&mesh, h));
            let half = 0.5 * metric.curvature(&mesh, v);
            assert!((product.re - half.cos()).abs() < 1e-12 && (product.im - half.sin()).abs() < 1e-12);
        }
    }
}

/// There are 2^β₁ spin structures: every class can be had, and two of the same class differ by a sign gauge.
#[test]
fn classes_are_counted_by_the_first_betti_number() {
    let mut random = Random::new(3);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let homology = Homology::new(&mesh, &metric);
        let betti = 2 * genus + boundaries.saturating_sub(1);
        assert_eq!(homology.betti(), betti);
        let mut seen = HashSet::new();
        for bits in 0..1usize << betti {
            let class: Vec<bool> = (0..betti).map(|k| bits >> k & 1 == 1).collect();
            let spin = SpinStructure::of_class(&mesh, &metric, &homology, &class).unwrap();
            assert_eq!(spin.class(&mesh, &metric, &homology), class);
            assert!(spin.figure_8_vertices(&mesh, &metric).is_empty());
            seen.insert(class);
        }
        assert_eq!(seen.len(), 1 << betti);

        // Any other choice of signs with figure-0 vertices is one of these, up to signs of faces.
        let class = random_class(betti, &mut random);
        let first = SpinStructure::of_class(&mesh, &metric, &homology, &class).unwrap();
        let mut other = first.clone();
        for v in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
            if random.bit() {
                let link: Vec<_> = mesh.outgoing(v).map(|h| mesh.edge(h.next())).collect();
                let inner: Vec<_> = link.into_iter().filter(|&e| !mesh.is_boundary_edge(e)).collect();
                other.flip_along(&inner); // the link bounds a disk
            }
        }
        assert!(other.figure_8_vertices(&mesh, &metric).is_empty());
        assert_eq!(other.class(&mesh, &metric, &homology), class);
        let differs: Vec<bool> =
            mesh.edges().map(|e| first.transports()[e.index()] != other.transports()[e.index()]).collect();
        assert!(differs.iter().any(|d| *d));
        assert_is_gauge(&mesh, &differs);
    }
}

/// Finds signs per face whose differences across edges are the given ones.
fn assert_is_gauge(mesh: &immerse::mesh::Mesh, differs: &[bool]) {
    let mut sign = vec![None; mesh.face_count()];
    let mut stack = vec![immerse::mesh::FaceId(0)];
    sign[0] = Some(false);
    while let Some(f) = stack.pop() {
        for h in f.halfedges() {
            let Some(twin) = mesh.twin(h) else { continue };
            let expected = sign[f.index()].map(|s| s ^ differs[mesh.edge(h).index()]);
            match sign[twin.face().index()] {
                None => {
                    sign[twin.face().index()] = expected;
                    stack.push(twin.face());
                }
                there => assert_eq!(there, expected, "the difference is not exact"),
            }
        }
    }
}

/// Each generator's path crosses its own strip once and the others not at all.
#[test]
fn generators_are_dual() {
    let mut random = Random::new(4);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let homology = Homology::new(&mesh, &metric);
        for (k, a) in homology.generators().iter().enumerate() {
            for (l, b) in homology.generators().iter().enumerate() {
                let crossings = a.strip.exits().iter().filter(|&&h| b.path.iter().any(|&e| e == mesh.edge(h))).count();
                assert_eq!(crossings, usize::from(k == l));
            }
        }
        let lengths: Vec<f64> = homology.generators().iter().map(|g| g.length).collect();
        assert!(lengths.is_sorted());
    }
}

#[test]
fn curvature_sums_to_the_euler_characteristic() {
    let mut random = Random::new(5);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let total: f64 = mesh.vertices().map(|v| metric.curvature(&mesh, v)).sum();
        assert!((total - TAU * mesh.euler_characteristic() as f64).abs() < 1e-9);
    }
}

/// The spin structure read off an embedding is that of the embedding (Sec. 4.1.2), and its class is q_f.
#[test]
fn spin_structure_of_an_embedding() {
    for (genus, boundaries) in SURFACES {
        let (mesh, positions) = surface(genus, boundaries);
        assert!(pinch_points(&mesh, &positions).is_empty());
        let metric = random_metric(&mesh, &mut Random::new(6));
        let homology = Homology::new(&mesh, &metric);
        let spin = spin_of_immersion(&mesh, &metric, &positions).unwrap();
        let measured: Vec<bool> =
            homology.generators().iter().map(|g| is_figure_8(&mesh, &positions, &g.strip)).collect();
        assert_eq!(spin.class(&mesh, &metric, &homology), measured);
    }
}

/// A pinched map is refused.
#[test]
fn pinched_map_has_no_spin_structure() {
    let (mesh, mut positions) = surface(0, 0);
    let metric = random_metric(&mesh, &mut Random::new(7));
    let mut random = Random::new(8);
    positions.iter_mut().for_each(|p| *p = random.vector());
    assert!(!pinch_points(&mesh, &positions).is_empty());
    let error = spin_of_immersion(&mesh, &metric, &positions).unwrap_err();
    assert!(error.to_string().contains("no almost immersion"));
    assert!(mesh.vertices().any(|v| v == VertexId(0)));
}

/// App. B.2: carried to another metric, τ is a square root of the new connection and keeps q on every strip
/// (Lemma B.2); the rims of a map are the same in both (Lemma B.3).
#[test]
fn classes_do_not_depend_on_the_metric() {
    let mut random = Random::new(9);
    for (genus, boundaries) in SURFACES {
        let (mesh, _) = surface(genus, boundaries);
        let [before, after] = [0, 1].map(|_| random_metric(&mesh, &mut random));
        let homology = Homology::new(&mesh, &before);
        let class = random_class(homology.betti(), &mut random);
        let spin = SpinStructure::of_class(&mesh, &before, &homology, &class).unwrap();
        let change = ChangeOfMetric::new(&mesh, &spin, &before, &after);
        for e in mesh.interior_edges() {
            let [h, twin] = mesh.edge_sides(e).unwrap();
            let (tau, root) = (change.spin.across(&mesh, h), after.transport(h, twin));
            let [square, r] = [tau * tau, root * root];
            assert!((square.re - r.re).abs() < 1e-12 && (square.im - r.im).abs() < 1e-12, "τ² is not r at {e:?}");
        }
        assert!(change.spin.figure_8_vertices(&mesh, &after).is_empty());
        assert_eq!(change.spin.class(&mesh, &after, &homology), class);
        for strip in (0..60).map(|_| random_strip(&mesh, &mut random)) {
            assert_eq!(change.spin.is_figure_8(&mesh, &after, &strip), spin.is_figure_8(&mesh, &before, &strip));
        }

        // The frames of a map, of which Lemma B.3 is true: that proof needs ⟨λ_j, i τ λ_i⟩ = 0.
        let positions: Vec<_> = (0..mesh.vertex_count()).map(|_| random.vector()).collect();
        let identity = vec![DQuat::IDENTITY; mesh.face_count()];
        let mut frames = frames_of_positions(&mesh, &before, &positions, &identity);
        let rims = immerse::immersion::rims(&Shell::new(&mesh, &before, &spin, None).expect("a shell"), &frames);
        change.carry(&mut frames);
        let there = frames_of_positions(&mesh, &after, &positions, &frames);
        assert_eq!(
            immerse::immersion::rims(&Shell::new(&mesh, &after, &change.spin, None).expect("a shell"), &there),
            rims
        );

        // Polar frames of one map under both metrics are carried into each other when the metrics are close.
        let near = before.edge_lengths().iter().map(|l| l * (1.0 + 1e-7 * random.unit())).collect();
        let near = immerse::metric::Metric::new(&mesh, near).unwrap();
        let mut carried = frames_of_positions(&mesh, &before, &positions, &identity);
        ChangeOfMetric::new(&mesh, &spin, &before, &near).carry(&mut carried);
        let there = frames_of_positions(&mesh, &near, &positions, &carried);
        assert!(carried.iter().zip(&there).all(|(a, b)| (*a - *b).length() < 1e-3));
    }
}
