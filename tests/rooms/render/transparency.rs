//! Tiny pictures of what one can see through, cut away or leave out, with colours that can be worked out by hand.
//!
//! The view is orthographic with one unit per pixel, x to the right and y up, the origin in the lower left
//! corner of the picture, higher z nearer. Surfaces show their colour as it is.

use crate::support::plan_view;
use glam::{DVec3, Vec3, Vec4};
use immerse::{
    immersion::FieldValues,
    render::{
        Camera, Field, Lights, Lines, Look, Material, Output, Paint, Pattern, PatternKind, Picture, Plane, Scenery,
        render,
    },
};

const RED: Vec3 = Vec3::new(0.5, 0.0, 0.0);
const BLUE: Vec3 = Vec3::new(0.0, 0.0, 0.5);

/// Fronts are red, backs blue.
fn unlit() -> Look {
    Look {
        paint: Paint::Sides([RED, BLUE]),
        material: Material::Flat,
        sky: Vec3::ONE,
        ground: Vec3::ONE,
        occlusion_reach: 0.0,
        rim_darkening: 0.0,
        shadows: false,
        lines: Lines::NONE,
        ..Look::default()
    }
}

/// As thick as this from every direction.
fn glass(opacity: f32) -> Look {
    Look { opacity: [opacity; 2], edge_opacity: opacity, ..unlit() }
}

#[derive(Default)]
struct Model {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    boundary: Vec<[u32; 2]>,
}

impl Model {
    /// A rectangle from `low` to `high`, whose z is given at its left and right side; its front or its back is seen.
    fn sheet(mut self, low: [f64; 2], high: [f64; 2], z: [f64; 2], shows_front: bool) -> Self {
        let first = self.positions.len() as u32;
        let corners = [(0, low[1]), (1, low[1]), (1, high[1]), (0, high[1])];
        self.positions.extend(corners.map(|(side, y)| DVec3::new([low[0], high[0]][side], y, z[side])));
        let corners = if shows_front { [0, 1, 2, 3] } else { [0, 3, 2, 1] }.map(|corner| first + corner);
        self.triangles.extend([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]);
        self
    }

    /// A line that is drawn as part of the boundary.
    fn line(mut self, from: [f64; 3], to: [f64; 3]) -> Self {
        let first = self.positions.len() as u32;
        self.positions.extend([DVec3::from(from), DVec3::from(to)]);
        self.boundary.push([first, first + 1]);
        self
    }

    fn scenery(&self) -> Scenery<'_> {
        Scenery {
            positions: &self.positions,
            triangles: &self.triangles,
            boundary: &self.boundary,
            ..Scenery::default()
        }
    }

    fn film(&self, look: &Look, output: &Output) -> Picture {
        render(&self.scenery(), &plan_view(output), &Lights::new(Vec::new()), look, output).expect("a picture")
    }
}

fn assert_close(found: Vec4, wanted: Vec4, place: &str) {
    assert!((found - wanted).abs().max_element() < 1e-6, "{place}: {found} instead of {wanted}");
}

/// One sample per pixel, `#` where it is covered.
fn covered_row(film: &Picture) -> String {
    film.beauty()[..film.width()].iter().map(|pixel| if pixel.w > 0.5 { '#' } else { '.' }).collect()
}

#[test]
fn three_layers_are_in_order_whatever_the_order_of_the_triangles() {
    let output = Output::new(4, 4, 4).expect("a size");
    // From the top: red, blue, blue, each letting half of the light through.
    let layers = [(3.0, true), (2.0, false), (1.0, false)];
    let wanted = (0.5 * RED + 0.25 * BLUE + 0.125 * BLUE).extend(0.875);
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let model = order.iter().fold(Model::default(), |model, &layer| {
            let (z, front) = layers[layer];
            model.sheet([-4.0, -4.0], [8.0, 8.0], [z; 2], front)
        });
        for (pixel, &found) in model.film(&glass(0.5), &output).beauty().iter().enumerate() {
            assert_close(found, wanted, &format!("order {order:?}, pixel {pixel}"));
        }
    }
}

#[test]
fn front_and_back_have_their_own_opacity() {
    let output = Output::new(2, 2, 4).expect("a size");
    let look = Look { opacity: [0.25, 0.75], edge_opacity: 0.25, ..unlit() };
    for (shows_front, color, opacity) in [(true, RED, 0.25), (false, BLUE, 0.75)] {
        let film = Model::default().sheet([-4.0, -4.0], [8.0, 8.0], [0.0; 2], shows_front).film(&look, &output);
        assert_close(film.beauty()[0], (opacity * color).extend(opacity), &format!("front {shows_front}"));
    }
}

