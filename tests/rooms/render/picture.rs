//! Whole pictures: light that is known, files that are read back, input that is broken.

use std::f64::consts::TAU;

use crate::support::{from_above, seen_from};
use glam::{DVec3, Vec3};
use immerse::{
    advice::Advice,
    render::{
        Camera, Extent, Light, Lights, Lines, Look, Material, Output, Paint, Pattern, PatternKind, Picture, Plane,
        RenderError, Scenery, View, render,
    },
};

/// A torus of revolution around y.
fn torus(columns: u32, rows: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let position = |index: u32| {
        let (u, v) = (index % columns, index / columns);
        let (u, v) = (TAU * f64::from(u) / f64::from(columns), TAU * f64::from(v) / f64::from(rows));
        let radius = 1.0 + 0.4 * libm::cos(v);
        DVec3::new(radius * libm::cos(u), 0.4 * libm::sin(v), -radius * libm::sin(u))
    };
    let id = |u: u32, v: u32| (v % rows) * columns + u % columns;
    let cells = (0..rows).flat_map(|v| (0..columns).map(move |u| (u, v)));
    let triangles = cells
        .flat_map(|(u, v)| [[id(u, v), id(u + 1, v), id(u + 1, v + 1)], [id(u, v), id(u + 1, v + 1), id(u, v + 1)]]);
    ((0..columns * rows).map(position).collect(), triangles.collect())
}

/// A sphere of triangles, poles left open by a hair.
fn sphere() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (columns, rows) = (48, 24);
    let (positions, triangles) = torus(columns, rows);
    let directions: Vec<DVec3> = (0..positions.len() as u32)
        .map(|index| {
            let (u, v) = (f64::from(index % columns), f64::from(index / columns));
            let (u, v) = (TAU * u / f64::from(columns), TAU / 2.0 * (0.002 + 0.996 * v / f64::from(rows - 1)));
            DVec3::new(libm::sin(v) * libm::cos(u), -libm::cos(v), -libm::sin(v) * libm::sin(u))
        })
        .collect();
    // The last row of cells would close the torus.
    let kept = triangles.len() - 2 * columns as usize;
    (directions, triangles[..kept].to_vec())
}

fn shown(positions: &[DVec3], triangles: &[[u32; 3]], look: &Look, output: &Output) -> Picture {
    let camera = Camera::framing(&View::default(), &Extent::of(positions), output).expect("a view");
    let scenery = Scenery { triangles, positions, ..Scenery::default() };
    render(&scenery, &camera, &Lights::default(), look, output).expect("a picture")
}

