//! What a scene asks of its pictures becomes values of the renderer; what is impossible is shown where the scene says it.

use crate::support::scene;
use glam::DVec3;
use immerse::{
    film::{FilmError, Plan},
    render::{Look, LookName, Output, View},
    scene::{Scene, SceneError, build},
};

const BALL: &str = "[mesh]\nshape = 'sphere'\n";

/// The one mistake that the pictures of a scene have.
fn mistake(text: &str) -> SceneError {
    let scene = scene(&format!("{BALL}{text}"));
    match Plan::of(&scene) {
        Err(FilmError::Scene(errors)) => match errors.mistakes() {
            [mistake] => mistake.clone(),
            other => panic!("{text}: {other:?}"),
        },
        other => panic!("{text}: {other:?}"),
    }
}

/// The text that a mistake is shown at.
fn place(mistake: &SceneError) -> &str {
    &mistake.text[mistake.span.0..mistake.span.0 + mistake.span.1]
}

#[test]
fn mistakes_are_shown_where_the_scene_says_them() {
    let parallel = mistake("[camera]\ndirection = [0, 0, 1]\nup = [0, 0, 2]\n");
    assert_eq!((parallel.line, place(&parallel)), (5, "[0, 0, 2]"));
    assert!(
        parallel.reason.contains("is parallel to the direction of view") && parallel.remedy.contains("leave `up` out")
    );

    let tiny = mistake("[camera]\ndirection = [1e-300, 0, 0]\n");
    assert_eq!((tiny.line, place(&tiny)), (4, "[1e-300, 0, 0]"));
    assert!(tiny.reason.contains("has no direction") && tiny.remedy.contains("like [0, 0, 1]"), "{tiny}");

    let light = mistake("[[light]]\ndirection = [0, 0, 1]\n[[light]]\ndirection = [0, 1e-60, 0]\n");
    assert_eq!((light.line, place(&light)), (6, "[0, 1e-60, 0]"));
    assert!(light.remedy.contains("toward the light"), "{light}");

    let matcap = mistake("[look]\nmaterial = 'matcap'\nmatcap = 'nowhere.png'\n");
    assert_eq!((matcap.line, place(&matcap)), (5, "'nowhere.png'"));
    assert!(
        matcap.reason.contains("cannot be read") && matcap.remedy.contains("give a PNG of a lit sphere"),
        "{matcap}"
    );

    let label = mistake("[[look.text]]\ntext = 'fine'\n[[look.text]]\ntext = '{fame}'\n");
    assert_eq!((label.line, place(&label)), (6, "'{fame}'"));
    assert!(label.reason.contains("asks for `{fame}`") && label.remedy.contains("{frame}"), "{label}");
}

/// Scenes made in code are checked too, though no file has been read.
#[test]
fn impossible_values_of_a_scene_made_in_code_are_refused() {
    let refused = |change: fn(&mut Scene)| {
        let mut scene = scene(BALL);
        change(&mut scene);
        Plan::of(&scene).map(|_| ()).expect_err("impossible").to_string()
    };
    assert!(refused(|scene| scene.look.wireframe = Some(f64::NAN)).contains("write 0 for none"));
    assert!(refused(|scene| scene.look.line.rim = Some(-1.0)).contains("0 for no line"));
    assert!(refused(|scene| scene.camera.fill = Some(2.0)).contains("0.05 to 1"));
    assert!(refused(|scene| scene.camera.field_of_view = Some(180.0)).contains("0 to 150"));
    assert!(refused(|scene| scene.output.samples = 3).contains("write 1, 4, 8 or 16"));
    assert!(refused(|scene| scene.output.size = [0, 5]).contains("at least 1"));
    assert!(refused(|scene| scene.output.size = [5, 1 << 40]).contains("at most 16384"));
    assert!(refused(|scene| scene.output.crop = Some([1, 1, usize::MAX, 1])).contains("write a part of it"));
}

#[test]
fn what_a_scene_leaves_out_is_usual() {
    let scene = scene(BALL);
    assert_eq!(build::view(&scene).expect("a view"), View::default());
    assert_eq!(build::look(&scene).expect("a look"), Look::preset(LookName::Studio));
    assert_eq!(build::output(&scene).expect("a size"), Output::new(1280, 960, 8).expect("a size"));
}

#[test]
fn what_a_scene_says_is_what_is_seen() {
    let scene = scene(&format!(
        "{BALL}[camera]\ndirection = [0, -3, 4]\nup = [0, 0, 1]\nfield_of_view = 60\nfill = 0.5\ntarget = [1, 2, 3]\n\
         turntable = 90\n[[camera.key]]\ntime = 0\norbit = 180\n[[camera.key]]\ntime = 2\nrise = -45\ndolly = 3\n"
    ));
    let view = build::view(&scene).expect("a view");
    let direction = view.direction().expect("a direction");
    assert!(direction.distance(DVec3::new(0.0, -0.6, 0.8)) < 1e-15, "{direction}");
    assert_eq!(view.up(), Some(DVec3::Z));
    assert_eq!([view.field_of_view(), view.fill()], [60_f64.to_radians(), 0.5]);
    assert_eq!((view.target(), view.turntable()), (Some(DVec3::new(1.0, 2.0, 3.0)), 90_f64.to_radians()));
    let keys = view.keys().expect("keys").values();
    assert_eq!([keys[0].orbit, keys[0].rise, keys[0].dolly], [180_f64.to_radians(), 0.0, 1.0]);
    assert_eq!([keys[1].orbit, keys[1].rise, keys[1].dolly], [0.0, -45_f64.to_radians(), 3.0]);
}
