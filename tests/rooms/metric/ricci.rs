//! Discrete conformal scaling: Newton to prescribed curvature, and the flow in time.

use crate::support::Random;
use immerse::mesh::shapes::{Body, Grid, Operation, PolyhedronSource, Solid};
use immerse::mesh::{EdgeId, Mesh, Surface, VertexId, shapes};
use immerse::metric::{
    BoundaryCondition, Conformal, CurvatureTarget, InteriorCurvature, Metric, MetricError, Region, RicciFlow,
    lengths_of_positions, uniformize,
};
use std::f64::consts::{PI, TAU};

fn lengths(surface: &Surface) -> Vec<f64> {
    match (&surface.edge_lengths, &surface.positions) {
        (Some(lengths), _) => lengths.clone(),
        (None, positions) => lengths_of_positions(&surface.mesh, positions.as_ref().expect("positions")),
    }
}

fn polyhedron(name: &str, subdivisions: usize) -> Surface {
    shapes::polyhedron(&PolyhedronSource::Named(name.to_owned()), subdivisions).expect("a polyhedron")
}

fn flat_torus(columns: usize, rows: usize) -> Surface {
    shapes::flat_torus([1.0, 0.0], [0.0, 1.0], columns, rows, Grid::Equilateral).expect("a flat torus")
}

/// A body with a head, long ears, a tail and paws: curvature far from that of the sphere.
fn hare(edge_length: f64) -> Surface {
    let part = |body, blend| Solid { body, operation: Operation::Union, blend };
    let capsule = |from, to, radii| Body::Capsule { from, to, radii };
    let mut parts = vec![
        part(Body::Ellipsoid { center: [0.0; 3], radii: [1.0, 0.7, 0.8], rotation: [0.0; 3] }, 0.0),
        part(Body::Sphere { center: [1.0, 0.0, 0.8], radius: 0.45 }, 0.3),
        part(Body::Sphere { center: [-1.0, 0.0, 0.1], radius: 0.2 }, 0.1),
    ];
    for side in [1.0, -1.0] {
        parts.push(part(capsule([0.9, 0.2 * side, 1.1], [0.5, 0.35 * side, 2.1], [0.16, 0.1]), 0.1));
        parts.push(part(capsule([0.5, 0.4 * side, -0.4], [0.9, 0.45 * side, -0.9], [0.2, 0.15]), 0.1));
    }
    shapes::implicit(&part(Body::Group(parts), 0.0), edge_length).expect("a hare")
}

/// `ℓ_ij exp((u_i + u_j)/2)`.
fn scaled(mesh: &Mesh, lengths: &[f64], u: &[f64]) -> Vec<f64> {
    mesh.edges()
        .map(|e| {
            let [i, j] = mesh.edge_vertices(e);
            lengths[e.index()] * libm::exp(0.5 * (u[i.index()] + u[j.index()]))
        })
        .collect()
}

/// A third of the areas of the faces around each vertex.
fn vertex_areas(mesh: &Mesh, metric: &Metric) -> Vec<f64> {
    let mut areas = vec![0.0; mesh.vertex_count()];
    for f in mesh.faces() {
        for v in mesh.corners(f) {
            areas[v.index()] += metric.area(f) / 3.0;
        }
    }
    areas
}

fn curvatures(mesh: &Mesh, lengths: &[f64]) -> (Metric, Vec<f64>) {
    let metric = Metric::new(mesh, lengths.to_vec()).expect("a metric");
    let curvature = mesh.vertices().map(|v| metric.curvature(mesh, v)).collect();
    (metric, curvature)
}

