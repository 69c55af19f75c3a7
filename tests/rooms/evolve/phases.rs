//! The phases of a scene: what they are, how a scene changes one of them, and the one number that people want.

use crate::support::{is_at, program, scene};
use immerse::evolve::{Phase, Schedule, TimeStep, Unobserved};
use immerse::frames::Method;
use immerse::immersion::bending_angles;
use immerse::mesh::VertexId;
use immerse::scene::{PhaseSection, Scene, SceneError};

const SPHERE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n";
const FACES: usize = 320;

fn phases(text: &str) -> Vec<Phase> {
    scene(&format!("{SPHERE}{text}")).schedule().expect("phases").phases().to_vec()
}

/// The scene, and what is wrong with it.
fn mistake(text: &str) -> (Scene, SceneError) {
    let scene = scene(&format!("{SPHERE}{text}"));
    let error = scene.schedule().expect_err("a mistake");
    (scene, error)
}

#[test]
fn one_default_phase_is_changed_and_the_others_stay() {
    let defaults = phases("");
    assert_eq!(defaults.len(), 5);
    let changed = phases("[[phase]]\nindex = 2\nepsilon = [1, 0.2, 1, 0.1]\nmax_steps = 77\n");
    let mut expected = defaults.clone();
    (expected[1].stiffness, expected[1].max_steps) = ([1.0, 0.2, 1.0, 0.1], 77);
    assert_eq!(changed, expected);
    // In any order, with `like` or without.
    let both = phases(
        "[[phase]]\nindex = 5\nlike = 'default'\ntolerance = 0.5\n[[phase]]\nindex = 1\nmethod = 'newton'\nturn = 2\n",
    );
    (expected[1], expected[4].tolerance_radians) = (defaults[1], 0.5_f64.to_radians());
    (expected[0].method, expected[0].turn_radians) = (Method::Newton, Some(2.0_f64.to_radians()));
    assert_eq!(both, expected);
    // Without a word about it nothing changes.
    assert_eq!(phases("[[phase]]\nindex = 3\n"), defaults);
    assert_eq!(phases("[[phase]]\nlike = 'default'\n"), defaults);
    let stiffer = scene(&format!("{SPHERE}[bending]\nbending_stiffness = 0.1\n"));
    assert_eq!((stiffer.bending, stiffer.relaxation.bending_stiffness), (None, Some(0.1)), "no target angles");
    assert_eq!(scene(SPHERE).schedule().unwrap(), Schedule::default());
}

#[test]
fn all_default_phases_are_changed_and_others_stand_beside_them() {
    let defaults = phases("");
    let all = phases("[[phase]]\nlike = 'default'\ncrease = 7\n");
    assert_eq!(all.len(), 5);
    assert!(all.iter().zip(&defaults).all(|(a, b)| *a == Phase { crease: 7.0, ..*b }));
    // What is said of one counts more than what is said of all, whatever comes first.
    let one = phases("[[phase]]\nindex = 4\ncrease = 1\n[[phase]]\nlike = 'default'\ncrease = 7\n");
    assert_eq!(one.iter().map(|phase| phase.crease).collect::<Vec<_>>(), [7.0, 7.0, 7.0, 1.0, 7.0]);
    // A phase of its own before, behind, or in place of them.
    let more = phases("[[phase]]\ndt = 3\n[[phase]]\nlike = 'default'\n[[phase]]\ndt = 4\n");
    let [three, four] = [3.0, 4.0].map(TimeStep::FaceAreas);
    assert_eq!((more.len(), more[0].dt, more[6].dt, &more[1..6]), (7, three, four, &defaults[..]));
    assert_eq!(phases("[[phase]]\ndt = 3\n"), [Phase { dt: three, ..Phase::default() }]);
    // From a shape there is but one, the last.
    let from_mesh = phases("[start]\nfrom = 'mesh'\n[[phase]]\nindex = 1\nmax_steps = 5\n");
    assert_eq!(from_mesh, [Phase { max_steps: 5, ..Phase::default() }]);
}