#[test]
fn sheets_that_pass_through_each_other_change_places_where_they_meet() {
    let output = Output::new(8, 2, 1).expect("a size");
    // The front rises to the right through the level back and meets it in the middle of the picture.
    let model = Model::default().sheet([-4.0, -4.0], [12.0, 8.0], [0.0, 2.0], true).sheet(
        [-4.0, -4.0],
        [12.0, 8.0],
        [1.0; 2],
        false,
    );
    let over = |above: Vec3, below: Vec3| (0.5 * above + 0.25 * below).extend(0.75);
    for (x, &found) in model.film(&glass(0.5), &output).beauty()[..8].iter().enumerate() {
        let wanted = if x < 4 { over(BLUE, RED) } else { over(RED, BLUE) };
        assert_close(found, wanted, &format!("column {x}"));
    }
}

#[test]
fn sheets_that_pass_through_each_other_within_a_pixel_share_it() {
    // They meet at x = 3.5: with 4 samples, two of column 3 are on either side, and columns beyond its
    // neighbours see one order only.
    let output = Output::new(7, 3, 4).expect("a size");
    let model = Model::default().sheet([-4.5, -4.0], [11.5, 8.0], [0.0, 2.0], true).sheet(
        [-4.5, -4.0],
        [11.5, 8.0],
        [1.0; 2],
        false,
    );
    let film = model.film(&glass(0.5), &output);
    let row = &film.beauty()[7..14];
    assert_close(row[0], (0.5 * BLUE + 0.25 * RED).extend(0.75), "left");
    assert_close(row[6], (0.5 * RED + 0.25 * BLUE).extend(0.75), "right");
    let middle = 0.375 * (RED + BLUE);
    assert!((row[3] - middle.extend(0.75)).abs().max_element() < 0.02, "middle: {} and not {middle}", row[3]);
}

#[test]
fn a_line_behind_glass_shines_through_and_one_before_it_does_not() {
    let output = Output::new(9, 9, 4).expect("a size");
    let line_color = Vec3::new(0.0, 0.5, 0.0);
    // Three pixels wide (small pictures have lines of at least 0.4 times the usual width).
    let look = Look { lines: Lines { color: line_color, boundary: 8.0, ..Lines::NONE }, ..glass(0.5) };
    for (z, wanted) in [(-9.0, 0.5 * RED + 0.5 * line_color), (9.0, line_color)] {
        let model = Model::default().sheet([-4.0, -4.0], [16.0, 16.0], [0.0; 2], true);
        let film = model.line([4.5, -9.0, z], [4.5, 18.0, z]).film(&look, &output);
        assert_close(film.beauty()[4 * 9 + 4], wanted.extend(1.0), &format!("line at z = {z}"));
        let open = film.beauty()[4 * 9];
        assert_close(open, (0.5 * RED).extend(0.5), "beside the line");
    }
}

#[test]
fn more_layers_than_fit_in_memory_at_once_make_the_same_picture() {
    // 400 sheets over a tile of 66 x 66 pixels are far more fragments than a tile may hold; over a
    // strip of it they are not.
    let output = Output::new(64, 64, 4).expect("a size").with_layers(true);
    let model = (0..400).fold(Model::default(), |model, sheet| {
        let z = f64::from(sheet * 7 % 400) / 100.0;
        model.sheet([-9.0, -9.0], [90.0, 90.0], [z, 4.0 - z], sheet % 3 == 0)
    });
    let look = glass(0.01);
    let whole = model.film(&look, &output);
    let strip = model.film(&look, &output.with_crop([0, 20, 64, 2]).expect("a part"));
    assert_eq!(whole.beauty()[20 * 64..22 * 64], *strip.beauty());
    assert_eq!(whole.layers().expect("layers").face_ids[20 * 64..22 * 64], strip.layers().expect("layers").face_ids);
    let passing = 0.99_f32.powi(400);
    assert!((whole.beauty()[0].w - (1.0 - passing)).abs() < 1e-4, "covers {}", whole.beauty()[0].w);
}

#[test]
fn the_nearest_sheet_is_recorded_in_the_layers() {
    let output = Output::new(2, 2, 4).expect("a size").with_layers(true);
    let model = Model::default()
        .sheet([-4.0, -4.0], [8.0, 8.0], [1.0; 2], true)
        .sheet([-4.0, -4.0], [8.0, 8.0], [2.0; 2], false)
        .sheet([-4.0, -4.0], [8.0, 8.0], [0.0; 2], true);
    let film = model.film(&glass(0.5), &output);
    let layers = film.layers().expect("layers");
    assert!(layers.face_ids.iter().all(|face| [2, 3].contains(face)), "{:?}", layers.face_ids);
    assert!(layers.sides.iter().all(|&side| side == -1.0));
}

