//! The camera frames what it is given, from a good side, once for a whole film.

use std::f64::consts::TAU;

use crate::support::seen_from;
use glam::DVec3;
use immerse::{
    advice::Advice,
    render::{Camera, CameraMotion, Extent, Output, RenderError, View, ViewElement, ViewKey},
    timeline::Ease,
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

fn usual() -> View {
    View::default()
}

/// The usual view, or one with this field of view in degrees.
fn with_field_of_view(view: View, degrees: Option<f64>) -> View {
    match degrees {
        Some(degrees) => view.with_field_of_view(degrees.to_radians()).expect("a field of view"),
        None => view,
    }
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
            let view = with_field_of_view(usual(), field_of_view).with_fill(0.8).expect("a share");
            let camera = Camera::framing(&view, &Extent::of(&points), &output).expect("a view");
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
    let camera = Camera::framing(&View::default(), &extent, &output).expect("a view");
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
        let camera = Camera::framing(&View::default(), &extent, &output).expect("a view");
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
        let camera = Camera::framing(&View::default(), &Extent::of(&bowl), &output).expect("a view");
        let toward_eye = camera.view_from_world().matrix3.transpose() * DVec3::Z;
        assert!(toward_eye.dot(opening) > 0.5, "opening to {opening}, seen from {toward_eye}");
    }
}

#[test]
fn given_directions_are_kept() {
    let output = Output::new(640, 480, 1).expect("a size");
    let view = seen_from(DVec3::new(1.0, 2.0, -2.0), DVec3::Z);
    let extent = Extent::of(&ellipsoid(DVec3::ONE, DVec3::ZERO));
    let camera = Camera::framing(&view, &extent, &output).expect("a view");
    let view = camera.view_from_world().matrix3;
    assert!((view * DVec3::new(1.0, 2.0, -2.0) / 3.0).distance(DVec3::Z) < 1e-12);
    let up = view * DVec3::Z;
    assert!(up.x.abs() < 1e-12 && up.y > 0.0);
    assert!((view.determinant() - 1.0).abs() < 1e-12, "the view is not mirrored");
}

#[test]
fn impossible_views_are_refused_with_element_and_remedy() {
    let key = ViewKey { time: 0.0, orbit: 0.0, rise: 0.0, dolly: 1.0, target: None };
    let with_key = |key| usual().with_keys(vec![key], Ease::Linear);
    let refused = [
        (usual().with_direction(DVec3::ZERO), ViewElement::Direction),
        (usual().with_direction(DVec3::new(f64::NAN, 0.0, 1.0)), ViewElement::Direction),
        (usual().with_up(DVec3::ZERO), ViewElement::Up),
        (usual().with_direction(DVec3::Z).and_then(|view| view.with_up(DVec3::NEG_Z)), ViewElement::Up),
        (usual().with_up(DVec3::NEG_Z).and_then(|view| view.with_direction(DVec3::Z)), ViewElement::Up),
        (usual().with_field_of_view(180_f64.to_radians()), ViewElement::FieldOfView),
        (usual().with_field_of_view(f64::NAN), ViewElement::FieldOfView),
        (usual().with_fill(0.0), ViewElement::Fill),
        (usual().with_target(DVec3::INFINITY), ViewElement::Target),
        (usual().with_turntable(f64::INFINITY), ViewElement::Turntable),
        (with_key(ViewKey { dolly: 0.0, ..key }), ViewElement::Key(0)),
        (with_key(ViewKey { time: f64::NAN, ..key }), ViewElement::Key(0)),
        (with_key(ViewKey { target: Some(DVec3::NAN), ..key }), ViewElement::Key(0)),
    ];
    for (view, wanted) in refused {
        let error = view.expect_err("impossible");
        assert!(!error.remedy().is_empty() && error.to_string().ends_with(&format!("; {}", error.remedy())), "{error}");
        match error {
            RenderError::NoDirection { element, .. }
            | RenderError::ViewRange { element, .. }
            | RenderError::ViewNotFinite { element } => assert_eq!(element, wanted),
            RenderError::UpAlongView { .. } => assert_eq!(ViewElement::Up, wanted),
            other => panic!("{other}"),
        }
    }
    let order = usual().with_keys(vec![key, key], Ease::Linear);
    assert!(matches!(order, Err(RenderError::ViewKeyOrder { earlier: 0.0, later: 0.0 })));
    let output = Output::new(640, 480, 1).expect("a size");
    let nothing = Camera::framing(&usual(), &Extent::of(&[DVec3::NAN]), &output);
    assert!(matches!(nothing, Err(RenderError::NothingToFrame)));
}

