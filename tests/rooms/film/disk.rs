//! The folder of a film: what comes back, what is refused, what a resume may skip.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use glam::{DQuat, DVec3};
use immerse::algebra::Complex;
use immerse::digest::Key;
use immerse::evolve::{BendingError, ComponentReport, Cursor, Frame, FrameReport};
use immerse::film::{DiskError, FilmFolder, FilmMesh, FilmSpec, clear_film};
use immerse::mesh::{EdgeId, Mesh, VertexId};
use immerse::scene::ChecksSection;
use immerse::spin::SpinStructure;

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

fn tetrahedron() -> Mesh {
    Mesh::from_faces(4, &TETRAHEDRON).unwrap()
}

/// What is kept of the tetrahedron.
fn kept(places: Option<&Vec<DVec3>>) -> FilmMesh {
    FilmMesh { places: places.cloned(), ..FilmMesh::of(Arc::new(tetrahedron())) }
}

fn film() -> FilmSpec {
    let checks = ChecksSection { max_rims: Some(0), ..Default::default() };
    FilmSpec { scene: "test".into(), sections: Default::default(), keys: keys(0, 4), checks, text: String::new() }
}

/// Of so many frames; the same number makes the same film.
fn keys(film: u8, frames: u8) -> Vec<Key> {
    (1..=frames).map(|frame| Key::of_bytes(&[film, frame])).collect()
}

fn open(folder: &Path, film: &FilmSpec, mesh: &FilmMesh) -> Result<FilmFolder, DiskError> {
    FilmFolder::open_or_create(folder, film, mesh).map(|(film, _)| film)
}

fn state(frame: usize) -> Frame {
    let x = |i: usize| (i * 37 + frame * 101) as f64 / 7.0;
    let transports = (0..6).map(|i| [Complex { re: -0.6, im: 0.8 }, Complex { re: 1.0, im: -0.0 }][(i + frame) % 2]);
    Frame {
        positions: (0..4).map(|i| DVec3::new(x(i), -x(i + 1), 1e-300 * x(i))).collect(),
        face_frames: (0..4).map(|i| DQuat::from_xyzw(x(i), 2.0, 3.0, x(i + 2)).normalize()).collect(),
        spin: SpinStructure::from_transports(&tetrahedron(), transports.collect()).unwrap(),
        edge_lengths: (0..6).map(x).collect(),
        rims: [0, 3].map(EdgeId::new).to_vec(),
        report: FrameReport {
            frame,
            time: frame as f64 / 24.0,
            l2_length_error: 0.0123456789012345,
            spin_class: "01".into(),
            converged: true,
            ..Default::default()
        },
    }
}

/// A film with three of its four frames done.
fn cache(folder: &Path) -> FilmFolder {
    let cache = open(folder, &film(), &kept(None)).unwrap();
    for frame in 1..=3 {
        cache.write_frame(&state(frame)).unwrap();
    }
    cache
}

fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for folder in [folder.to_owned(), folder.join("frames")] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                all.push((path.display().to_string(), fs::read(&path).unwrap()));
            }
        }
    }
    all.sort();
    all
}

#[test]
fn what_was_written_comes_back_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("renders/test");
    let written = cache(&dir);
    let cache = FilmFolder::open(&dir).unwrap();
    assert_eq!(cache.manifest(), written.manifest());
    assert_eq!(cache.mesh().unwrap().mesh.triangles(), TETRAHEDRON);
    let counts = cache.manifest().mesh;
    assert_eq!([counts.vertices, counts.edges, counts.faces, counts.genus, counts.boundaries], [4, 6, 4, 0, 0]);
    assert_eq!(cache.manifest().checks, film().checks);
    for frame in 1..=3 {
        let read = cache.read_frame(frame).unwrap();
        assert_eq!(read, state(frame));
        let bits = |state: &Frame| {
            let transports = state.spin.transports().iter();
            transports.flat_map(|t| [t.re, t.im]).map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(bits(&read), bits(&state(frame)));
        assert_eq!(cache.read_report(frame).unwrap(), state(frame).report);
    }
    assert_eq!(cache.frames().unwrap(), [1, 2, 3]);
    assert_eq!(cache.valid_frames().unwrap(), [true, true, true, false]);
    assert!(matches!(cache.read_frame(4), Err(DiskError::Missing { .. })));
    assert!(contents(&dir).iter().all(|(name, _)| !name.ends_with(".part")));
}

