//! The camera frames what it is given, from a good side, once for a whole film.

use std::f64::consts::TAU;

use glam::DVec3;
use immerse::{
    render::{Camera, Extent, Output, RenderError},
    scene::CameraSection,
};

/// Points on an ellipsoid with its middle elsewhere.
fn ellipsoid(radii: DVec3, middle: DVec3) -> Vec<DVec3> {
    (0..4000)
        .map(|index| {
            let height = 1.0 - (2 * index + 1) as f64 / 4000.0;
            let angle = TAU * 0.381_966 * f64::from(index);
            let width = (1.0 - height * height).sqrt();
            middle + radii * DVec3::new(width * libm::cos(angle), height, width * libm::sin(angle))
        })
        .collect()
}

/// Largest distance from the middle of the picture, 1 at its border.
fn reach(camera: &Camera, points: &[DVec3]) -> f64 {
    let places = points.iter().map(|&point| {
        let clip = camera.clip_from_view() * camera.view_from_world().transform_point3(point).extend(1.0);
        assert!(clip.w > 0.0 && (0.0..=clip.w).contains(&clip.z), "{point} is in depth");
        (clip.x / clip.w).abs().max((clip.y / clip.w).abs())
    });
    places.fold(0.0, f64::max)
}

#[test]
fn the_surface_fills_the_wanted_share_of_the_picture() {
    let radii = DVec3::new(3.0, 1.0, 0.7);
    for size in [[640, 480], [480, 640], [1000, 100]] {
        for field_of_view in [None, Some(0.0), Some(5.0), Some(90.0)] {
            let output = Output::new(size[0], size[1], 1).expect("a size");
            let points = ellipsoid(radii, DVec3::new(100.0, -20.0, 3.0));
            let section = CameraSection { field_of_view, fill: Some(0.8), ..CameraSection::default() };
            let camera = Camera::framing(&section, &Extent::of(&points), &output).expect("a view");
            let reach = reach(&camera, &points);
            assert!((0.76..0.82).contains(&reach), "{size:?}, {field_of_view:?}: {reach}");
        }
    }
}

#[test]
fn one_camera_holds_all_frames_of_a_film() {
    let output = Output::new(640, 480, 1).expect("a size");
    let frames: Vec<Vec<DVec3>> = (0..10)
        .map(|k| ellipsoid(DVec3::new(1.0, 1.0 + 0.3 * f64::from(k), 0.5), DVec3::new(0.2 * f64::from(k), 0.0, 0.0)))
        .collect();
    let mut extent = Extent::default();
    frames.iter().for_each(|frame| extent.merge(&Extent::of(frame)));
    let camera = Camera::framing(&CameraSection::default(), &extent, &output).expect("a view");
    let reaches: Vec<f64> = frames.iter().map(|frame| reach(&camera, frame)).collect();
    assert!(reaches.iter().all(|&reach| reach < 0.87), "{reaches:?}");
    assert!(reaches.iter().any(|&reach| reach > 0.8), "{reaches:?}");
}

#[test]
fn the_broad_side_is_seen() {
    let output = Output::new(640, 480, 1).expect("a size");
    for (radii, broad) in [
        (DVec3::new(3.0, 2.0, 1.0), DVec3::Z),
        (DVec3::new(1.0, 2.0, 3.0), DVec3::X),
        (DVec3::new(2.0, 0.5, 2.5), DVec3::Y),
    ] {
        let extent = Extent::of(&ellipsoid(radii, DVec3::ZERO));
        let camera = Camera::framing(&CameraSection::default(), &extent, &output).expect("a view");
        let toward_eye = camera.view_from_world().matrix3.transpose() * DVec3::Z;
        assert!(toward_eye.dot(broad).abs() > 0.6, "{radii}: seen from {toward_eye}");
    }
}

#[test]
fn a_bowl_is_seen_from_its_open_side_whichever_way_it_lies() {
    let output = Output::new(640, 480, 1).expect("a size");
    for opening in [DVec3::Z, DVec3::NEG_Z] {
        let bowl: Vec<DVec3> = ellipsoid(DVec3::new(1.0, 1.0, 0.6), DVec3::ZERO)
            .into_iter()
            .filter(|point| point.dot(opening) < 0.2)
            .collect();
        let camera = Camera::framing(&CameraSection::default(), &Extent::of(&bowl), &output).expect("a view");
        let toward_eye = camera.view_from_world().matrix3.transpose() * DVec3::Z;
        assert!(toward_eye.dot(opening) > 0.5, "opening to {opening}, seen from {toward_eye}");
    }
}

#[test]
fn given_directions_are_kept() {
    let output = Output::new(640, 480, 1).expect("a size");
    let section =
        CameraSection { direction: Some([1.0, 2.0, -2.0]), up: Some([0.0, 0.0, 1.0]), ..CameraSection::default() };
    let extent = Extent::of(&ellipsoid(DVec3::ONE, DVec3::ZERO));
    let camera = Camera::framing(&section, &extent, &output).expect("a view");
    let view = camera.view_from_world().matrix3;
    assert!((view * DVec3::new(1.0, 2.0, -2.0) / 3.0).distance(DVec3::Z) < 1e-12);
    let up = view * DVec3::Z;
    assert!(up.x.abs() < 1e-12 && up.y > 0.0);
    assert!((view.determinant() - 1.0).abs() < 1e-12, "the view is not mirrored");
}

#[test]
fn impossible_views_are_refused_with_key_and_remedy() {
    let output = Output::new(640, 480, 1).expect("a size");
    let extent = Extent::of(&ellipsoid(DVec3::ONE, DVec3::ZERO));
    let usual = CameraSection::default;
    let refused = [
        (CameraSection { direction: Some([0.0; 3]), ..usual() }, "direction"),
        (CameraSection { direction: Some([f64::NAN, 0.0, 1.0]), ..usual() }, "direction"),
        (CameraSection { up: Some([0.0; 3]), ..usual() }, "up"),
        (CameraSection { direction: Some([0.0, 0.0, 1.0]), up: Some([0.0, 0.0, -2.0]), ..usual() }, "up"),
        (CameraSection { field_of_view: Some(180.0), ..usual() }, "field_of_view"),
        (CameraSection { fill: Some(0.0), ..usual() }, "fill"),
    ];
    for (section, wanted) in refused {
        match Camera::framing(&section, &extent, &output) {
            Err(RenderError::Camera { key, .. }) => assert_eq!(key, wanted),
            other => panic!("{section:?}: {other:?}"),
        }
    }
    let nothing = Camera::framing(&usual(), &Extent::of(&[DVec3::NAN]), &output);
    assert!(matches!(nothing, Err(RenderError::NothingToFrame)));
}

#[test]
fn a_single_point_and_a_line_can_be_framed() {
    let output = Output::new(640, 480, 1).expect("a size");
    for points in [vec![DVec3::ONE], vec![DVec3::ZERO, DVec3::X], vec![DVec3::ONE; 5]] {
        let camera = Camera::framing(&CameraSection::default(), &Extent::of(&points), &output).expect("a view");
        assert!(reach(&camera, &points) <= 1.0);
    }
}