#[test]
fn a_single_point_and_a_line_can_be_framed() {
    let output = Output::new(640, 480, 1).expect("a size");
    for points in [vec![DVec3::ONE], vec![DVec3::ZERO, DVec3::X], vec![DVec3::ONE; 5]] {
        let camera = Camera::framing(&View::default(), &Extent::of(&points), &output).expect("a view");
        assert!(reach(&camera, &points) <= 1.0);
    }
}

/// Middle of the picture of some points and their extent around it.
fn bounds(camera: &Camera, points: &[DVec3]) -> [f64; 4] {
    let places = points.iter().map(|&point| {
        let clip = camera.clip_from_view() * camera.view_from_world().transform_point3(point).extend(1.0);
        [clip.x / clip.w, clip.y / clip.w]
    });
    places
        .fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |[a, b, c, d], [x, y]| [a.min(x), b.min(y), c.max(x), d.max(y)])
}

fn moving(view: &View, points: &[DVec3]) -> CameraMotion {
    let output = Output::new(640, 480, 1).expect("a size");
    CameraMotion::framing(view, &Extent::of(points), &output, [0.0, 1.0]).expect("a view")
}

#[test]
fn a_sphere_on_a_turntable_does_not_pump() {
    let points = ellipsoid(DVec3::ONE, DVec3::new(3.0, -1.0, 2.0));
    for field_of_view in [None, Some(0.0)] {
        let view = with_field_of_view(usual(), field_of_view).with_up(DVec3::Z);
        let motion = moving(&view.and_then(|view| view.with_turntable(TAU)).expect("a view"), &points);
        let sizes: Vec<[f64; 4]> = (0..60).map(|k| bounds(&motion.at(f64::from(k) / 60.0, 0.0), &points)).collect();
        for (size, first) in sizes.iter().zip(std::iter::repeat(sizes[0])) {
            assert!((0..4).all(|side| (size[side] - first[side]).abs() < 0.02), "{size:?} after {first:?}");
        }
        assert!((sizes[0][3] - 0.85).abs() < 0.02, "it fills the picture: {:?}", sizes[0]);
    }
}

#[test]
fn nothing_is_cut_off_while_a_long_surface_turns() {
    let points = ellipsoid(DVec3::new(4.0, 0.5, 0.7), DVec3::new(1.0, 2.0, 3.0));
    for turntable in [90.0_f64, -180.0, 360.0, 720.0] {
        let view = seen_from(DVec3::new(0.0, -1.0, 0.3), DVec3::Z).with_turntable(turntable.to_radians());
        let motion = moving(&view.expect("a view"), &points);
        let reaches: Vec<f64> = (0..=200).map(|k| reach(&motion.at(f64::from(k) / 200.0, 0.0), &points)).collect();
        let largest = reaches.iter().copied().fold(0.0, f64::max);
        assert!((0.8..0.87).contains(&largest), "{turntable} degrees: {largest}");
    }
}

/// Clockwise or not, how far, and about which axis.
#[test]
fn the_turntable_turns_about_up_at_a_constant_rate() {
    let points = ellipsoid(DVec3::new(2.0, 1.0, 0.7), DVec3::ZERO);
    let view = seen_from(DVec3::new(1.0, 0.0, 0.5), DVec3::Z).with_turntable(TAU).expect("a view");
    let motion = moving(&view, &points);
    for k in 0..8 {
        let toward_eye = motion.at(f64::from(k) / 8.0, 0.0).view_from_world().matrix3.transpose() * DVec3::Z;
        let angle = TAU * f64::from(k) / 8.0;
        let wanted = DVec3::new(libm::cos(angle), libm::sin(angle), 0.5).normalize();
        assert!(toward_eye.distance(wanted) < 1e-12, "{k}/8 round: {toward_eye}");
    }
}