#[test]
fn see_through_glass_has_the_same_bits_on_any_number_of_threads() {
    let output = Output::new(200, 150, 8).expect("a size");
    let model = (0..40).fold(Model::default(), |model, sheet| {
        let (x, z) = (f64::from(sheet * 5), f64::from(sheet * 11 % 40));
        model.sheet([x - 60.0, 10.3], [x + 50.0, 140.7], [z, 40.0 - z], sheet % 2 == 0)
    });
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| model.film(&glass(0.3), &output))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn gaps_of_bands_are_left_out_column_by_column() {
    let model = Model::default().sheet([0.0, -4.0], [16.0, 8.0], [0.0, 5.0], true);
    let along = Field {
        name: "x".into(),
        values: FieldValues::PerVertex(model.positions.iter().map(|position| position.x as f32).collect()),
        period: None,
    };
    let scenery = Scenery { along: [Some(&along), None], ..model.scenery() };
    let output = Output::new(16, 2, 1).expect("a size");
    for (gap, wanted) in [(0.5, "##..##..##..##.."), (0.25, "###.###.###.###."), (0.0, "################")] {
        let pattern = Pattern { kind: PatternKind::Bands, periods: [4.0, 0.0], gap };
        for see_through in [unlit(), glass(0.9)] {
            let look = Look { pattern: Some(pattern), ..see_through };
            let film =
                render(&scenery, &plan_view(&output), &Lights::new(Vec::new()), &look, &output).expect("a picture");
            assert_eq!(covered_row(&film), wanted, "gap {gap}");
        }
    }
}

#[test]
fn bands_are_in_perspective() {
    // A floor below an eye at height 1 that looks along it: the row y pixels below the horizon sees the
    // distance 4 / y, as half of the picture is four pixels high under a right angle of view.
    let output = Output::new(8, 8, 1).expect("a size");
    let eye = DVec3::new(0.0, 1.0, 0.0);
    let camera = Camera::look_at(eye, eye - DVec3::Z, DVec3::Y, 90_f64.to_radians(), 1.0, &output).expect("a view");
    let positions = [[-99.0, 0.0, 9.0], [99.0, 0.0, 9.0], [99.0, 0.0, -99.0], [-99.0, 0.0, -99.0]].map(DVec3::from);
    let along = Field {
        name: "distance".into(),
        values: FieldValues::PerVertex(positions.iter().map(|position| -position.z as f32).collect()),
        period: None,
    };
    let scenery = Scenery {
        positions: &positions,
        triangles: &[[0, 1, 2], [0, 2, 3]],
        along: [Some(&along), None],
        ..Scenery::default()
    };
    // The middles of the rows see 8, 2.67, 1.6 and 1.14: bands from 0 to 1, 2 to 3, … are there.
    let pattern = Pattern { kind: PatternKind::Bands, periods: [2.0, 0.0], gap: 0.5 };
    let look = Look { pattern: Some(pattern), ..unlit() };
    let film = render(&scenery, &camera, &Lights::new(Vec::new()), &look, &output).expect("a picture");
    let column: String = (4..8).map(|y| if film.beauty()[y * 8 + 3].w > 0.5 { '#' } else { '.' }).collect();
    assert_eq!(column, "##..");
}

#[test]
fn what_lies_beyond_the_cut_is_left_out_to_the_pixel() {
    let model =
        Model::default().sheet([0.0, -4.0], [12.0, 8.0], [0.0; 2], true).line([0.0, 1.0, 9.0], [12.0, 1.0, 9.0]);
    let output = Output::new(12, 2, 1).expect("a size");
    // Lines have round ends; this one is so thin that its end does not reach the next pixel.
    let lines = Lines { boundary: 2.0, ..Lines::NONE };
    for lines in [Lines::NONE, lines] {
        let cut = |normal: DVec3, offset: f64| Look { cut: Some(Plane { normal, offset }), lines, ..unlit() };
        let row = |look: &Look| covered_row(&model.film(look, &output));
        assert_eq!(row(&cut(DVec3::X, 5.0)), "#####.......");
        assert_eq!(row(&cut(DVec3::NEG_X, -5.0)), ".....#######");
        assert_eq!(row(&cut(DVec3::X, 50.0)), "############");
        assert_eq!(row(&cut(DVec3::X, -1.0)), "............");
    }
}

