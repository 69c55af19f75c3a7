//! Several files as keyframes of lengths and bending angles, arrays as metrics, and fold angles as targets: what frames ask
//! for, and what is said of files that do not fit.

use crate::support::npy::{list, npz, table};
use glam::DVec3;
use immerse::Scene;
use immerse::evolve::Unobserved;
use immerse::immersion::bending_angles;
use immerse::mesh::{Surface, read};
use immerse::metric::lengths_of_positions;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A sheet of two triangles, the second of which is bent up by an angle.
fn sheet(degrees: f64, width: f64) -> String {
    let (c, s) = (degrees.to_radians().cos(), degrees.to_radians().sin());
    format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv {} {} {s}\nf 1 2 3\nf 2 4 3\n", 0.5 + width * c, 0.5 + width * c)
}

fn folder(files: &[(&str, String)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn scene(folder: &Path, text: &str) -> Scene {
    Scene::parse(&format!("[mesh]\nfile = 'pose1.obj'\n[start]\nfrom = 'mesh'\n{text}"), "poses", folder)
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn surface(folder: &Path, name: &str) -> Surface {
    read(&folder.join(name)).unwrap()
}

fn lengths(folder: &Path, name: &str) -> Vec<f64> {
    let surface = surface(folder, name);
    lengths_of_positions(&surface.mesh, surface.positions.as_ref().unwrap())
}

/// The lengths that the frames of a film ask for.
fn frames(scene: &Scene) -> Vec<Vec<f64>> {
    let mut simulation = scene.simulation().unwrap_or_else(|error| panic!("{error}"));
    let frame = |_| simulation.next_frame(&mut Unobserved).unwrap().edge_lengths.clone();
    (0..scene.clock.frames).map(frame).collect()
}

fn poses() -> TempDir {
    folder(&[
        ("pose1.obj", sheet(0.0, 1.0)),
        ("pose2.obj", sheet(0.0, 1.05)),
        ("pose10.obj", sheet(0.0, 1.1)),
        (".pose3.obj", "hidden".into()),
        ("pose.txt", "another".into()),
    ])
}

#[test]
fn meshes_are_keyframes_in_the_order_of_their_numbers() {
    let poses = poses();
    let at = poses.path();
    let [one, two, ten] = ["pose1.obj", "pose2.obj", "pose10.obj"].map(|name| lengths(at, name));
    let expected = vec![one.clone(), two.clone(), ten.clone()];
    for files in ["'pose*.obj'", "['pose1.obj', 'pose2.obj', 'pose10.obj']", "['pose?.obj', 'pose10.obj']"] {
        let scene = scene(at, &format!("[metric]\nfiles = {files}\n[clock]\nframes = 3\n"));
        assert_eq!(frames(&scene), expected, "{files}");
    }
    // At times of their own, and in a film that loops, where the first one comes again.
    let scene_of = |text: &str| scene(at, &format!("[metric]\nfiles = 'pose*.obj'\n{text}"));
    let late = frames(&scene_of("times = [0, 1, 4]\ninterpolation = 'lengths'\n[clock]\nframes = 5\nend = 4\n"));
    assert_eq!([&late[0], &late[1], &late[4]], [&one, &two, &ten]);
    let third: Vec<f64> = two.iter().zip(&ten).map(|(a, b)| a + (b - a) / 3.0).collect();
    assert!(late[2].iter().zip(&third).all(|(a, b)| (a - b).abs() < 1e-12));
    let round = frames(&scene_of("[clock]\nframes = 6\nloop = true\n"));
    assert_eq!([&round[0], &round[2], &round[4]], [&one, &two, &ten]);
    assert!(round[5].iter().zip(&one).zip(&ten).all(|((x, a), b)| *x >= a.min(*b) && *x <= a.max(*b)));
    assert_ne!(round[5], ten);
}

#[test]
fn a_changed_file_changes_the_frames_after_it_alone() {
    let poses = poses();
    let at = poses.path();
    let of = || {
        let scene = scene(at, "[metric]\nfiles = 'pose*.obj'\n[clock]\nframes = 5\n");
        (scene.section_keys(), scene.simulation().unwrap().frame_keys().unwrap())
    };
    let (sections, before) = of();
    fs::write(at.join("pose10.obj"), sheet(0.0, 1.2)).unwrap();
    let (changed, after) = of();
    assert_eq!(before[..3], after[..3], "up to the time of the second file");
    assert!(before[3] != after[3] && before[4] != after[4]);
    assert!(sections["metric"] != changed["metric"] && sections["mesh"] == changed["mesh"]);
    // A new one in the folder is one of them.
    fs::write(at.join("pose3.obj"), sheet(0.0, 1.07)).unwrap();
    assert_ne!(of().0["metric"], changed["metric"]);
}

#[test]
fn files_that_do_not_fit_are_told() {
    let poses = poses();
    let at = poses.path();
    let other = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 1\n";
    fs::write(at.join("bad1.obj"), sheet(0.0, 1.0)).unwrap();
    fs::write(at.join("bad2.obj"), other).unwrap();
    for (text, words) in [
        (
            "[metric]\nfiles = 'bad*.obj'\n[clock]\nframes = 2\n",
            ["bad2.obj", "face 1 has vertices", "same faces"].as_slice(),
        ),
        ("[bending]\nfiles = 'bad*.obj'\n[clock]\nframes = 2\n", &["bad2.obj", "face 1 has vertices"]),
        ("[metric]\nfiles = 'none*.obj'\n[clock]\nframes = 2\n", &["no file matches `none*.obj`"]),
        (
            "[metric]\nfiles = 'none/pose*.obj'\n[clock]\nframes = 2\n",
            &["the folder of `none/pose*.obj` cannot be read"],
        ),
        ("[metric]\nfiles = 'no*/pose.obj'\n[clock]\nframes = 2\n", &["in the name of a folder"]),
        ("[metric]\nfiles = ['pose1.obj', 'pose7.obj']\n[clock]\nframes = 2\n", &["pose7.obj", "cannot be read"]),
        ("[metric]\nfiles = 'pose*.obj'\ntimes = [0, 1]\n[clock]\nframes = 2\n", &["2 times for 3 files"]),
        ("[metric]\nfiles = 'pose*.obj'\n", &["3 files are spread over the clock, which has one frame", "frames = 3"]),
    ] {
        let error = scene(at, text).simulation().map(drop).unwrap_err().to_string();
        for word in words {
            assert!(error.contains(word), "`{word}` is missing in: {error}");
        }
    }
    let parse = |text: &str| Scene::parse(&format!("[mesh]\nfile = 'pose1.obj'\n{text}"), "poses", at);
    for (text, word) in [
        ("[metric]\nfiles = []\n", "`files` is empty"),
        ("[metric]\nfiles = 3\n", "`files` is 3, it must be a string"),
        ("[metric]\ntimes = [0, 1]\n", "`times` are those of `files`"),
        ("[metric]\nfiles = 'a'\ntimes = [1, 0]\n", "out of order"),
        ("[metric]\nfiles = 'a'\nlength = 1\n", "exclude"),
        ("[metric]\nfiles = 'a'\n[[metric.key]]\ntime = 0\n", "both `files` and [[metric.key]]"),
        ("[bending]\nfiles = 'a'\nfrom = 'mesh'\n", "exclude"),
    ] {
        let error = parse(text).map(drop).unwrap_err().to_string();
        assert!(error.contains(word), "{text}: {error}");
    }
}

#[test]
fn bending_angles_follow_poses_and_fold_files() {
    let folded = |name: &'static str, degrees: f64| (name, sheet(degrees, 1.0));
    let poses = folder(&[folded("pose1.obj", 0.0), folded("pose2.obj", 20.0), folded("pose3.obj", 60.0)]);
    let at = poses.path();
    let angles = |name: &str| {
        let surface = surface(at, name);
        let positions: &[DVec3] = surface.positions.as_ref().unwrap();
        bending_angles(&surface.mesh, positions)
    };
    let mesh = surface(at, "pose1.obj").mesh;
    let crease = mesh.edges().find(|e| !mesh.is_boundary_edge(*e)).unwrap();
    let scene = scene(at, "[bending]\nfiles = 'pose*.obj'\namount = 2\n[clock]\nframes = 3\n");
    let bending = scene.program(&scene.surface().unwrap()).unwrap().bending.unwrap();
    assert!(bending.changes());
    for (time, name) in [(0.0, "pose1.obj"), (0.5, "pose2.obj"), (1.0, "pose3.obj")] {
        assert_eq!(bending.at(time).unwrap()[crease.index()], 2.0 * angles(name)[crease.index()], "{name}");
    }
    let between = bending.at(0.75).unwrap()[crease.index()];
    let mean = angles("pose2.obj")[crease.index()] + angles("pose3.obj")[crease.index()];
    assert!((between - mean).abs() < 1e-12 && mean.abs() > 0.1, "{between}, {mean}");

    // The fold angles of a FOLD file, as the mesh and as another file.
    let fold = "{\"vertices_coords\": [[0,0],[1,0],[0,1],[1.5,1.5]], \"faces_vertices\": [[0,1,2],[1,3,2]], \
                \"edges_vertices\": [[1,2]], \"edges_foldAngle\": [-50]}";
    fs::write(at.join("pattern.fold"), fold).unwrap();
    for text in [
        "[mesh]\nfile = 'pose1.obj'\n[bending]\nfile = 'pattern.fold'\n",
        "[mesh]\nfile = 'pattern.fold'\n[bending]\nfrom = 'mesh'\n",
        "[mesh]\nfile = 'pattern.fold'\n[bending]\nfrom = 'mirror'\namount = -1\n",
    ] {
        let scene = Scene::parse(text, "fold", at).unwrap();
        let surface = scene.surface().unwrap();
        let bending = scene.program(&surface).unwrap().bending.unwrap();
        let crease = surface.mesh.edges().find(|e| !surface.mesh.is_boundary_edge(*e)).unwrap();
        let angle = bending.at(0.0).unwrap()[crease.index()];
        assert!((angle - 50.0_f64.to_radians()).abs() < 1e-12, "{text}: a mountain is positive here, {angle}");
        assert!(!bending.changes() && bending.is_asked()[crease.index()]);
    }
}

/// Frames of a FOLD file are keyframes of lengths and of angles, alone and among other files.
#[test]
fn frames_of_a_fold_file_are_keyframes() {
    let frame = |width: f64, degrees: f64| {
        format!(
            "{{\"frame_inherit\": true, \"frame_parent\": 0, \"edges_length\": [1, 1, 1.5, {width}, {width}], \
             \"edges_foldAngle\": [null, null, {degrees}, null, null]}}"
        )
    };
    let film = format!(
        "{{\"faces_vertices\": [[0,1,2],[1,3,2]], \"edges_vertices\": [[0,1],[0,2],[1,2],[1,3],[2,3]], \
         \"edges_length\": [1, 1, 1.5, 1, 1], \"edges_foldAngle\": [null, null, 0, null, null], \
         \"file_frames\": [{}, {}]}}",
        frame(1.25, -20.0),
        frame(1.5, -40.0)
    );
    let other = film.replace("[1,3,2]]", "[1,2,3]]").replace("\"file_frames\"", "\"frames\"");
    let at = folder(&[("film.fold", film), ("other.fold", other)]);
    let scene = |text: &str| Scene::parse(&format!("[mesh]\nfile = 'film.fold'\n{text}"), "film", at.path()).unwrap();
    let of = |text: &str, frame_count: usize| {
        let scene = scene(text);
        let surface = scene.surface().unwrap();
        let mut program = scene.program(&surface).unwrap();
        let mesh = &surface.mesh;
        let between = |u, v| mesh.edges().find(|e| [[u, v], [v, u]].contains(&mesh.file_ends(*e))).unwrap().index();
        let (width, crease) = (between(1, 3), between(1, 2));
        let mut at = |k: usize| {
            let time = k as f64 / (frame_count - 1) as f64;
            let angle = program.bending.as_ref().map_or(0.0, |bending| bending.at(time).unwrap()[crease].to_degrees());
            [program.metric.at(mesh, time).unwrap().metric.edge_lengths()[width], angle.round()]
        };
        (0..frame_count).map(&mut at).collect::<Vec<_>>()
    };
    let both = "[metric]\nfiles = 'film.fold'\n[bending]\nfiles = 'f*.fold'\n[clock]\nframes = 3\n";
    assert_eq!(of(both, 3), [[1.0, 0.0], [1.25, 20.0], [1.5, 40.0]]);
    // One file more has one more.
    let more = "[metric]\nfiles = ['film.fold', 'other.fold']\n[clock]\nframes = 4\n";
    assert_eq!(of(more, 4).iter().map(|[width, _]| *width).collect::<Vec<_>>(), [1.0, 1.25, 1.5, 1.0]);
    // As a mesh or one file it is its key frame.
    assert_eq!(of("[metric]\nfile = 'film.fold'\n[bending]\nfrom = 'mesh'\n[clock]\nframes = 2\n", 2), [[1.0, 0.0]; 2]);
    assert_eq!(of("[clock]\nframes = 2\n", 2), [[1.0, 0.0]; 2]);
    for (text, word) in [
        ("[metric]\nfiles = 'film.fold'\ntimes = [0, 1]\n[clock]\nframes = 3\n", "2 times for 3 frames of files"),
        ("[metric]\nfiles = 'film.fold'\n", "3 frames of files are spread over the clock, which has one frame"),
    ] {
        let error = scene(text).simulation().map(drop).unwrap_err().to_string();
        assert!(error.contains(word), "`{word}` is missing in: {error}");
    }
}

#[test]
fn arrays_are_metrics_of_a_scene() {
    let poses = poses();
    let at = poses.path();
    let (mesh, wanted) = (surface(at, "pose1.obj").mesh, lengths(at, "pose10.obj"));
    let rows: Vec<[f64; 3]> = (mesh.edges().zip(&wanted))
        .map(|(e, length)| {
            let [u, v] = mesh.file_ends(e).map(f64::from);
            [v, u, *length]
        })
        .collect();
    fs::write(at.join("rows.npy"), table(&rows)).unwrap();
    fs::write(at.join("rows.npz"), npz(&[("edge_lengths", table(&rows))])).unwrap();
    fs::write(at.join("frame.npz"), npz(&[("edge_lengths", list(&wanted)), ("time", list(&[0.0]))])).unwrap();
    for name in ["rows.npy", "rows.npz", "frame.npz", "pose10.obj"] {
        assert_eq!(
            frames(&scene(at, &format!("[metric]\nfile = '{name}'\n"))),
            std::slice::from_ref(&wanted),
            "{name}"
        );
    }
    let scene = scene(at, "[metric]\nfile = 'missing.npy'\n");
    assert!(scene.simulation().map(drop).unwrap_err().to_string().contains("missing.npy"));
}