#[test]
fn a_white_sphere_in_a_white_surround_cannot_be_seen() {
    let (positions, triangles) = sphere();
    let surround = Vec3::splat(0.75);
    let output = Output::new(96, 72, 8).expect("a size");
    let camera = Camera::framing(&View::default(), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    let pbr = |roughness: f32, metallic: f32| Material::Pbr { roughness, metallic };
    let materials = [Material::Studio { gloss: 1.0 }, pbr(0.1, 0.0), pbr(1.0, 0.0), pbr(0.3, 1.0), pbr(1.0, 1.0)];
    for (material, opacity) in materials.into_iter().flat_map(|material| [(material.clone(), 1.0), (material, 0.4)]) {
        let look = Look {
            paint: Paint::Sides([Vec3::ONE; 2]),
            material,
            opacity: [opacity; 2],
            // Rays see no difference between glass and clay: the inside of a glass sphere would be dark.
            occlusion: if opacity < 1.0 { 0.0 } else { 1.0 },
            background: [surround; 2],
            sky: surround,
            ground: surround,
            rim_darkening: 0.0,
            lines: Lines::NONE,
            ..Look::default()
        };
        let film = render(&scenery, &camera, &Lights::new(Vec::new()), &look, &output).expect("a picture");
        assert!(film.beauty()[36 * 96 + 48].w > 0.6, "the sphere is there");
        let bytes = film.srgb_bytes();
        let (least, most) = (bytes.iter().min().copied(), bytes.iter().max().copied());
        // Dithering may move a value by one step.
        assert!(most <= least.map(|byte| byte + 1), "{:?}: from {least:?} to {most:?}", look.material);
    }
}

#[test]
fn the_hollow_of_a_torus_gets_less_ambient_light_and_its_outside_all_of_it() {
    let (positions, triangles) = torus(96, 40);
    let output = Output::new(160, 120, 4).expect("a size");
    let camera = Camera::framing(&seen_from(DVec3::Y, DVec3::NEG_Z), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    let [open, occluded] = [0.0, 2.0].map(|occlusion_reach| {
        let look = Look { lines: Lines::NONE, occlusion_reach, ..Look::default() };
        render(&scenery, &camera, &Lights::new(Vec::new()), &look, &output).expect("a picture")
    });
    // From above, along the horizontal through the middle: the outer flank, then the inner one.
    let row = 60 * 160..60 * 160 + 80;
    let shares: Vec<f32> = row
        .filter(|&pixel| open.beauty()[pixel].w == 1.0)
        .map(|pixel| occluded.beauty()[pixel].x / open.beauty()[pixel].x)
        .collect();
    let (outer, inner) = (shares[2], shares[shares.len() - 2]);
    assert!(outer > 0.999 && (0.4..0.9).contains(&inner), "inner flank {inner}, outer flank {outer}");
}

#[test]
fn a_sheet_throws_a_shadow_on_the_sheet_behind_it() {
    // The key light comes from the upper left, so the shadow lies to the lower right.
    let quad =
        |low: f64, high: f64, z: f64| [[low, low, z], [high, low, z], [high, high, z], [low, high, z]].map(DVec3::from);
    let positions: Vec<DVec3> = quad(-2.0, 2.0, 0.0).into_iter().chain(quad(-0.5, 0.5, 1.0)).collect();
    let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let output = Output::new(120, 120, 4).expect("a size");
    let camera = Camera::framing(&from_above(1.0), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    let look = Look { occlusion_reach: 0.0, ..Look::default() };
    let film = render(&scenery, &camera, &Lights::default(), &look, &output).expect("a picture");
    let at = |x: f64, y: f64| film.beauty()[(60.0 - 30.0 * y) as usize * 120 + (60.0 + 30.0 * x) as usize].x;
    assert!(at(1.0, -1.18) < 0.5 * at(-1.0, 1.18), "shadow {}, light {}", at(1.0, -1.18), at(-1.0, 1.18));
}

#[test]
fn rims_boundary_and_self_intersections_are_drawn_and_hidden_lines_are_not() {
    let quad = |z: f64| [[-2.0, -2.0, z], [2.0, -2.0, z], [2.0, 2.0, z], [-2.0, 2.0, z]].map(DVec3::from);
    let upright = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]].map(DVec3::from);
    let rim = [[-1.5, 1.0, 0.0], [1.5, 1.0, 0.0], [-1.5, -1.0, -0.5], [1.5, -1.0, -0.5]].map(DVec3::from);
    let positions: Vec<DVec3> = quad(0.0).into_iter().chain(upright).chain(rim).collect();
    let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6]];
    let output = Output::new(240, 240, 8).expect("a size");
    let camera = Camera::framing(&from_above(0.9), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery {
        triangles: &triangles,
        positions: &positions,
        rims: &[[7, 8], [9, 10]],
        boundary: &[[0, 1]],
        pinch_points: &[],
        ..Scenery::default()
    };
    let look = Look { occlusion_reach: 0.0, ..Look::default() };
    let film = render(&scenery, &camera, &Lights::new(Vec::new()), &look, &output).expect("a picture");
    let pixel = |x: f64, y: f64| film.beauty()[(120.0 - 54.0 * y) as usize * 240 + (120.0 + 54.0 * x) as usize];
    let sheet = pixel(-1.0, -0.5);
    assert!(pixel(0.7, 1.0).y < 0.3 * sheet.y, "the rim in front is red: {}", pixel(0.7, 1.0));
    assert_eq!(pixel(0.7, -1.0), pixel(0.7, -0.6), "the rim behind the sheet is hidden");
    assert!(pixel(0.0, 0.0).x < 0.6 * sheet.x, "the curve where the sheets cross: {}", pixel(0.0, 0.0));
    assert!(pixel(0.0, -2.0).x < 0.6 * sheet.x, "the boundary: {}", pixel(0.0, -2.0));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let (positions, triangles) = torus(64, 24);
    let look = Look { wireframe: 0.3, ..Look::default() };
    let output = Output::new(200, 150, 4).expect("a size");
    let pictures: Vec<Picture> = [1, 2, 4]
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| shown(&positions, &triangles, &look, &output))
        })
        .into();
    assert!(pictures[0] == pictures[1] && pictures[0] == pictures[2]);
}

#[test]
fn triangles_without_area_or_with_wild_corners_are_left_out_and_counted() {
    let (mut positions, mut triangles) = torus(24, 12);
    let good = triangles.len();
    let first = positions.len() as u32;
    positions.extend([
        DVec3::NAN,
        DVec3::new(f64::INFINITY, 0.0, 0.0),
        DVec3::splat(1e300),
        DVec3::ZERO,
        DVec3::X,
        2.0 * DVec3::X,
    ]);
    triangles.extend([
        [0, 1, first],
        [0, 1, first + 1],
        [0, 1, first + 2],
        [0, 1, 1],
        [first + 3, first + 4, first + 5],
    ]);
    let output = Output::new(64, 48, 4).expect("a size");
    let camera = Camera::framing(&View::default(), &Extent::of(&positions[..first as usize]), &output);
    let scenery = Scenery {
        triangles: &triangles,
        positions: &positions,
        rims: &[[0, first]],
        boundary: &[[first + 1, 0]],
        pinch_points: &[first],
        ..Scenery::default()
    };
    let film = render(&scenery, &camera.expect("a view"), &Lights::default(), &Look::default(), &output);
    let film = film.expect("a picture");
    assert_eq!(film.skipped_triangles(), triangles.len() - good);
    assert!(film.beauty().iter().all(|pixel| pixel.is_finite()));
}