#[test]
fn a_cut_goes_through_the_middle_of_triangles() {
    let model = Model::default().sheet([0.0, 0.0], [6.0, 6.0], [0.0; 2], true);
    let output = Output::new(6, 6, 1).expect("a size");
    // Everything above the descending diagonal through x + y = 6.5 goes.
    let normal = DVec3::new(1.0, 1.0, 0.0).normalize();
    let look = Look { cut: Some(Plane { normal, offset: 6.5 / 2.0_f64.sqrt() }), ..unlit() };
    let film = model.film(&look, &output);
    let drawing: Vec<String> = film
        .beauty()
        .chunks(6)
        .map(|row| row.iter().map(|pixel| if pixel.w > 0.5 { '#' } else { '.' }).collect())
        .collect();
    assert_eq!(drawing, ["#.....", "##....", "###...", "####..", "#####.", "######"]);
}

#[test]
fn a_crop_is_that_part_of_the_picture() {
    let whole_output = Output::new(150, 100, 4).expect("a size").with_layers(true);
    let model = (0..12).fold(Model::default(), |model, sheet| {
        let (x, z) = (f64::from(sheet * 11), f64::from(sheet * 5 % 12));
        model.sheet([x - 20.0, 3.3], [x + 41.7, 96.2], [z, 12.0 - z], sheet % 2 == 0)
    });
    let model = model.line([0.0, 0.0, 20.0], [150.0, 100.0, 20.0]);
    let lines = Lines { boundary: 9.0, ..Lines::NONE };
    let lit = Look { lines, ..Look::default() };
    let camera = plan_view(&whole_output);
    for look in [Look { lines, ..glass(0.5) }, lit] {
        let film =
            |output: &Output| render(&model.scenery(), &camera, &Lights::default(), &look, output).expect("a picture");
        let whole = film(&whole_output);
        for [x, y, width, height] in [[0, 0, 150, 100], [10, 7, 80, 60], [64, 64, 64, 36], [149, 99, 1, 1]] {
            let part = film(&whole_output.with_crop([x, y, width, height]).expect("a part"));
            assert_eq!([part.width(), part.height()], [width, height]);
            let (bytes, whole_bytes) = (part.srgb_bytes(), whole.srgb_bytes());
            let (layers, whole_layers) = (part.layers().expect("layers"), whole.layers().expect("layers"));
            for row in 0..height {
                let there = (y + row) * 150 + x;
                let (here, there) = (row * width..(row + 1) * width, there..there + width);
                assert_eq!(part.beauty()[here.clone()], whole.beauty()[there.clone()]);
                assert_eq!(layers.depth[here.clone()], whole_layers.depth[there.clone()]);
                assert_eq!(bytes[3 * here.start..3 * here.end], whole_bytes[3 * there.start..3 * there.end]);
            }
        }
    }
}

#[test]
fn crops_outside_the_picture_are_refused() {
    let output = Output::new(150, 100, 4).expect("a size");
    for crop in [[0, 0, 0, 5], [100, 0, 51, 5], [150, 0, 1, 1], [0, 0, usize::MAX, 1], [1, 0, usize::MAX, 1]] {
        let error = output.with_crop(crop).expect_err("no part").to_string();
        assert!(error.contains("150 x 100"), "{error}");
    }
}

/// An edge that crosses more bands than can be listed is drawn as a whole.
#[test]
fn bands_too_narrow_to_be_told_apart_do_not_keep_edges_from_ending() {
    let model = Model::default().sheet([0.0, -4.0], [16.0, 8.0], [0.0, 5.0], true);
    let along = Field {
        name: "x".into(),
        values: FieldValues::PerVertex(model.positions.iter().map(|position| position.x as f32).collect()),
        period: None,
    };
    let boundary = [[model.triangles[0][0], model.triangles[0][1]]];
    let scenery = Scenery { along: [Some(&along), None], boundary: &boundary, ..model.scenery() };
    let output = Output::new(16, 2, 1).expect("a size");
    for period in [0.0, 1e-30] {
        let pattern = Some(Pattern { kind: PatternKind::Bands, periods: [period, 1.0], gap: 0.5 });
        let look = Look { pattern, lines: Lines { boundary: 2.0, ..Lines::NONE }, ..unlit() };
        assert!(render(&scenery, &plan_view(&output), &Lights::default(), &look, &output).is_ok(), "{period}");
    }
}
