//! Every scene that ships can be read, sets up, and has a metric and places for its pins at all its times.

use immerse::scene::{ChangeKind, MeshSection, Scene};
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

/// Frames of a flow that are asked for: it is the same flow in as many as its scene has, which take minutes.
const FRAMES_OF_A_FLOW: usize = 4;

#[test]
fn all_scenes_are_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let scenes: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
    assert!(scenes.len() > 25, "only {} scenes", scenes.len());
    scenes.par_iter().for_each(|path| {
        let name = path.display();
        let text = fs::read_to_string(path).expect("a text");
        assert!(text.starts_with("# "), "{name} does not say what it shows");
        let mut scene = Scene::read(path).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        if scene.metric.changes.iter().any(|change| matches!(change.kind, ChangeKind::Ricci(_))) {
            scene.clock.frames = scene.clock.frames.min(FRAMES_OF_A_FLOW);
        }
        match scene.surface() {
            Ok(surface) => {
                let mut simulation = scene.simulation_of(surface).unwrap_or_else(|error| panic!("{name}: {error}"));
                simulation.frame_keys().unwrap_or_else(|error| panic!("{name}: {error}"));
            }
            // The user brings the mesh.
            Err(error) => {
                let MeshSection::File(file) = &scene.mesh else { panic!("{name}: {error}") };
                assert!(!scene.resolve(file).exists(), "{name}: {error}");
                assert!(name.to_string().ends_with("bunny_eversion.toml"), "{name}: {error}");
                eprintln!("SKIPPED: {name}, whose mesh {} is not here", file.display());
            }
        }
    });
}
