//! Tiny pictures that can be checked by eye: which pixels a triangle covers, and who is in front.
//!
//! The view is orthographic with one unit per pixel, x to the right and y up, the origin in the lower
//! left corner of the picture, and one sample in the middle of each pixel. `#` is a front, `o` a back.

use crate::support::plan_view;
use glam::{DVec3, Vec3};
use immerse::render::{Camera, Lights, Lines, Look, Output, Paint, Picture, Scenery, render};

const WHITE: Vec3 = Vec3::ONE;

fn flat_look() -> Look {
    Look {
        paint: Paint::Sides([WHITE, Vec3::ZERO]),
        sky: 0.5 * WHITE,
        ground: 0.5 * WHITE,
        occlusion_reach: 0.0,
        rim_darkening: 0.0,
        lines: Lines::NONE,
        ..Look::default()
    }
}

fn picture(size: [usize; 2], samples: usize, triangles: &[[[f64; 3]; 3]]) -> Picture {
    let output = Output::new(size[0], size[1], samples).expect("a size");
    seen_by(&plan_view(&output), &output, triangles)
}

fn seen_by(camera: &Camera, output: &Output, triangles: &[[[f64; 3]; 3]]) -> Picture {
    let positions: Vec<DVec3> = triangles.iter().flatten().map(|&corner| DVec3::from(corner)).collect();
    let triangles: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    render(&scenery, camera, &Lights::new(Vec::new()), &flat_look(), output).expect("a picture")
}

fn drawing(film: &Picture) -> String {
    let symbol = |pixel: &glam::Vec4| match (pixel.w > 0.5, pixel.x > 0.25) {
        (false, _) => '.',
        (true, true) => '#',
        (true, false) => 'o',
    };
    film.beauty().chunks(film.width()).map(|row| row.iter().map(symbol).collect::<String>() + "\n").collect()
}

fn lines(rows: &[&str]) -> String {
    rows.iter().map(|row| format!("{row}\n")).collect()
}

#[test]
fn a_triangle_covers_the_pixels_whose_middle_it_contains() {
    let film = picture([8, 6], 1, &[[[1.0, 1.0, 0.0], [7.0, 1.0, 0.0], [1.0, 5.0, 0.0]]]);
    // The slanted edge passes below the middle of the pixel at its ends, and owns nothing it only touches.
    assert_eq!(drawing(&film), lines(&["........", ".#......", ".##.....", ".####...", ".#####..", "........"]));
}

#[test]
fn a_sample_on_an_edge_belongs_to_the_triangle_below_or_to_the_right_of_it() {
    // All edges of this square pass through middles of pixels: top and left are in, bottom and right out.
    let (low, high) = (1.5, 4.5);
    let square = [
        [[low, low, 0.0], [high, low, 0.0], [high, high, 0.0]],
        [[low, low, 0.0], [high, high, 0.0], [low, high, 0.0]],
    ];
    let film = picture([6, 6], 1, &square);
    assert_eq!(drawing(&film), lines(&["......", ".###..", ".###..", ".###..", "......", "......"]));
}

#[test]
fn triangles_around_a_point_leave_no_crack_and_hit_no_sample_twice() {
    // A fan around an odd point, with corners on and off the grid.
    let center = [7.37, 6.5, 0.0];
    let rim =
        [[0.5, 0.5, 0.0], [9.0, 0.25, 0.0], [15.5, 4.0, 0.0], [14.25, 11.0, 0.0], [7.5, 11.5, 0.0], [0.5, 9.0, 0.0]];
    let fan: Vec<[[f64; 3]; 3]> = (0..rim.len()).map(|k| [center, rim[k], rim[(k + 1) % rim.len()]]).collect();
    for samples in [1, 4, 8, 16] {
        let together = picture([16, 12], samples, &fan);
        let alone: Vec<Picture> = fan.iter().map(|&triangle| picture([16, 12], samples, &[triangle])).collect();
        for pixel in 0..16 * 12 {
            let sum: f32 = alone.iter().map(|film| film.beauty()[pixel].w).sum();
            let whole = together.beauty()[pixel].w;
            assert!((sum - whole).abs() < 1e-4, "{samples} samples, pixel {pixel}: parts {sum}, whole {whole}");
        }
        let middle = together.beauty()[6 * 16 + 7].w;
        assert_eq!(middle, 1.0, "{samples} samples: a crack in the middle");
    }
}

#[test]
fn the_nearer_triangle_is_seen_also_where_two_pass_through_each_other() {
    // The front slopes toward the eye to the right, the back is level at the height it has half way.
    let film = picture(
        [8, 4],
        1,
        &[[[0.0, 0.0, 0.0], [16.0, 0.0, 2.0], [0.0, 8.0, 0.0]], [[0.0, 0.0, 0.5], [0.0, 8.0, 0.5], [16.0, 0.0, 0.5]]],
    );
    assert_eq!(drawing(&film), lines(&["oooo####", "oooo####", "oooo####", "oooo####"]));
}

