//! What is found between two surfaces: planted faults, events on a frame, and random motions against dense samples.

use super::{found, hinge, open_to, points};
use crate::support::Random;
use glam::DVec3;
use immerse::homotopy::{Element, Event, Homotopy, events_between};
use immerse::mesh::{EdgeId, Mesh, SurfaceError, shapes};
use std::cmp::Ordering::{Equal, Greater, Less};

#[test]
fn a_hinge_that_folds_over_is_found_and_one_that_only_flattens_is_not() {
    let mesh = hinge();
    let [up, down] = [open_to(0.5, 0.25), open_to(0.5, -0.5)];
    let [event] = found(&mesh, &up, &down)[..] else { panic!("one event") };
    let Element::Hinge(edge) = event.element else { panic!("a hinge") };
    assert_eq!(mesh.edge_vertices(edge).map(|v| v.index()), [0, 1]);
    assert_eq!(event.element.vertices(&mesh).iter().map(|v| v.index()).collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert!(event.time[0] <= 1.0 / 3.0 && 1.0 / 3.0 <= event.time[1] && event.time[1] - event.time[0] < 1e-8);
    assert!(event.place.distance(DVec3::X * 0.5) < 1e-15 && !event.lasts);
    assert_eq!(event.sides[0], event.sides[1].reverse());
    // Flat and open, which is no event.
    assert_eq!(found(&mesh, &open_to(-0.5, 0.25), &open_to(-0.5, -0.5)), []);
    assert_eq!(found(&mesh, &open_to(-0.5, 0.0), &open_to(-0.7, 0.0)), []);
}

/// A hinge that folds over and back between two frames, so that neither of them shows it; and one that only touches.
#[test]
fn what_folds_and_opens_again_is_found() {
    let mesh = hinge();
    let moves = |c: [f64; 2], d: [f64; 2]| points(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, c[0], c[1]], [0.5, d[0], d[1]]]);
    // Seen along the edge, c = (1, t) and d = (2 − t, 1/4 + h t): v = c × d = t² − (2 − h) t + 1/4, with roots 1 − h/2 ± √((2 − h)² − 1) / 2.
    for (h, count, sides) in [(0.875, 2, Some([Greater, Less])), (1.0, 1, Some([Greater, Greater])), (1.5, 0, None)] {
        let events = found(&mesh, &moves([1.0, 0.0], [2.0, 0.25]), &moves([1.0, 1.0], [1.0, 0.25 + h]));
        assert_eq!(events.len(), count, "{h}: {events:?}");
        let signs = |event: &Event| [event.sides[0], event.sides[1]];
        let first = events.first().map(signs);
        let reversed = sides.map(|[a, b]: [std::cmp::Ordering; 2]| [a.reverse(), b.reverse()]);
        assert!(first == sides || first == reversed, "{h}: {events:?}");
    }
    let [touch] = found(&mesh, &moves([1.0, 0.0], [2.0, 0.25]), &moves([1.0, 1.0], [1.0, 1.25]))[..] else { panic!() };
    assert_eq!(touch.time, [0.5; 2], "a double root at a half is known exactly");
}

#[test]
fn a_face_through_zero_is_found_however_short_it_lasts() {
    let mesh = Mesh::from_faces(3, &[[0, 1, 2]]).expect("a face");
    let with = |x: f64, y: f64, z: f64| points(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [x, y, z]]);
    let events = found(&mesh, &with(0.2, 0.75, 1.5), &with(0.7, -0.25, -0.5));
    assert_eq!(events.len(), 1);
    assert_eq!((events[0].time, events[0].lasts), ([0.75; 2], false));
    assert!(matches!(events[0].element, Element::Face(_)));
    // Missed by the smallest number that there is.
    assert_eq!(found(&mesh, &with(0.2, 0.75, 1.5), &with(0.7, -0.25, (-0.5_f64).next_up())), []);
    // A third is no floating point number, and it vanishes there all the same.
    let [event] = found(&mesh, &with(0.2, 0.5, 2.0), &with(0.7, -1.0, -4.0))[..] else { panic!("one event") };
    assert!(event.time[0] < 1.0 / 3.0 && 1.0 / 3.0 < event.time[1]);
    let [event] = found(&mesh, &with(0.2, 0.0, 0.0), &with(0.7, 0.0, 0.0))[..] else { panic!("one event") };
    assert!(event.lasts && event.time == [0.0, 1.0]);
}

/// A flat fan that turns over in its plane stays flat, so that no volume tells; what is folded there lasts.
#[test]
fn what_stays_in_a_plane_is_decided_by_its_normals() {
    let mesh = hinge();
    let [event] = found(&mesh, &open_to(0.5, 0.0), &open_to(0.25, 0.0))[..] else { panic!("one event") };
    assert!(event.lasts && event.time == [0.0, 1.0] && matches!(event.element, Element::Hinge(_)));
    let events = found(&mesh, &open_to(-0.5, 0.0), &open_to(0.5, 0.0));
    let kinds: Vec<(bool, [f64; 2])> = events.iter().map(|event| (event.lasts, event.time)).collect();
    assert_eq!(
        kinds,
        [(true, [0.5, 1.0]), (false, [0.5; 2])],
        "the face vanishes at a half, and from then on it is folded"
    );
}