#[test]
fn mistakes_have_their_place_and_a_remedy() {
    let index = |k: usize| format!("[[phase]]\nindex = {k}\n");
    for (text, key, part) in [
        (index(6), "phase[0].index", "there are 5; write `index` from 1 to 5"),
        (format!("[start]\nfrom = 'mesh'\n{}", index(2)), "phase[0].index", "start from a shape have but one"),
        (index(2) + &index(2), "phase[1].index", "changed twice"),
        (index(2) + "[[phase]]\ndt = 3\n", "phase[1]", "give it an `index`"),
        ("[[phase]]\nlike = 'default'\n[[phase]]\nlike = 'default'\n".into(), "phase[1].like", "give one an `index`"),
        (index(2) + "max_steps = 1\n", "phase[0]", "`min_steps` of default phase 2 is then 3"),
        (
            "[[phase]]\nepsilon = [1, 0.3, 1, 1]\n[bending]\nbending_stiffness = 0.1\n".into(),
            "bending.bending_stiffness",
            "remove one of them",
        ),
        (
            "[[phase]]\nindex = 5\nepsilon = [1, 0.3, 1, 1]\n[bending]\nbending_stiffness = 0.1\n".into(),
            "bending.bending_stiffness",
            "remove one of them",
        ),
    ] {
        let (scene, error) = mistake(&text);
        let message = error.to_string();
        assert!(is_at(&scene, key, &error), "{text}: {message}");
        assert!(message.contains(part) && message.contains("; "), "{text}: {message}");
    }
    for (text, part) in [
        ("[[phase]]\nindex = 0\n", "`index` is 0, it must be an integer at least 1"),
        ("[[phase]]\nlike = 'defaults'\n", "there is no like `defaults`"),
        ("[bending]\nbending_stiffness = -1\n", "at least 0"),
        ("[bending]\nstiffness = 1\n", "bending_stiffness"),
        ("[bending]\nbending_stiffness = 1\namount = 2\n", "says no angles"),
        ("[bending]\n", "says no angles"),
    ] {
        let error = Scene::parse(&format!("{SPHERE}{text}"), "test", "".as_ref()).expect_err("a mistake");
        assert!(error.to_string().contains(part), "{error}");
    }
    // The program shows the line.
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("six.toml"), format!("{SPHERE}[[phase]]\nindex = 6\n")).unwrap();
    let (code, _, err) = program(folder.path(), &["check", "six.toml"]);
    assert!(code == 2 && err.contains("six.toml:5") && err.contains("from 1 to 5"), "{err}");
}

#[test]
fn the_stiffness_is_that_of_the_last_phase_and_least_of_all_others() {
    let bending = |text: &str| phases(text).iter().map(|phase| phase.stiffness[1]).collect::<Vec<_>>();
    assert_eq!(bending(""), [1.0, 0.1, 0.01, 1e-3, 1e-4]);
    assert_eq!(bending("[bending]\nbending_stiffness = 0.005\n"), [1.0, 0.1, 0.01, 0.005, 0.005]);
    assert_eq!(bending("[bending]\nbending_stiffness = 0.5\n"), [1.0, 0.5, 0.5, 0.5, 0.5]);
    assert_eq!(bending("[bending]\nbending_stiffness = 0\n"), [1.0, 0.1, 0.01, 1e-3, 0.0]);
    assert_eq!(bending("[start]\nfrom = 'mesh'\n[bending]\nbending_stiffness = 0.02\n"), [0.02]);
    assert_eq!(bending("[[phase]]\ndt = 3\n[bending]\nbending_stiffness = 0.02\n"), [0.02]);
    let other = "[[phase]]\nindex = 2\nepsilon = [1, 0.2, 1, 1]\n[bending]\nbending_stiffness = 0.02\n";
    assert_eq!(bending(other), [1.0, 0.2, 0.02, 0.02, 0.02]);
}

/// It is all that somebody has to write who wants a smoother surface; the phases that resolve rims stay.
#[test]
fn asking_for_more_bending_keeps_random_starts_relaxing() {
    for mesh in ["shape = 'torus'\ncolumns = 24\nrows = 16", "shape = 'sphere'\nsubdivisions = 8"] {
        for (stiffness, accuracy) in [(0.001, 0.02), (0.01, 0.08)] {
            let scene =
                scene(&format!("[mesh]\n{mesh}\n[start]\nrandom = 1\n[bending]\nbending_stiffness = {stiffness}\n"));
            let mut simulation = scene.simulation().unwrap();
            let report = &simulation.relax(&mut Unobserved).unwrap().report;
            let what = format!("{mesh} with {stiffness}: {:.4}", report.l2_length_error);
            assert_eq!((report.rims, report.pinch_points, report.cursor.restarts), (0, 0, 0), "{what}");
            assert!(report.l2_length_error < accuracy, "{what}");
        }
    }
}