#[test]
fn the_state_is_the_same_bytes_whenever_and_however_long_it_was_computed() {
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let bytes = folders.each_ref().map(|folder| {
        let cache = cache(folder.path());
        let mut slow = state(2);
        slow.report.seconds = folder.path().as_os_str().len() as f64 + 0.1;
        std::thread::sleep(std::time::Duration::from_millis(10));
        cache.write_frame(&slow).unwrap();
        fs::read(folder.path().join("frames/000002.npz")).unwrap()
    });
    assert_eq!(bytes[0], bytes[1]);
    // Neither the clock nor the machine is in it: this is what it has been since format 2.
    assert_eq!((bytes[0].len(), crc32fast::hash(&bytes[0])), STATE_LENGTH_AND_CRC32);
}

const STATE_LENGTH_AND_CRC32: (usize, u32) = (2552, 2007946882);

#[test]
fn a_resume_skips_only_frames_that_verify() {
    let folder = tempfile::tempdir().unwrap();
    let cache = cache(folder.path());
    for name in ["frames/000002.npz", "frames/000002.json"] {
        let path = folder.path().join(name);
        let good = fs::read(&path).unwrap();
        for damage in 0..good.len() + 3 {
            let mut bytes = good.clone();
            match damage.checked_sub(good.len()) {
                // Every byte in turn, some bit of it.
                None => bytes[damage] ^= 1 << (damage % 8),
                Some(0) => bytes.truncate(good.len() / 2),
                Some(1) => bytes.clear(),
                Some(_) => bytes.push(0),
            }
            fs::write(&path, bytes).unwrap();
            assert_eq!(cache.valid_frames().unwrap(), [true, false, true, false], "{name}, damage {damage}");
            assert!(cache.read_frame(2).is_err() && cache.read_report(2).is_err());
            assert!(cache.read_frame(3).is_ok());
        }
        fs::remove_file(&path).unwrap();
        assert_eq!(cache.valid_frames().unwrap(), [true, false, true, false]);
        fs::write(&path, good).unwrap();
        assert_eq!(cache.valid_frames().unwrap(), [true, true, true, false]);
    }
    cache.write_frame(&state(4)).unwrap();
    assert_eq!(cache.valid_frames().unwrap(), [true; 4]);
    fs::remove_file(folder.path().join("frames/000001.json")).unwrap();
    assert_eq!(cache.valid_frames().unwrap(), [false, true, true, true]);
}

#[test]
fn a_damaged_frame_says_so_and_how_to_mend_it() {
    let folder = tempfile::tempdir().unwrap();
    let cache = cache(folder.path());
    let path = folder.path().join("frames/000001.npz");
    let mut bytes = fs::read(&path).unwrap();
    bytes[200] ^= 1;
    fs::write(&path, bytes).unwrap();
    let message = cache.read_frame(1).unwrap_err().to_string();
    assert!(
        message.contains("000001.npz: it is damaged (its checksum does not match); run `immerse simulate`"),
        "{message}"
    );
    // A frame in the place of another one is no frame either.
    for ending in ["npz", "json"] {
        let frame = |n: usize| folder.path().join(format!("frames/00000{n}.{ending}"));
        fs::copy(frame(3), frame(2)).unwrap();
    }
    assert!(matches!(cache.read_frame(2), Err(DiskError::Damaged { .. })));
}

#[test]
fn another_scene_is_refused_and_nothing_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    cache(folder.path());
    let before = contents(folder.path());
    let other = FilmSpec { scene: "other".into(), keys: keys(1, 4), ..film() };
    let refused = |found: &str| {
        let error = open(folder.path(), &other, &kept(None)).unwrap_err();
        assert!(matches!(error, DiskError::OtherScene { .. }));
        let message = error.to_string();
        assert!(message.contains(found) && message.contains("--restart") && message.contains("--out"), "{message}");
    };
    refused("the scene `test`, and nothing was overwritten");
    assert_eq!(contents(folder.path()), before);
    // Opening it with the same scene changes nothing either.
    open(folder.path(), &film(), &kept(None)).unwrap();
    assert_eq!(contents(folder.path()), before);
    // Nor does anybody lose the frames of a film whose manifest is damaged.
    fs::write(folder.path().join("manifest.json"), "{").unwrap();
    refused("another scene, whose manifest.json is not there or damaged");
}

#[test]
fn frames_whose_keys_are_the_same_are_kept_when_the_scene_changes() {
    let folder = tempfile::tempdir().unwrap();
    cache(folder.path());
    let sections = [("metric".to_owned(), Key::of_bytes(b"other"))].into();
    let keys = [&keys(0, 2)[..], &keys(1, 5)[2..]].concat();
    let changed = FilmSpec { sections, keys, ..film() };
    let (film, changes) = FilmFolder::open_or_create(folder.path(), &changed, &kept(None)).unwrap();
    assert_eq!(changes, ["[metric]"]);
    assert_eq!(film.valid_frames().unwrap(), [true, true, false, false, false]);
    let error = film.read_frame(3).unwrap_err();
    assert!(matches!(error, DiskError::Stale { .. }), "{error}");
    // A frame that is computed again does not change what comes after it.
    film.write_frame(&state(4)).unwrap();
    assert_eq!(film.valid_frames().unwrap(), [true, true, false, true, false]);
}

