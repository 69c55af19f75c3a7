//! The same bits on any number of threads.

use crate::support::{program, scene};
use immerse::evolve::{FrameReport, Phase, Unobserved};
use std::fs;

const SCENES: [&str; 3] = [
    "[mesh]\nshape = 'sphere'\nsubdivisions = 16\n[start]\nrandom = 1\n",
    "[mesh]\nshape = 'flat_torus'\ncolumns = 60\nrows = 50\n[spin]\nclass = '01'\n[start]\nrandom = 2\n",
    "[mesh]\nshape = 'uv_sphere'\nmeridians = 60\nparallels = 50\n[start]\nfrom = 'spectral'\n",
];

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

#[test]
fn in_memory() {
    for text in SCENES {
        let relax = || {
            let mut simulation = scene(text).simulation().expect("a simulation");
            assert!(simulation.mesh().face_count() > 4096, "sums must be in more than one piece");
            // A few steps of the first phase, and a few that are accelerated.
            let hurry = |phases: &mut Vec<Phase>| phases.iter_mut().for_each(|phase| phase.max_steps = 4);
            simulation.change_phases(hurry).expect("phases");
            let frame = simulation.advance(18, &mut Unobserved).expect("a frame");
            let bits = |x: f64| x.to_bits();
            let positions: Vec<_> = frame.positions.iter().map(|p| p.to_array().map(bits)).collect();
            let frames: Vec<_> = simulation.face_frames().iter().map(|q| q.to_array().map(bits)).collect();
            (positions, frames, format!("{:?}", FrameReport { seconds: 0.0, ..frame.report.clone() }))
        };
        let one = on_threads(1, relax);
        for threads in [2, 4] {
            assert!(on_threads(threads, relax) == one, "other bits on {threads} threads:\n{text}");
        }
    }
}

#[test]
fn on_disk() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "[mesh]\nshape = 'torus'\n[start]\nrandom = 3\n[[phase]]\nmax_steps = 6\ntolerance = 1e-9\n";
    fs::write(folder.path().join("film.toml"), text).expect("a scene");
    let state = |threads: &str| {
        let (code, _, err) = program(folder.path(), &["simulate", "film.toml", "--out", threads, "--threads", threads]);
        assert_eq!(code, 0, "{err}");
        fs::read(folder.path().join(threads).join("frames/000001.npz")).expect("a state")
    };
    let one = state("1");
    assert!(state("2") == one && state("4") == one);
}
