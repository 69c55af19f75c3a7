//! Harmonic 1-forms: closed, orthogonal to differentials, and as many as there are generators, also around holes.

use crate::support::{Random, random_metric, surface};
use glam::DVec3;
use immerse::immersion::{Periods, Poisson};
use immerse::mesh::{HalfedgeId, Mesh, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::spin::{Homology, Strip};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

struct Setting {
    mesh: Mesh,
    metric: Metric,
    homology: Homology,
    poisson: Poisson,
    periods: Periods,
}

fn setting(mesh: Mesh, metric: Metric) -> Setting {
    let homology = Homology::new(&mesh, &metric);
    let poisson = Poisson::new(&mesh, &metric, &[]).expect("weights");
    let periods = Periods::new(&mesh, &metric, &homology, &poisson);
    Setting { mesh, metric, homology, poisson, periods }
}

fn largest(vectors: &[DVec3]) -> f64 {
    vectors.iter().map(|v| v.length()).fold(0.0, f64::max)
}

/// The value of a form on a halfedge.
fn along(mesh: &Mesh, form: &[DVec3], h: HalfedgeId) -> DVec3 {
    let e = mesh.edge(h);
    if mesh.edge_halfedge(e) == h { form[e.index()] } else { -form[e.index()] }
}

/// The sum of a closed form along a strip: along the edges of its faces from the tail of one exit to that of the next.
fn period(mesh: &Mesh, form: &[DVec3], strip: &Strip) -> DVec3 {
    strip
        .passages(mesh)
        // From the tail of the entry's twin, its tip, to the tail of the exit.
        .map(|(entry, exit)| if exit == entry.next() { DVec3::ZERO } else { along(mesh, form, entry.next()) })
        .sum()
}

#[test]
fn harmonic_forms_are_a_basis_of_the_cohomology() {
    let mut random = Random::new(1);
    for (genus, boundaries) in [(0, 2), (0, 4), (1, 0), (1, 1), (1, 3), (2, 0), (2, 2)] {
        let (mesh, _) = surface(genus, boundaries);
        let metric = random_metric(&mesh, &mut random);
        let Setting { mesh, metric, homology, poisson, periods } = setting(mesh, metric);
        let betti = 2 * genus + usize::saturating_sub(boundaries, 1);
        assert_eq!(homology.betti(), betti);
        let mut rows = Vec::new();
        for _ in 0..betti.div_ceil(3) + 1 {
            let vectors: Vec<DVec3> = (0..mesh.edge_count()).map(|_| random.vector()).collect();
            let part = periods.harmonic_part(&mesh, &metric, &vectors);
            // Closed,
            for f in mesh.faces() {
                let around: DVec3 = f.halfedges().into_iter().map(|h| along(&mesh, &part, h)).sum();
                assert!(around.length() < 1e-9, "genus {genus}, {boundaries} boundaries: {around}");
            }
            // a projection,
            let twice = periods.harmonic_part(&mesh, &metric, &part);
            assert!(part.iter().zip(&twice).all(|(a, b)| (*a - *b).length() < 1e-9));
            // and orthogonal to all differentials.
            let rest = poisson.remove_exact_part(&mesh, &metric, &part);
            assert!(part.iter().zip(&rest).all(|(a, b)| (*a - *b).length() < 1e-9));
            for axis in 0..3 {
                let generators = homology.generators().iter();
                rows.push(generators.map(|g| period(&mesh, &part, &g.strip)[axis]).collect::<Vec<f64>>());
            }
        }
        // Their periods can be anything.
        let matrix = DMatrix::from_fn(rows.len(), betti, |i, j| rows[i][j]);
        assert_eq!(matrix.rank(1e-6), betti, "genus {genus}, {boundaries} boundaries");
    }
}

/// A cylinder unrolled into the plane: the part around it is harmonic, the part along it is a differential.
#[test]
fn the_cylinder_rolls() {
    for (columns, rows) in [(24, 8), (120, 75)] {
        let cylinder = shapes::cylinder(1.0, 2.0, columns, rows).expect("a cylinder");
        let positions = cylinder.positions.expect("positions");
        let lengths = lengths_of_positions(&cylinder.mesh, &positions);
        let metric = Metric::new(&cylinder.mesh, lengths).expect("triangles");
        let Setting { mesh, metric, homology, periods, .. } = setting(cylinder.mesh, metric);
        let side = 2.0 * (TAU / columns as f64 / 2.0).sin() / (TAU / columns as f64);
        let unrolled: Vec<DVec3> = mesh
            .edges()
            .map(|e| {
                let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
                DVec3::new((a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y) * side, 0.0, b.z - a.z)
            })
            .collect();
        let part = periods.harmonic_part(&mesh, &metric, &unrolled);
        let difference: Vec<DVec3> =
            part.iter().zip(&unrolled).map(|(part, v)| *part - DVec3::new(v.x, 0.0, 0.0)).collect();
        assert!(largest(&difference) < 1e-9, "{}", largest(&difference));
        let around = period(&mesh, &part, &homology.generators()[0].strip);
        assert!((around.length() - TAU * side).abs() < 1e-9, "{around}");
    }
}