#[test]
fn the_mesh_follows_the_scene() {
    let places: Vec<DVec3> = (0..4).map(|i| DVec3::new(f64::from(i) / 3.0, -0.0, 1e-300)).collect();
    let folder = tempfile::tempdir().unwrap();
    let with = open(folder.path(), &film(), &kept(Some(&places))).unwrap();
    assert_eq!(with.mesh().unwrap().places, Some(places.clone()));
    let without = open(folder.path(), &film(), &kept(None)).unwrap();
    assert_eq!(without.mesh().unwrap().places, None);
}

#[test]
fn a_restart_begins_anew_and_leaves_other_files_alone() {
    let folder = tempfile::tempdir().unwrap();
    cache(folder.path());
    let stranger = folder.path().join("frames/notes.json");
    fs::write(&stranger, "mine").unwrap();
    clear_film(folder.path()).unwrap();
    let other = FilmSpec { scene: "other".into(), keys: keys(1, 2), ..film() };
    let cache = open(folder.path(), &other, &kept(None)).unwrap();
    assert_eq!((cache.frames().unwrap(), cache.valid_frames().unwrap()), (vec![], vec![false; 2]));
    assert_eq!(fs::read_to_string(stranger).unwrap(), "mine");
}

#[test]
fn manifests_of_other_versions_are_refused_and_broken_ones_made_anew() {
    let folder = tempfile::tempdir().unwrap();
    let error = FilmFolder::open(folder.path()).unwrap_err();
    assert!(matches!(error, DiskError::NotAFilm { .. }));
    assert!(error.to_string().contains("simulate one first"), "{error}");

    cache(folder.path());
    let path = folder.path().join("manifest.json");
    let good = fs::read_to_string(&path).unwrap();
    fs::write(&path, good.replace("\"format\": 2", "\"format\": 3")).unwrap();
    let error = open(folder.path(), &film(), &kept(None)).unwrap_err();
    assert!(matches!(error, DiskError::Version { found: 3, .. }), "{error}");
    assert!(error.to_string().contains("it has format 3, this program reads format 2"), "{error}");

    for broken in [good.replace("test", "tset"), good[..good.len() / 2].to_owned(), String::new(), "{}".into()] {
        fs::write(&path, broken).unwrap();
        let error = FilmFolder::open(folder.path()).unwrap_err();
        assert!(matches!(error, DiskError::Damaged { .. }), "{error}");
        assert!(error.to_string().contains("makes it anew and keeps the rest"), "{error}");
        // Whoever has the scene has it back.
        let film = open(folder.path(), &film(), &kept(None)).unwrap();
        assert_eq!(film.valid_frames().unwrap(), [true, true, true, false]);
        assert_eq!(fs::read_to_string(&path).unwrap(), good);
    }
    fs::write(folder.path().join("mesh.npz"), "").unwrap();
    let error = FilmFolder::open(folder.path()).unwrap().mesh().unwrap_err();
    assert!(error.to_string().contains("mesh.npz: it is damaged"), "{error}");
    assert!(open(folder.path(), &film(), &kept(None)).unwrap().mesh().is_ok());
}

#[test]
fn frames_that_are_unfit_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let cache = open(folder.path(), &film(), &kept(None)).unwrap();
    let mut short = state(1);
    short.positions.pop();
    let mut diverged = state(1);
    diverged.positions[2].y = f64::NAN;
    let mut infinite = state(1);
    infinite.report.energy = f64::INFINITY;
    for (state, reason) in
        [(short, "there are 3 positions, the mesh wants 4"), (diverged, "not finite"), (infinite, "not finite")]
    {
        let error = cache.write_frame(&state).unwrap_err();
        assert!(matches!(error, DiskError::Unfit { frame: 1, .. }));
        assert!(error.to_string().contains(reason), "{error}");
    }
    assert_eq!(fs::read_dir(folder.path().join("frames")).unwrap().count(), 0);
}