fn furthest(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// `ℓ_il ℓ_jk / ℓ_ki ℓ_lj` around each interior edge ij: what discrete conformal equivalence preserves.
fn cross_ratios(mesh: &Mesh, lengths: &[f64]) -> Vec<f64> {
    let length = |h| lengths[mesh.edge(h).index()];
    mesh.interior_edges()
        .filter_map(|e| mesh.edge_sides(e))
        .map(|[h, t]| length(t.next()) * length(h.next()) / (length(h.previous()) * length(t.previous())))
        .collect()
}

fn assert_constant_curvature(name: &str, surface: &Surface, conformal: &Conformal) {
    let mesh = &surface.mesh;
    let (metric, curvature) = curvatures(mesh, &conformal.edge_lengths);
    let density = TAU * mesh.euler_characteristic() as f64 / metric.total_area();
    let wanted: Vec<f64> = vertex_areas(mesh, &metric).iter().map(|area| density * area).collect();
    let off = furthest(&curvature, &wanted);
    assert!(off < 1e-10, "{name}: curvature off by {off:e}");
    assert!(conformal.residual < 1e-10, "{name}: reported {:e}", conformal.residual);
}

#[test]
fn curvature_in_proportion_to_area_on_every_genus() {
    let surfaces = [
        ("torus", shapes::torus(1.0, 0.5, 63, 48).expect("a torus"), 2),
        ("thin ring", shapes::torus(1.0, 0.9, 48, 40).expect("a torus"), 3),
        ("icosahedron", polyhedron("icosahedron", 1), 0),
        ("cube", polyhedron("cube", 6), 3),
        ("unequal triangles", shapes::uv_sphere(1.0, 10, 40).expect("a sphere"), 3),
        ("hare", hare(0.1), 6),
        ("genus two", polyhedron("genus_two", 6), 3),
        ("negative corners", polyhedron("genus_two_saddle", 8), 2),
    ];
    for (name, surface, most_iterations) in surfaces {
        let (mesh, before) = (&surface.mesh, lengths(&surface));
        let result = uniformize(mesh, &before, &CurvatureTarget::default()).expect(name);
        assert_constant_curvature(name, &surface, &result);
        assert!(result.iterations <= most_iterations, "{name}: {} Newton steps", result.iterations);
        assert_eq!(result.flips, 0, "{name}");

        let areas = [&before, &result.edge_lengths].map(|l| curvatures(mesh, l).0.total_area());
        assert!((areas[1] / areas[0] - 1.0).abs() < 1e-12, "{name}: the area changed, {areas:?}");
        let formula = scaled(mesh, &before, &result.log_scale);
        let ratios = [&before, &result.edge_lengths].map(|l| cross_ratios(mesh, l));
        for (e, (length, formula)) in result.edge_lengths.iter().zip(&formula).enumerate() {
            assert!((length / formula - 1.0).abs() < 1e-14, "{name}: edge {e}");
        }
        for (before, after) in ratios[0].iter().zip(&ratios[1]) {
            assert!((after / before - 1.0).abs() < 1e-12, "{name}: cross ratio {before} became {after}");
        }
    }
}

/// Chord over the root of the distances of its ends from the axis depends on the longitudes by their difference only,
/// so rows of triangles become flat strips: `1/(R + r cos t)` is the discrete scale factor as well as the smooth one.
#[test]
fn a_torus_of_revolution_unrolls_by_the_distance_from_its_axis() {
    let surface = shapes::torus(1.0, 0.5, 32, 24).expect("a torus");
    let result = uniformize(&surface.mesh, &lengths(&surface), &CurvatureTarget::default()).expect("flat");
    let (_, curvature) = curvatures(&surface.mesh, &result.edge_lengths);
    assert!(curvature.iter().all(|k| k.abs() < 1e-10));
    let positions = surface.positions.expect("positions");
    let product: Vec<f64> =
        positions.iter().zip(&result.log_scale).map(|(p, u)| u + libm::log(libm::hypot(p.x, p.y))).collect();
    assert!(product.iter().all(|p| (p - product[0]).abs() < 1e-9), "not a constant");
}

/// What was scaled conformally from a metric of known curvature is scaled back.
#[test]
fn known_metrics_are_recovered() {
    let mut random = Random::new(5);
    let surfaces = [
        ("flat torus", flat_torus(16, 18)),
        ("icosahedron", polyhedron("icosahedron", 1)),
        ("disk", shapes::disk(1.0, 8).expect("a disk")),
        ("annulus", shapes::annulus(0.5, 1.0, 32, 6).expect("an annulus")),
    ];
    for (name, surface) in surfaces {
        let (mesh, known) = (&surface.mesh, lengths(&surface));
        let (metric, curvature) = curvatures(mesh, &known);
        let mut u: Vec<f64> = (0..mesh.vertex_count()).map(|_| 0.4 * random.unit() - 0.2).collect();
        let turning = CurvatureTarget {
            boundary: BoundaryCondition::TurningAngles(curvature.clone()),
            ..CurvatureTarget::per_vertex(curvature.clone())
        };
        for target in [CurvatureTarget::default(), CurvatureTarget::per_vertex(curvature.clone()), turning] {
            let isometric = target.boundary == BoundaryCondition::Isometric;
            if isometric && target.interior == InteriorCurvature::Constant && !mesh.boundary_loops().is_empty() {
                continue;
            }
            let held = |v: usize| isometric && mesh.is_boundary_vertex(VertexId::new(v));
            (0..u.len()).filter(|&v| held(v)).for_each(|v| u[v] = 0.0);
            let start = scaled(mesh, &known, &u);
            let result = uniformize(mesh, &start, &target).expect(name);
            // The area that is kept is that of the start; what is isometric has no such freedom.
            let area = curvatures(mesh, &start).0.total_area() / metric.total_area();
            let size = if isometric && !mesh.boundary_loops().is_empty() { 1.0 } else { area.sqrt() };
            let wanted: Vec<f64> = known.iter().map(|l| size * l).collect();
            let off = furthest(&wanted, &result.edge_lengths);
            assert!(off < 1e-9, "{name}: a length is off by {off:e}");
            if size == 1.0 {
                let moved = mesh.edges().filter(|&e| mesh.is_boundary_edge(e));
                assert!(moved.map(EdgeId::index).all(|e| result.edge_lengths[e] == start[e]), "{name}: boundary");
            }
        }
    }
}

#[test]
fn a_disk_becomes_a_regular_hexagon() {
    let surface = shapes::disk(1.0, 10).expect("a disk");
    let mesh = &surface.mesh;
    let rim = mesh.boundary_loops().remove(0);
    let mut turning = vec![0.0; mesh.vertex_count()];
    rim.iter().step_by(10).for_each(|&h| turning[mesh.tail(h).index()] = PI / 3.0);
    let target =
        CurvatureTarget { boundary: BoundaryCondition::TurningAngles(turning.clone()), ..CurvatureTarget::default() };
    let result = uniformize(mesh, &lengths(&surface), &target).expect("a hexagon");
    let (metric, curvature) = curvatures(mesh, &result.edge_lengths);
    assert!(furthest(&curvature, &turning) < 1e-10, "flat inside, straight sides, right corners");
    let sides: Vec<f64> = rim.chunks(10).map(|side| side.iter().map(|&h| metric.length(mesh.edge(h))).sum()).collect();
    let hexagon = 1.5 * 3f64.sqrt() * sides[0] * sides[0];
    assert!(sides.iter().all(|s| (s / sides[0] - 1.0).abs() < 1e-9), "{sides:?}");
    assert!((hexagon / metric.total_area() - 1.0).abs() < 1e-9);
}

#[test]
fn curvature_minus_one_decides_the_area() {
    let surface = polyhedron("genus_two", 3);
    let target = CurvatureTarget { interior: InteriorCurvature::Density(-1.0), ..CurvatureTarget::default() };
    let result = uniformize(&surface.mesh, &lengths(&surface), &target).expect("hyperbolic");
    assert_constant_curvature("genus two", &surface, &result);
    let area = curvatures(&surface.mesh, &result.edge_lengths).0.total_area();
    assert!((area - 2.0 * TAU).abs() < 1e-9, "2π |χ| = 4π, not {area}");

    // Inside a boundary that is held there is a scale already.
    let disk = shapes::disk(1.0, 10).expect("a disk");
    let result = uniformize(&disk.mesh, &lengths(&disk), &target).expect("a hyperbolic disk");
    let (metric, curvature) = curvatures(&disk.mesh, &result.edge_lengths);
    let areas = vertex_areas(&disk.mesh, &metric);
    for v in disk.mesh.vertices().filter(|&v| !disk.mesh.is_boundary_vertex(v)).map(VertexId::index) {
        assert!((curvature[v] + areas[v]).abs() < 1e-10);
    }
}

/// Two caps take all the curvature of a sphere, half each, and leave a cylinder; or more than all, and leave a neck.
#[test]
fn curvature_goes_where_regions_say() {
    let surface = shapes::sphere(1.0, 12).expect("a sphere");
    let (mesh, before) = (&surface.mesh, lengths(&surface));
    let positions = surface.positions.as_ref().expect("positions");
    let cap = |side: f64, curvature: f64| Region {
        vertices: mesh.vertices().filter(|v| side * positions[v.index()].z > 0.7).collect(),
        curvature,
    };
    for (upper, lower) in [(TAU, TAU), (TAU, 1.5 * TAU), (0.5 * TAU, TAU)] {
        let regions = vec![cap(1.0, upper), cap(-1.0, lower)];
        let target = CurvatureTarget::per_region(regions.clone());
        let result = uniformize(mesh, &before, &target).expect("two caps");
        let (metric, curvature) = curvatures(mesh, &result.edge_lengths);
        let areas = vertex_areas(mesh, &metric);
        let among = |vertices: &[usize], total: f64| {
            let area: f64 = vertices.iter().map(|&v| areas[v]).sum();
            assert!(
                vertices.iter().all(|&v| (curvature[v] - total * areas[v] / area).abs() < 1e-10),
                "{upper} {lower}"
            );
        };
        let caps = regions.iter().map(|cap| cap.vertices.iter().map(|v| v.index()).collect::<Vec<_>>());
        let rest: Vec<usize> = (0..mesh.vertex_count()).filter(|&v| positions[v].z.abs() <= 0.7).collect();
        caps.zip([upper, lower]).for_each(|(cap, total)| among(&cap, total));
        among(&rest, 2.0 * TAU - upper - lower);

        let mut flow = RicciFlow::new(mesh, &before, &target).expect("a flow");
        let off = furthest(&flow.advance_to(24.0).expect("lengths"), &result.edge_lengths);
        assert!(off < 1e-6, "{upper} {lower}: the flow ends {off:e} away");
    }

    let refuse = |regions: &[Region]| uniformize(mesh, &before, &CurvatureTarget::per_region(regions.to_vec()));
    let whole = Region { vertices: mesh.vertices().collect(), curvature: TAU };
    assert!(matches!(refuse(std::slice::from_ref(&whole)), Err(MetricError::GaussBonnet { .. })));
    let nobody = Region { vertices: vec![VertexId::new(mesh.vertex_count())], curvature: 0.0 };
    let empty = Region { vertices: vec![], curvature: 0.0 };
    for bad in [vec![cap(1.0, 1.0), whole], vec![nobody], vec![empty], vec![cap(1.0, f64::NAN)]] {
        let last = bad.len() - 1;
        let error = refuse(&bad).expect_err("a mistake");
        assert!(matches!(error, MetricError::TargetRegion { region, .. } if region == last), "{error}");
    }
}

#[test]
fn neither_size_nor_numbering_matters() {
    let surface = polyhedron("genus_two", 3);
    let (mesh, before) = (&surface.mesh, lengths(&surface));
    let target = CurvatureTarget::default();
    let result = uniformize(mesh, &before, &target).expect("genus two");

    let larger: Vec<f64> = before.iter().map(|l| 7.0 * l).collect();
    let of_larger = uniformize(mesh, &larger, &target).expect("genus two");
    assert!(furthest(&result.log_scale, &of_larger.log_scale) < 1e-9);

    let mut random = Random::new(3);
    let number = random.shuffled(mesh.vertex_count());
    let order = random.shuffled(mesh.face_count());
    let triangles = mesh.triangles();
    let faces: Vec<[u32; 3]> = order.iter().map(|&f| triangles[f].map(|v| number[v as usize] as u32)).collect();
    let renumbered = Mesh::from_faces(mesh.vertex_count(), &faces).expect("the same surface");
    let mut positions = vec![glam::DVec3::ZERO; mesh.vertex_count()];
    for (v, p) in surface.positions.iter().flatten().enumerate() {
        positions[number[v]] = *p;
    }
    let of_renumbered = uniformize(&renumbered, &lengths_of_positions(&renumbered, &positions), &target).expect("same");
    let back: Vec<f64> = number.iter().map(|&n| of_renumbered.log_scale[n]).collect();
    assert!(furthest(&result.log_scale, &back) < 1e-9);

    // Without a scale of its own, only the mean of u is different.
    let mean_zero = uniformize(mesh, &before, &CurvatureTarget { keep_area: false, ..target }).expect("genus two");
    let shift = result.log_scale[0] - mean_zero.log_scale[0];
    let shifted: Vec<f64> = mean_zero.log_scale.iter().map(|u| u + shift).collect();
    assert!(furthest(&result.log_scale, &shifted) < 1e-9);
    assert!(mean_zero.log_scale.iter().sum::<f64>().abs() < 1e-9);
}

#[test]
fn the_flow_keeps_gauss_bonnet_area_and_conformal_class() {
    for (name, surface) in [
        ("torus", shapes::torus(1.0, 0.5, 32, 24).expect("a torus")),
        ("cube", polyhedron("cube", 4)),
        ("genus two", polyhedron("genus_two", 3)),
    ] {
        let (mesh, before) = (&surface.mesh, lengths(&surface));
        let mut flow = RicciFlow::new(mesh, &before, &CurvatureTarget::default()).expect(name);
        assert_eq!(flow.advance_to(0.0).expect(name), before, "{name}: starts elsewhere");
        let (start, ratios) = (curvatures(mesh, &before).0.total_area(), cross_ratios(mesh, &before));
        let mut distance = f64::INFINITY;
        for time in [0.01, 0.1, 0.3, 1.0, 3.0, 8.0, 16.0] {
            let now = flow.advance_to(time).expect(name);
            let (metric, curvature) = curvatures(mesh, &now);
            let total: f64 = curvature.iter().sum();
            assert!((total - TAU * mesh.euler_characteristic() as f64).abs() < 1e-10, "{name} at {time}: {total}");
            assert!((metric.total_area() / start - 1.0).abs() < 1e-12, "{name} at {time}: area");
            for (before, after) in ratios.iter().zip(cross_ratios(mesh, &now)) {
                assert!((after / before - 1.0).abs() < 1e-12, "{name} at {time}: cross ratio {before} became {after}");
            }
            let left = furthest(&flow.log_scale_at(time).expect(name), &flow.limit().log_scale);
            assert!(left < distance || left < 1e-9, "{name} at {time}: moved away from the limit, to {left:e}");
            distance = left;
        }
        assert!(distance < 1e-9, "{name}: still {distance:e} from the limit");
        assert_constant_curvature(name, &surface, flow.limit());
    }
}

#[test]
fn a_wave_on_a_flat_torus_decays_at_the_smooth_rate() {
    let surface = flat_torus(56, 64);
    let amplitude = 1e-4;
    let u: Vec<f64> = (0..56 * 64).map(|v| amplitude * libm::cos(TAU * (v / 56) as f64 / 64.0)).collect();
    let start = scaled(&surface.mesh, &lengths(&surface), &u);
    let mut flow = RicciFlow::new(&surface.mesh, &start, &CurvatureTarget::default()).expect("a flow");
    let time = 0.5;
    // ½ Δ at 4π², in units of area/4π with area 1.
    let left = libm::exp(-0.5 * TAU * TAU / (4.0 * PI) * time);
    let moved = flow.log_scale_at(time).expect("a metric");
    let wanted: Vec<f64> = u.iter().map(|u| (left - 1.0) * u).collect();
    let off = furthest(&moved, &wanted) / amplitude;
    assert!(off < 3e-3, "off by {off}");
}

/// Starting again in the middle changes nothing, to the accuracy of the integrator.
#[test]
fn the_flow_is_a_semigroup() {
    for (name, surface) in
        [("torus", shapes::torus(1.0, 0.5, 32, 24).expect("a torus")), ("genus two", polyhedron("genus_two", 3))]
    {
        let flow = |start: &[f64]| RicciFlow::new(&surface.mesh, start, &CurvatureTarget::default()).expect(name);
        let start = lengths(&surface);
        let middle = flow(&start).advance_to(0.02).expect(name);
        let (once, twice) = (flow(&start).advance_to(0.1).expect(name), flow(&middle).advance_to(0.08).expect(name));
        let off = once.iter().zip(&twice).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        let moved = once.iter().zip(&middle).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 1e-3 && moved > 0.1, "{name}: off by {off:e} of {moved}");
    }
}