#[test]
fn keys_orbit_rise_dolly_and_look_at_targets() {
    let points = ellipsoid(DVec3::new(2.0, 1.0, 0.7), DVec3::ZERO);
    let key = |time, orbit, rise, dolly, target| ViewKey { time, orbit, rise, dolly, target };
    let right = TAU / 4.0;
    let keys = vec![
        key(0.0, 0.0, 0.0, 1.0, None),
        key(0.5, right, 0.0, 1.0, None),
        key(1.0, right, right, 0.5, Some(DVec3::new(0.3, 0.0, 0.0))),
    ];
    let view = seen_from(DVec3::X, DVec3::Z).with_keys(keys, Ease::default()).expect("a view");
    let motion = moving(&view, &points);
    let toward_eye = |time: f64| motion.at(time, time).view_from_world().matrix3.transpose() * DVec3::Z;
    assert!(toward_eye(0.0).distance(DVec3::X) < 1e-12);
    assert!(toward_eye(0.5).distance(DVec3::Y) < 1e-12);
    assert!(toward_eye(0.25).distance(DVec3::new(1.0, 1.0, 0.0).normalize()) < 1e-12, "halfway between");
    assert!(toward_eye(1.0).distance(DVec3::Z) < 1e-12, "straight from above, which has no pole");
    let distance = |time: f64, target: DVec3| -motion.at(time, time).view_from_world().transform_point3(target).z;
    let target = DVec3::new(0.3, 0.0, 0.0);
    assert!((distance(1.0, target) / distance(0.0, DVec3::ZERO) - 0.5).abs() < 0.01, "half as far");
    let in_view = motion.at(1.0, 1.0).view_from_world().transform_point3(target);
    assert!(in_view.truncate().length() < 1e-12, "in the middle of the picture: {in_view}");
    // Behind the last key it stays.
    assert_eq!(motion.at(1.0, 7.0), motion.at(1.0, 1.0));
}

#[test]
fn a_target_is_in_the_middle_and_nothing_is_cut_off() {
    let points = ellipsoid(DVec3::new(2.0, 1.0, 0.7), DVec3::ZERO);
    let output = Output::new(640, 480, 1).expect("a size");
    let target = DVec3::new(1.5, 0.2, 0.1);
    for field_of_view in [None, Some(0.0)] {
        let view = with_field_of_view(usual(), field_of_view).with_target(target).expect("a view");
        let camera = Camera::framing(&view, &Extent::of(&points), &output).expect("a view");
        assert!(camera.view_from_world().transform_point3(target).truncate().length() < 1e-12);
        assert!((0.8..0.87).contains(&reach(&camera, &points)), "{}", reach(&camera, &points));
    }
}

#[test]
fn a_camera_knows_where_the_next_one_shows_a_point() {
    let points = ellipsoid(DVec3::new(2.0, 1.0, 0.7), DVec3::ZERO);
    let key = |time, orbit: f64, rise: f64, dolly| ViewKey {
        time,
        orbit: orbit.to_radians(),
        rise: rise.to_radians(),
        dolly,
        target: None,
    };
    for field_of_view in [None, Some(0.0)] {
        let keys = vec![key(0.0, 0.0, 0.0, 1.0), key(1.0, 70.0, 20.0, 1.7)];
        let view = with_field_of_view(usual(), field_of_view).with_keys(keys, Ease::default()).expect("a view");
        let motion = moving(&view, &points);
        let (here, there) = (motion.at(0.0, 0.0), motion.at(1.0, 1.0));
        for &point in points.iter().step_by(100) {
            let carried = here.as_seen_by(&there).transform_point3(point);
            let [a, b] = [bounds(&here, &[carried]), bounds(&there, &[point])];
            assert!((0..2).all(|axis| (a[axis] - b[axis]).abs() < 1e-9), "{a:?} and {b:?}");
        }
    }
}