/// A disk that is asked to fold along a diameter comes closer the stiffer it is, and so does every frame of a film.
#[test]
fn target_angles_are_reached_better_with_more_stiffness() {
    let angles = |stiffness: f64, clock: &str| -> Vec<f64> {
        let text = format!(
            "[mesh]\nshape = 'disk'\nrings = 8\n[start]\nfrom = 'mesh'\n[bending]\nbending_stiffness = \
             {stiffness}\n[[bending.region]]\nbox = [[-2, -1e-6, -1], [2, 1e-6, 1]]\nangle = 40\n{clock}"
        );
        let scene = scene(&text);
        let mut simulation = scene.simulation().unwrap();
        let surface = scene.surface().unwrap();
        let places = surface.places().unwrap();
        let mesh = simulation.mesh().clone();
        let is_on_crease = |v: &VertexId| places[v.index()].y.abs() < 1e-6;
        let crease: Vec<usize> =
            mesh.edges().filter(|&e| mesh.edge_vertices(e).iter().all(is_on_crease)).map(|e| e.index()).collect();
        assert_eq!(crease.len(), 16);
        (0..scene.clock.frames)
            .map(|_| {
                let frame = simulation.next_frame(&mut Unobserved).unwrap();
                let found = bending_angles(&mesh, &frame.positions);
                let off = crease.iter().map(|&e| (found[e].to_degrees() - 40.0).powi(2)).sum::<f64>();
                (off / crease.len() as f64).sqrt()
            })
            .collect()
    };
    let off = [1e-4, 1e-2, 0.3].map(|stiffness| angles(stiffness, "")[0]);
    assert!(off[2] < 0.8 * off[1] && off[1] < 0.8 * off[0], "{off:?} degrees off");
    let film = "[clock]\nframes = 3\n[metric]\nformula = 'length * (1 + 0.02 * t)'\n";
    let [soft, stiff] = [1e-4, 0.3].map(|stiffness| angles(stiffness, film));
    assert!(soft.iter().zip(&stiff).all(|(soft, stiff)| *stiff < 0.8 * soft), "{soft:?}, {stiff:?}");
}

#[test]
fn printed_phases_can_be_pasted_and_change_nothing() {
    let folder = tempfile::TempDir::new().unwrap();
    for (k, more) in [
        "",
        "[[phase]]\nindex = 2\nturn = 1.5\nmethod = 'gradient'\n",
        "[bending]\nbending_stiffness = 1e-5\n",
        "[start]\nfrom = 'mesh'\n",
    ]
    .into_iter()
    .enumerate()
    {
        let text = format!("{SPHERE}{more}");
        let name = format!("scene{k}.toml");
        std::fs::write(folder.path().join(&name), &text).unwrap();
        let (code, printed, err) = program(folder.path(), &["check", &name, "--phases"]);
        assert_eq!((code, err.as_str()), (0, ""));
        assert!(printed.contains("[[phase]]") && printed.contains("epsilon = [1.0, "), "{printed}");
        let without = if more.contains("[[phase]]") { SPHERE } else { &text };
        let pasted = scene(&format!("{without}{printed}"));
        // Printed for this mesh, steps are in units of its mean face area.
        let printed_as = |phase: &Phase| Phase { dt: TimeStep::FaceAreas(phase.dt.in_face_areas(FACES)), ..*phase };
        let usual: Vec<Phase> = scene(&text).schedule().unwrap().phases().iter().map(printed_as).collect();
        let section = |&phase: &Phase| PhaseSection { phase, like: None };
        assert_eq!(pasted.phases, usual.iter().map(section).collect::<Vec<_>>(), "as printed: {printed}");
        assert_eq!(pasted.schedule().unwrap().phases(), usual);
    }
    let (code, _, err) = program(folder.path(), &["check", "nothing.toml", "--phases"]);
    assert!(code == 2 && err.contains("there is no such file"), "{err}");
    let (_, schema, _) = program(folder.path(), &["schema"]);
    for word in ["bending_stiffness", "\"index\"", "\"like\"", "max_unconverged", "check SCENE --phases"] {
        assert!(schema.contains(word), "{word} in the schema");
    }
}