#[test]
fn a_moment_of_the_flow_does_not_depend_on_the_others_nor_on_threads() {
    let surface = polyhedron("genus_two", 2);
    let start = || RicciFlow::new(&surface.mesh, &lengths(&surface), &CurvatureTarget::default()).expect("a flow");
    let mut often = start();
    let times: Vec<f64> = (0..40).map(|k| 0.02 * k as f64).collect();
    let films = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut flow = start();
            times.iter().map(|&t| flow.advance_to(t).expect("lengths")).collect::<Vec<_>>()
        })
    });
    assert_eq!(films[0], films[1]);
    assert_eq!(start().advance_to(times[39]).expect("lengths"), films[0][39]);
    often.advance_to(5.0).expect("lengths");
    assert_eq!(often.advance_to(times[7]).expect("lengths"), films[0][7], "back in time");
}

#[test]
fn what_cannot_be_is_refused() {
    let surface = polyhedron("cube", 2);
    let (mesh, l) = (&surface.mesh, lengths(&surface));
    let n = mesh.vertex_count();
    let refuse = |target: &CurvatureTarget| uniformize(mesh, &l, target).expect_err("a mistake");

    let mut curvature = vec![2.0 * TAU / n as f64; n];
    assert!(uniformize(mesh, &l, &CurvatureTarget::per_vertex(curvature.clone())).is_ok());
    curvature[3] += 0.25;
    let error = refuse(&CurvatureTarget::per_vertex(curvature.clone()));
    let MetricError::GaussBonnet { excess, .. } = error else { panic!("{error}") };
    assert!((excess - 0.25).abs() < 1e-12);
    assert!(error.to_string().contains("2.5"), "{error}");
    assert!(RicciFlow::new(mesh, &l, &CurvatureTarget::per_vertex(curvature.clone())).is_err());

    curvature[5] = 6.5;
    let error = refuse(&CurvatureTarget::per_vertex(curvature));
    assert!(matches!(error, MetricError::TargetCurvature { vertex: 5, .. }), "{error}");
    let error = refuse(&CurvatureTarget::per_vertex(vec![0.0; 3]));
    assert!(matches!(error, MetricError::TargetCount { values: 3, .. }), "{error}");
    let density = |k| CurvatureTarget { interior: InteriorCurvature::Density(k), ..CurvatureTarget::default() };
    assert!(matches!(refuse(&density(-1.0)), MetricError::GaussBonnet { .. }), "a hyperbolic sphere");
    assert!(matches!(refuse(&density(f64::NAN)), MetricError::TargetDensity { .. }));

    let disk = shapes::disk(1.0, 4).expect("a disk");
    let straight = CurvatureTarget {
        boundary: BoundaryCondition::TurningAngles(vec![0.0; disk.mesh.vertex_count()]),
        ..CurvatureTarget::per_vertex(vec![0.0; disk.mesh.vertex_count()])
    };
    let error = uniformize(&disk.mesh, &lengths(&disk), &straight).expect_err("a disk without boundary curvature");
    assert!(matches!(error, MetricError::GaussBonnet { excess, .. } if (excess + TAU).abs() < 1e-12), "{error}");

    let mut two = mesh.triangles();
    two.extend(mesh.triangles().iter().map(|t| t.map(|v| v + n as u32)));
    let two = Mesh::from_faces(2 * n, &two).expect("two cubes");
    let error = uniformize(&two, &vec![1.0; two.edge_count()], &CurvatureTarget::default()).expect_err("two parts");
    assert_eq!(error, MetricError::Disconnected { components: 2 });

    let mut flow = RicciFlow::new(mesh, &l, &CurvatureTarget::default()).expect("a flow");
    for time in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(flow.advance_to(time), Err(MetricError::FlowTime { .. })));
    }
}