/// What is not a number is `null` in JSON, and a report with that could not be read again.
#[test]
fn a_report_has_numbers_only() {
    type Put = fn(&mut FrameReport, f64);
    let places: [(&str, Put); 26] = [
        ("time", |r, x| r.time = x),
        ("l2_length_error", |r, x| r.l2_length_error = x),
        ("max_length_error", |r, x| r.max_length_error = x),
        ("median_length_error", |r, x| r.median_length_error = x),
        ("p95_length_error", |r, x| r.p95_length_error = x),
        ("rim_length", |r, x| r.rim_length = x),
        ("energy", |r, x| r.energy = x),
        ("stiffness", |r, x| r.stiffness[1] = x),
        ("period_error", |r, x| r.period_error = x),
        ("curvature_error", |r, x| r.curvature_error = Some(x)),
        ("mean_distance", |r, x| r.mean_distance = Some(x)),
        ("pin_distance", |r, x| r.pin_distance = Some(x)),
        ("strain", |r, x| r.strain = x),
        ("median_move", |r, x| r.median_move = x),
        ("max_move", |r, x| r.max_move = x),
        ("enclosed_volume", |r, x| r.enclosed_volume = Some(x)),
        ("largest_dent", |r, x| r.largest_dent = Some(x)),
        ("rms_degrees", |r, x| r.bending_error = Some(BendingError { rms_degrees: x, ..Default::default() })),
        ("max_degrees", |r, x| r.bending_error = Some(BendingError { max_degrees: x, ..Default::default() })),
        ("thinness", |r, x| r.places.thinness = x),
        ("sharpest_degrees", |r, x| r.places.sharpest_degrees = x),
        ("dt", |r, x| r.cursor.dt = x),
        ("turn", |r, x| r.cursor.turn = x),
        ("a component", |r, x| r.components = vec![ComponentReport { l2_length_error: x, ..Default::default() }]),
        ("a component", |r, x| r.components = vec![ComponentReport { max_length_error: x, ..Default::default() }]),
        ("a component", |r, x| {
            let cursor = Cursor { turn: x, ..Default::default() };
            r.components = vec![ComponentReport { cursor, ..Default::default() }];
        }),
    ];
    let folder = tempfile::tempdir().unwrap();
    let cache = open(folder.path(), &film(), &kept(None)).unwrap();
    for (name, put) in places {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut frame = state(1);
            put(&mut frame.report, bad);
            let error = cache.write_frame(&frame).expect_err(name);
            assert!(matches!(error, DiskError::Unfit { frame: 1, .. }), "{name}: {error}");
        }
        let mut frame = state(1);
        put(&mut frame.report, 0.1 + 0.2);
        cache.write_frame(&frame).expect(name);
        assert_eq!(cache.read_frame(1).expect(name), frame, "{name}");
    }
}

#[test]
fn pins_and_the_sides_of_a_flat_torus_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let pins: Vec<VertexId> = [1, 3].map(VertexId::new).to_vec();
    let lattice = Some([[3.0, 0.1], [-0.2, 2.5]]);
    let mesh = FilmMesh { pins: pins.clone(), lattice, ..kept(None) };
    let read = open(folder.path(), &film(), &mesh).unwrap().mesh().unwrap();
    assert_eq!((read.pins, read.lattice, read.places), (pins, lattice, None));
    assert_eq!(read.mesh.triangles(), tetrahedron().triangles());
}

/// A number of frames that no film has would be reserved or counted through.
#[test]
fn a_forged_number_of_frames_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    cache(folder.path());
    let path = folder.path().join("manifest.json");
    let text = fs::read_to_string(&path).unwrap();
    for (frames, reason) in
        [(1_152_921_504_606_846_976_u64, "a film has 1 to 999999"), (5, "it has 5 frames and keys of 4")]
    {
        let forged = text.replace("\"frame_count\": 4", &format!("\"frame_count\": {frames}"));
        let (_, body) = forged.split_once("\",").unwrap();
        fs::write(&path, format!("{{\n  \"crc32\": \"{:08x}\",{body}", crc32fast::hash(body.as_bytes()))).unwrap();
        let error = FilmFolder::open(folder.path()).unwrap_err();
        assert!(error.to_string().contains(reason), "{error}");
    }
}

/// A film of the first format, in which nothing says what its frames are made of.
#[test]
fn older_films_are_refused_with_a_remedy() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/film/inputs/format_1");
    let error = FilmFolder::open(&folder).unwrap_err();
    assert!(matches!(error, DiskError::Version { found: 1, .. }), "{error}");
    assert!(error.to_string().contains("pass --restart to begin anew"), "{error}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_an_error_with_a_path() {
    let error = open(Path::new("/proc/immerse"), &film(), &kept(None)).unwrap_err();
    assert!(matches!(error, DiskError::Io { action: "created", .. }), "{error}");
    assert!(error.to_string().contains("/proc/immerse"), "{error}");
}
