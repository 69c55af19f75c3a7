//! The meshes of the paper, where the environment variable IMMERSE_PAPER_DATA names a folder that has them
//! (bunny.obj, sphere.obj, torus.obj). The bunny takes longer and wants IMMERSE_PAPER_BUNNY set as well.

use immerse::cli::checks_of;
use immerse::evolve::{FrameReport, Unobserved};
use immerse::scene::{MeshSection, Scene};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The mesh, or `None`, said loudly, if it is not to be had. Not by `eprintln`, which a passing test would swallow.
fn paper_mesh(name: &str) -> Option<PathBuf> {
    let skip = |reason: String| {
        let _ = writeln!(std::io::stderr(), "\nSKIPPED: {name} of the paper was NOT tested: {reason}\n");
        None
    };
    let Some(folder) = std::env::var_os("IMMERSE_PAPER_DATA") else {
        return skip("IMMERSE_PAPER_DATA does not name a folder with the paper's meshes".into());
    };
    let path = PathBuf::from(folder).join(name);
    if name == "bunny.obj" && std::env::var_os("IMMERSE_PAPER_BUNNY").is_none() {
        return skip("it takes half a minute; set IMMERSE_PAPER_BUNNY to test it".into());
    }
    assert!(path.exists(), "{} is not there, but IMMERSE_PAPER_DATA says so", path.display());
    Some(path)
}

/// The relaxed surface by default phases from random frames.
fn relaxed(name: &str, rest: &str) -> Option<FrameReport> {
    let path = paper_mesh(name)?;
    let text = format!("[mesh]\nfile = '{}'\n[start]\nrandom = 0\n{rest}", path.display());
    let mut simulation = crate::support::scene(&text).simulation().expect("a simulation");
    let report = simulation.relax(&mut Unobserved).expect("a frame").report.clone();
    let _ = writeln!(
        std::io::stderr(),
        "{name} {}: {:.3} % in {} steps, {} rims",
        report.spin_class,
        100.0 * report.l2_length_error,
        report.cursor.steps,
        report.rims
    );
    assert_eq!((report.rims, report.pinch_points), (0, 0), "{name}: {report:?}");
    Some(report)
}

#[test]
fn sphere() {
    if let Some(report) = relaxed("sphere.obj", "") {
        assert!(report.l2_length_error <= 0.001, "{report:?}");
    }
}

#[test]
fn torus_of_equal_lengths_in_every_class() {
    for class in ["00", "01", "10", "11"] {
        let rest = format!("[metric]\nlength = 0.05\n[spin]\nclass = '{class}'");
        let Some(report) = relaxed("torus.obj", &rest) else { return };
        assert!(report.l2_length_error <= 0.012, "{class}: {report:?}");
        assert_eq!(report.spin_class, class);
    }
}

#[test]
fn bunny() {
    if let Some(report) = relaxed("bunny.obj", "") {
        assert!(report.l2_length_error <= 0.005, "{report:?}");
    }
}

/// Fig. 20. Takes several minutes.
#[test]
fn bunny_eversion() {
    let Some(path) = paper_mesh("bunny.obj") else { return };
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/bunny_eversion.toml");
    let mut scene = Scene::read(&scene).expect("a scene");
    scene.mesh = MeshSection::File(std::path::absolute(path).expect("a path"));
    let mut simulation = scene.simulation().expect("a simulation");
    let mut report = |_| simulation.next_frame(&mut Unobserved).expect("a frame").report.clone();
    let film: Vec<FrameReport> = (0..scene.clock.frames).map(&mut report).collect();
    for check in checks_of(&scene.checks, &film) {
        eprintln!("{check:?}");
        assert!(check.holds, "{check:?}");
    }
    assert!(film.iter().filter(|report| report.max_move > 0.0).count() >= 120);
}