#[test]
fn one_triangle_and_none_make_pictures() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let output = Output::new(40, 30, 8).expect("a size");
    let film = shown(&positions, &[[0, 1, 2]], &Look::default(), &output);
    assert!(film.beauty().iter().any(|pixel| pixel.w == 1.0));
    let film = shown(&positions, &[], &Look::default(), &output);
    assert!(film.beauty().iter().all(|pixel| pixel.w == 0.0));
}

#[test]
fn many_copies_of_one_triangle_make_a_picture() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let film = shown(&positions, &[[0, 1, 2]; 3000], &Look::default(), &Output::new(40, 30, 4).expect("a size"));
    assert!(film.beauty().iter().all(|pixel| pixel.is_finite()));
}

#[test]
fn an_eye_inside_the_surface_sees_its_back_everywhere() {
    let (positions, triangles) = sphere();
    let output = Output::new(64, 48, 4).expect("a size");
    let eye = DVec3::new(0.1, 0.2, 0.1);
    let camera = Camera::look_at(eye, eye + DVec3::X, DVec3::Y, 100_f64.to_radians(), 1.0, &output).expect("a view");
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    let film = render(&scenery, &camera, &Lights::default(), &Look::default(), &output).expect("a picture");
    assert!(film.beauty().iter().all(|pixel| pixel.w == 1.0 && pixel.z > pixel.x), "blue all around");
}

#[test]
fn a_missing_vertex_is_named() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let output = Output::new(8, 8, 1).expect("a size");
    let camera = Camera::framing(&View::default(), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { positions: &positions, rims: &[[0, 1], [1, 9]], ..Scenery::default() };
    let error = render(&scenery, &camera, &Lights::default(), &Look::default(), &output).expect_err("no vertex 9");
    assert!(matches!(error, RenderError::MissingVertex { list: "rim", item: 1, vertex: 9, vertices: 3 }), "{error}");
}

#[test]
fn impossible_values_are_refused_with_a_remedy() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let output = Output::new(8, 8, 1).expect("a size");
    let camera = Camera::framing(&View::default(), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { triangles: &[[0, 1, 2]], positions: &positions, ..Scenery::default() };
    let drawn = |look: Look| render(&scenery, &camera, &Lights::default(), &look, &output).expect_err("no such look");
    let usual = Look::default();
    let lines = Lines { rim: -1.0, ..usual.lines };
    let pattern = Some(Pattern { kind: PatternKind::Grid, periods: [f32::INFINITY, 1.0], gap: 0.5 });
    let refused = [
        (Light::new(Vec3::ZERO, Vec3::ONE, true).expect_err("no direction"), "write a vector"),
        (Light::new(Vec3::Z, Vec3::NEG_ONE, true).expect_err("less than black"), "write linear red"),
        (drawn(Look { wireframe: f32::NAN, ..usual.clone() }), "write 0 for none"),
        (drawn(Look { opacity: [0.5, 1.5], ..usual.clone() }), "write 0 for none"),
        (drawn(Look { lines, ..usual.clone() }), "0 for no line"),
        (drawn(Look { cut: Some(Plane { normal: DVec3::NAN, offset: 0.0 }), ..usual.clone() }), "a normal of length 1"),
        (
            drawn(Look { cut: Some(Plane { normal: DVec3::ZERO, offset: 0.0 }), ..usual.clone() }),
            "a normal of length 1",
        ),
        (drawn(Look { pattern, ..usual }), "give widths"),
        (Output::new(8, 8, 3).expect_err("three"), "write 1, 4, 8 or 16"),
        (Output::new(0, 5, 1).expect_err("no width"), "at least 1"),
        (Output::new(5, 1 << 40, 1).expect_err("too high"), "at most 16384"),
    ];
    for (error, remedy) in refused {
        assert!(error.remedy().contains(remedy) && error.to_string().contains(remedy), "{error}");
        assert!(!error.reason().contains(remedy), "{error}");
    }
}

#[test]
fn a_line_wider_than_pixels_can_be_counted_covers_the_picture() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let output = Output::new(16, 12, 1).expect("a size");
    let camera = Camera::framing(&View::default(), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery { triangles: &[[0, 1, 2]], positions: &positions, pins: &[0], ..Scenery::default() };
    for pin in [1e3, 1e12] {
        let look = Look { lines: Lines { pin, ..Lines::NONE }, ..Look::default() };
        let picture = render(&scenery, &camera, &Lights::default(), &look, &output).expect("a picture");
        assert!(picture.beauty().iter().all(|pixel| pixel.w == 1.0), "{pin}");
    }
}