#[test]
fn of_two_triangles_at_the_same_depth_the_first_is_seen() {
    let front = [[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]];
    let back = [[0.0, 0.0, 0.0], [0.0, 8.0, 0.0], [8.0, 0.0, 0.0]];
    assert_eq!(drawing(&picture([4, 2], 1, &[front, back])), lines(&["####", "####"]));
    assert_eq!(drawing(&picture([4, 2], 1, &[back, front])), lines(&["oooo", "oooo"]));
}

#[test]
fn a_floor_that_passes_under_the_eye_is_clipped_at_the_near_plane() {
    let output = Output::new(8, 8, 1).expect("a size").with_layers(true);
    let eye = DVec3::new(0.0, 1.0, 0.0);
    let camera = Camera::look_at(eye, eye - DVec3::Z, DVec3::Y, 90_f64.to_radians(), 1.0, &output).expect("a view");
    let (far, wide) = (1000.0, 5000.0);
    let floor = [
        [[-wide, 0.0, far], [wide, 0.0, far], [wide, 0.0, -far]],
        [[-wide, 0.0, far], [wide, 0.0, -far], [-wide, 0.0, -far]],
    ];
    let film = seen_by(&camera, &output, &floor);
    let (sky, ground) = ("........", "########");
    assert_eq!(drawing(&film), lines(&[sky, sky, sky, sky, ground, ground, ground, ground]));
    // One unit below an eye with a right angle of view, the middle of row 4 is at 1 / tan = 8 units.
    assert!((film.layers().expect("layers").depth[4 * 8 + 3] - 8.0).abs() < 1e-3);
}

#[test]
fn triangles_that_reach_far_beyond_the_picture_cover_what_they_should() {
    // A half-plane whose edge ascends through the middle of the picture, with corners up to a million pixels away.
    for far in [30.0, 3e3, 3e4, 1e6] {
        let corners = [[-far, -far, 0.0], [far + 8.0, -far, 0.0], [far + 8.0, far + 8.0, 0.0]];
        let film = picture([8, 8], 1, &[corners]);
        // The middles of the pixels on the diagonal lie on the edge, which is on the left of the triangle.
        let wanted: Vec<String> = (0..8).map(|row| ".".repeat(7 - row) + &"#".repeat(row + 1)).collect();
        assert_eq!(drawing(&film), lines(&wanted.iter().map(String::as_str).collect::<Vec<_>>()), "{far} pixels away");
    }
}

#[test]
fn large_and_small_triangles_meet_without_a_crack() {
    // One large triangle on one side of the diagonal, many small ones on the other.
    let size = 40.0;
    let large = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [size, size, 0.0]];
    let small = (0..40).map(|k| {
        let (low, high) = (f64::from(k), f64::from(k) + 1.0);
        [[low, low, 0.0], [high, high, 0.0], [0.0, size, 0.0]]
    });
    for samples in [1, 4, 8, 16] {
        let parts =
            [picture([40, 40], samples, &[large]), picture([40, 40], samples, &small.clone().collect::<Vec<_>>())];
        for pixel in 0..40 * 40 {
            let sum: f32 = parts.iter().map(|film| film.beauty()[pixel].w).sum();
            let inside = (1..39).contains(&(pixel % 40)) && (1..39).contains(&(pixel / 40));
            assert!(!inside || (sum - 1.0).abs() < 1e-4, "{samples} samples, pixel {pixel}: {sum}");
        }
    }
}

#[test]
fn nothing_nearer_than_the_near_plane_is_seen() {
    let output = Output::new(4, 2, 1).expect("a size");
    let camera =
        Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 90_f64.to_radians(), 1.0, &output).expect("a view");
    // The near plane is a thousandth of the size of the surface away.
    for (distance, row) in [(0.0009, "...."), (0.0011, "####")] {
        let film =
            seen_by(&camera, &output, &[[[-9.0, -9.0, -distance], [9.0, -9.0, -distance], [0.0, 9.0, -distance]]]);
        assert_eq!(drawing(&film), lines(&[row, row]), "at {distance}");
    }
}

#[test]
fn half_covered_pixels_are_half_covered() {
    // Half of every pixel of the picture is white; the filter sees halves everywhere.
    let strips: Vec<[[f64; 3]; 3]> = (-2..18)
        .flat_map(|x| {
            let (left, right) = (f64::from(x), f64::from(x) + 0.5);
            [
                [[left, -3.0, 0.0], [right, -3.0, 0.0], [right, 11.0, 0.0]],
                [[left, -3.0, 0.0], [right, 11.0, 0.0], [left, 11.0, 0.0]],
            ]
        })
        .collect();
    for samples in [4, 8, 16] {
        let film = picture([16, 8], samples, &strips);
        let pixel = film.beauty()[4 * 16 + 8];
        assert!((pixel.w - 0.5).abs() < 0.02, "{samples} samples cover {}", pixel.w);
    }
}
