//! A simulation goes on after a frame of its own film, and after nothing else.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::support::scene;
use glam::{DQuat, DVec3};
use immerse::algebra::Complex;
use immerse::evolve::{Frame, Progress, ResumeError, Simulation, UnfitFrame, Unobserved};
use immerse::mesh::EdgeId;
use immerse::spin::SpinStructure;

const FILM: &str = "[mesh]\nshape = 'torus'\ncolumns = 12\nrows = 8\n[start]\nfrom = 'mesh'\n\
                    [[metric.change]]\nkind = 'conformal'\nlog_scale = '0.1 * t * x'\n[clock]\nframes = 3\nmax_steps = 5\n";

fn simulation() -> Simulation {
    scene(FILM).simulation().expect("a simulation")
}

fn refused(change: impl FnOnce(&mut Frame)) -> ResumeError {
    let first = simulation().next_frame(&mut Unobserved).expect("a frame");
    let mut frame = Frame::clone(&first);
    change(&mut frame);
    simulation().resume(Arc::new(frame)).expect_err("it is no frame of this film")
}

#[test]
fn arrays_of_another_mesh_are_refused() {
    let counts = [
        refused(|frame| _ = frame.positions.pop()),
        refused(|frame| _ = frame.face_frames.pop()),
        refused(|frame| frame.edge_lengths.push(1.0)),
        refused(|frame| frame.spin = scene("").simulation().expect("a sphere").spin()),
    ];
    for error in counts {
        assert!(matches!(error, ResumeError::Unfit(UnfitFrame::Count { .. })), "{error}");
        assert!(error.to_string().ends_with("take a frame of a film on this mesh"), "{error}");
    }
    let error = refused(|frame| frame.rims.push(EdgeId::new(100_000)));
    assert!(matches!(error, ResumeError::Unfit(UnfitFrame::NoSuchEdge { edge: 100_000, .. })), "{error}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let not_finite = [
        refused(|frame| frame.positions[3] = DVec3::NAN),
        refused(|frame| frame.face_frames[3] = DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0)),
        refused(|frame| frame.edge_lengths[3] = f64::INFINITY),
        refused(|frame| frame.report.energy = f64::NAN),
    ];
    for error in not_finite {
        assert!(matches!(error, ResumeError::Unfit(UnfitFrame::NotFinite { .. })), "{error}");
    }
    let error = refused(|frame| frame.face_frames[3] = DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0));
    assert_eq!(error, ResumeError::Unfit(UnfitFrame::NotUnit { face: 3, length: 2.0 }));
    let error = refused(|frame| frame.edge_lengths[3] = 0.0);
    assert!(matches!(error, ResumeError::Metric(_)), "{error}");
}

#[test]
fn a_frame_of_another_film_is_refused() {
    for number in [0, 4, usize::MAX] {
        let error = refused(|frame| frame.report.frame = number);
        assert!(matches!(error, ResumeError::NoSuchFrame { frame, frames: 3, .. } if frame == number), "{error}");
    }
    let error = refused(|frame| frame.report.time = 0.3);
    assert!(matches!(error, ResumeError::NoSuchFrame { time: 0.3, .. }), "{error}");
    let error = refused(|frame| frame.report.components = vec![Default::default(); 2]);
    assert_eq!(error, ResumeError::Components { found: 2, components: 1 });
    // In another class the film would jump.
    let error = refused(|frame| {
        let simulation = simulation();
        let generator = &simulation.homology().generators()[0];
        let mut spin = simulation.spin();
        spin.flip_along(&generator.path);
        frame.spin = spin;
    });
    assert!(matches!(error, ResumeError::State(_)), "{error}");
}

#[test]
fn a_frame_of_the_film_is_taken() {
    let mut whole = simulation();
    let frames: Vec<Arc<Frame>> = (0..3).map(|_| whole.next_frame(&mut Unobserved).expect("a frame")).collect();
    let mut resumed = simulation();
    resumed.resume(frames[0].clone()).expect("a frame of this film");
    for expected in &frames[1..] {
        let frame = resumed.next_frame(&mut Unobserved).expect("a frame");
        assert!(frame.positions == expected.positions && frame.face_frames == expected.face_frames);
    }
}

#[test]
fn frames_that_are_set_are_checked() {
    let mut simulation = simulation();
    let mut frames = simulation.face_frames();
    simulation.set_face_frames(&frames).expect("its own frames");
    frames[0] = DQuat::from_xyzw(0.0, 3.0, 0.0, 0.0);
    let error = simulation.set_face_frames(&frames).expect_err("not a unit quaternion");
    assert_eq!(error, ResumeError::Unfit(UnfitFrame::NotUnit { face: 0, length: 3.0 }));
    assert!(simulation.set_face_frames(&frames[1..]).is_err());
}

#[test]
fn transports_are_checked_where_they_are_made() {
    let simulation = simulation();
    let transports = simulation.spin().transports().to_vec();
    let mesh = simulation.mesh();
    assert!(SpinStructure::from_transports(mesh, transports.clone()).is_ok());
    assert!(SpinStructure::from_transports(mesh, transports[1..].to_vec()).is_err());
    for wrong in [Complex { re: 0.0, im: 0.0 }, Complex { re: f64::NAN, im: 0.0 }, Complex { re: 1.0, im: 1e-3 }] {
        let mut transports = transports.clone();
        transports[7] = wrong;
        assert!(SpinStructure::from_transports(mesh, transports).is_err(), "{wrong:?}");
    }
}

#[test]
fn a_closure_watches_and_stops() {
    let mut seen = 0;
    let mut watch = |progress: &Progress| {
        seen += 1;
        assert_eq!(progress.step, seen);
        if seen == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let error = simulation().next_frame(&mut watch).expect_err("stopped");
    assert!(error.to_string().contains("stopped after 3 steps"), "{error}");
    assert_eq!(seen, 3);
}