/// A flat torus with obtuse triangles, to get a cone of positive curvature and one of negative.
fn sheared_torus(shear: f64, cone: f64) -> (Surface, Vec<f64>) {
    let n = 6;
    let surface = shapes::flat_torus([1.0, 0.0], [shear, 1.0], n, n, Grid::Square).expect("a flat torus");
    let mut curvature = vec![0.0; n * n];
    curvature[0] = cone;
    curvature[n * n / 2 + n / 2] = -cone;
    (surface, curvature)
}

#[test]
fn flips_help_where_triangles_would_degenerate() {
    let (surface, wanted) = sheared_torus(1.0, 2.0);
    let (mesh, before) = (&surface.mesh, lengths(&surface));
    let target = CurvatureTarget::per_vertex(wanted.clone());
    let result = uniformize(mesh, &before, &target).expect("cones");
    assert!(result.flips > 0, "the example needs none");
    assert!(furthest(&curvatures(mesh, &result.edge_lengths).1, &wanted) < 1e-10);
    assert!(result.iterations <= 3, "{}", result.iterations);
    // Another mesh of the same torus and the same vertices: vertex (i, j) of this one, at (i + j, j), is there (i + 3j, j).
    let other = shapes::flat_torus([1.0, 0.0], [-2.0, 1.0], 6, 6, Grid::Square).expect("a flat torus");
    let there: Vec<usize> = (0..36).map(|v| v / 6 * 6 + (v % 6 + 3 * (v / 6)) % 6).collect();
    let mut moved = vec![0.0; 36];
    (0..36).for_each(|v| moved[there[v]] = wanted[v]);
    let same = uniformize(&other.mesh, &lengths(&other), &CurvatureTarget::per_vertex(moved)).expect("cones");
    assert!(same.flips > 0);
    let factors: Vec<f64> = there.iter().map(|&v| same.log_scale[v]).collect();
    assert!(furthest(&factors, &result.log_scale) < 1e-9, "another metric");

    // The flow stays on the mesh.
    let mut flow = RicciFlow::new(mesh, &before, &target).expect("a limit");
    let error = flow.advance_to(20.0).expect_err("a degenerate triangle");
    let MetricError::FlowBlocked { time, face, vertices } = error else { panic!("{error}") };
    assert!(time > 0.0 && time < 20.0);
    assert_eq!(mesh.triangles()[face], vertices);
    assert!(flow.advance_to(0.5 * time).is_ok(), "good until then");

    let (surface, wanted) = sheared_torus(1.5, 3.0);
    let error = uniformize(&surface.mesh, &lengths(&surface), &CurvatureTarget::per_vertex(wanted));
    assert!(matches!(error, Err(MetricError::NotStraight { .. })), "{error:?}");
}