/// An event on a frame exactly belongs to the interval before, once; its sides come from both.
#[test]
fn an_event_on_a_frame_counts_once() {
    let mesh = hinge();
    let film = |frames: &[Vec<DVec3>]| {
        let mut film = Homotopy::new(&mesh);
        frames.iter().for_each(|frame| film.append(frame.clone()).expect("positions"));
        film.events().iter().map(|event| (event.interval, event.event.time, event.passes())).collect::<Vec<_>>()
    };
    let [up, flat, down] = [open_to(0.5, 0.5), open_to(0.5, 0.0), open_to(0.5, -0.5)];
    assert_eq!(film(&[up.clone(), flat.clone(), down.clone()]), [(0, [1.0; 2], true)]);
    assert_eq!(film(&[up.clone(), flat.clone(), up.clone()]), [(0, [1.0; 2], false)]);
    assert_eq!(film(&[flat.clone(), down.clone()]), [(0, [0.0; 2], false)]);
    assert_eq!(film(&[up.clone(), flat.clone()]), [(0, [1.0; 2], false)]);
    let events = [(0, [1.0; 2], false), (1, [0.0, 1.0], false)];
    assert_eq!(film(&[up.clone(), flat.clone(), flat.clone(), down]), events);
    assert_eq!(film(&[up]), []);
}

#[test]
fn positions_of_another_mesh_or_out_of_reach_are_refused() {
    let mesh = hinge();
    let mut film = Homotopy::new(&mesh);
    assert!(matches!(film.append(vec![DVec3::ZERO; 3]), Err(SurfaceError::Count { found: 3, expected: 4, .. })));
    let mut lost = open_to(0.5, 0.5);
    lost[2].y = f64::NAN;
    assert!(matches!(film.append(lost), Err(SurfaceError::OutOfReach { vertex: 2, .. })));
    assert_eq!(film.frame_count(), 0);
}

/// Rigid motions fold nothing on straight lines, unless they turn by 180°. A mirror image does, along the contours of the torus.
#[test]
fn rigid_motions_are_harmless() {
    let surface = shapes::torus(1.0, 0.4, 18, 10).expect("a torus");
    let (mesh, from) = (&surface.mesh, surface.positions.as_deref().expect("positions"));
    let turned = |degrees: f64| {
        let turn = glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -2.0) / 3.0, degrees.to_radians());
        from.iter().map(|p| turn * *p + DVec3::new(3.0, -1.0, 2.0)).collect::<Vec<_>>()
    };
    assert_eq!(found(mesh, from, &turned(0.0)), []);
    assert_eq!(found(mesh, from, &turned(120.0)), []);
    assert_eq!(found(mesh, from, &turned(179.0)), []);
    let mirrored: Vec<DVec3> = from.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect();
    let events = found(mesh, from, &mirrored);
    assert_eq!(events.len(), 2 * 18);
    assert!(events.iter().all(|event| event.time == [0.5; 2]), "all of it is flat at a half");
}

/// The volume and the product of normals of a hinge at a time, in floating point numbers.
fn sample(corners: [[DVec3; 2]; 4], time: f64) -> [f64; 2] {
    let [a, b, c, d] = corners.map(|[from, to]| from.lerp(to, time));
    let (m, n) = ((b - a).cross(c - a), (a - b).cross(d - b));
    [m.dot(d - a), m.dot(n)]
}

/// Random hinges: wherever samples fold over, an event is found, and every event is a root of the volume where normals are opposite.
#[test]
fn random_hinges_fold_where_samples_say_so() {
    let mesh = hinge();
    let mut random = Random::new(17);
    let (mut events_in_all, mut decided_by_samples) = (0, 0);
    for _ in 0..3000 {
        let places = [0; 4].map(|_| [random.vector(), random.vector()]);
        let [from, to] = [0, 1].map(|when| places.map(|place| place[when]).to_vec());
        let events = found(&mesh, &from, &to);
        events_in_all += events.len();
        for event in &events {
            assert!(matches!(event.element, Element::Hinge(_)), "no random face vanishes");
            let [[before, p], [after, q]] = event.time.map(|time| sample(places, time));
            assert!(p < 0.0 && q < 0.0 && before * after <= 1e-25, "{event:?}: {before:e} {after:e}");
        }
        let samples: Vec<[f64; 2]> = (0..=200).map(|k| sample(places, f64::from(k) / 200.0)).collect();
        for (k, pair) in samples.windows(2).enumerate() {
            let [[v, p], [w, q]] = [pair[0], pair[1]];
            if v * w < 0.0 && p < -1e-9 && q < -1e-9 {
                let here = [k as f64 / 200.0, (k + 1) as f64 / 200.0];
                let is_found = |event: &Event| event.time[1] >= here[0] && event.time[0] <= here[1];
                assert!(events.iter().any(is_found), "{here:?}: {events:?}");
                decided_by_samples += 1;
            }
        }
    }
    assert!(decided_by_samples > 1000 && events_in_all >= decided_by_samples, "{decided_by_samples} {events_in_all}");
}

/// The same events in the same order on any number of threads.
#[test]
fn threads_do_not_matter() {
    let surface = shapes::torus(1.0, 0.4, 60, 40).expect("a torus");
    let (mesh, from) = (&surface.mesh, surface.positions.as_deref().expect("positions"));
    let mut random = Random::new(3);
    let to: Vec<DVec3> = from.iter().map(|p| *p + random.vector() * 0.1).collect();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| events_between(mesh, from, &to))
    };
    let alone = on(1);
    assert!(alone.len() > 100, "{}", alone.len());
    assert_eq!(alone, on(3));
    assert!(alone.iter().all(|event| !event.sides.contains(&Equal)));
    assert!(mesh.edge_vertices(EdgeId(0))[0].index() < mesh.vertex_count());
}
