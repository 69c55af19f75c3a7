//! The number of the algorithm goes up when results change, so that no film goes on with frames of another way.

use immerse::Scene;
use immerse::digest::Key;
use immerse::evolve::{ALGORITHM, Unobserved};
use std::path::Path;

/// Small films of each kind: from random frames on a surface with handles, of the relaxation, of a flow, with pins and bending, in
/// a loop, of every class, polished on every frame.
const FILMS: [&str; 7] = [
    "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 8\n[start]\nrandom = 1\n",
    "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[clock]\nframes = 3\nsteps_per_frame = 4\n",
    "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[start]\nfrom = 'mesh'\nformula = ['1.3*x', 'y', 'z']\n[metric]\npositions = ['1.3*x', 'y', 'z']\n\
     [[metric.change]]\nkind = 'ricci'\namount = { times = [0, 1], values = [0, 1] }\n[clock]\nframes = 3\n",
    "[mesh]\nshape = 'cylinder'\ncolumns = 16\nrows = 6\n[start]\nfrom = 'mesh'\n[[pin]]\nboundary = [0]\n[[pin]]\nboundary = [1]\n\
     motion = { times = [0, 1], translations = [[0, 0, 0], [0, 0, -0.2]] }\n[bending]\nfrom = 'mesh'\namount = '1 - 0.5*t'\n\
     [clock]\nframes = 3\n",
    "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[[metric.change]]\nkind = 'conformal'\nlog_scale = '0.1*z*cos(2*PI*t)'\n\
     [clock]\nframes = 4\nloop = true\n",
    "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 8\n[spin]\nclass = 'all'\n",
    "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[start]\nfrom = 'mesh'\n[[metric.change]]\nkind = 'conformal'\nlog_scale = '0.2*z*x*t'\n\
     [clock]\nframes = 3\n[polish]\nenabled = true\n",
];

/// [`ALGORITHM`], and a key of what these films are with it.
const KNOWN: (u32, &str) = (4, "846d48c31545e0a7ebcda278b0cc0f3f3b0344738cf03a689fb44283983f99ff");

#[test]
fn results_are_those_of_this_algorithm() {
    let mut bytes = Vec::new();
    for text in FILMS {
        let scene = Scene::parse(text, "test", Path::new(".")).unwrap_or_else(|error| panic!("{text}: {error}"));
        let mut simulation = scene.simulation().unwrap_or_else(|error| panic!("{text}: {error}"));
        let keys = simulation.frame_keys().unwrap_or_else(|error| panic!("{text}: {error}"));
        for _ in keys {
            let frame = simulation.next_frame(&mut Unobserved).unwrap_or_else(|error| panic!("{text}: {error}"));
            let numbers = frame.positions.iter().flat_map(|p| p.to_array());
            let numbers = numbers.chain(frame.face_frames.iter().flat_map(|q| q.to_array()));
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
    }
    let found = Key::of_bytes(&bytes).to_string();
    assert_eq!(
        (ALGORITHM, found.as_str()),
        KNOWN,
        "Results have changed. If they are to, raise ALGORITHM in src/evolve/ahead/keys.rs and write what was found here."
    );
}

/// Films with the same key have the same frame, and those of different scenes have different keys.
#[test]
fn keys_tell_films_apart() {
    let keys = |text: &str| {
        let scene = Scene::parse(text, "test", Path::new(".")).unwrap_or_else(|error| panic!("{text}: {error}"));
        scene.simulation().unwrap_or_else(|error| panic!("{text}: {error}")).frame_keys().expect("keys")
    };
    let film = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[metric]\nformula = 'length*(1 + 0.2*t*z^2)'\n[clock]\nframes = 4\n";
    let known = keys(film);
    assert_eq!(known, keys(&format!("{film}[look]\npreset = 'soap'\n")));
    assert_eq!(known.iter().collect::<std::collections::BTreeSet<_>>().len(), 4);
    // What all frames depend on, and what comes in later.
    for (from, to, kept) in [
        ("subdivisions = 3", "subdivisions = 4", 0),
        ("[clock]", "[clock]\ntolerance = 0.006", 0),
        ("[clock]", "[clock]\nmax_strain = 0.04", 0),
        ("[clock]", "[clock]\nloop = true", 0),
        ("[clock]", "[start]\nrandom = 1\n[clock]", 0),
        ("[clock]", "[[phase]]\nindex = 5\ndt = 11\n[clock]", 0),
        ("[clock]", "[[pin]]\nvertices = [0]\n[clock]", 0),
        ("0.2*t", "(0.2*t + 0.3*max(0, t - 0.5))", 2),
        ("frames = 4", "frames = 3\nend = 0.6666666666666666", 3),
    ] {
        let other = keys(&film.replace(from, to));
        let same = known.iter().zip(&other).take_while(|(a, b)| a == b).count();
        assert_eq!(same, kept, "{to}");
        assert!(known[kept..].iter().all(|key| !other[kept.min(other.len())..].contains(key)), "{to}");
    }
}
