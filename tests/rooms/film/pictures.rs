//! Films on disk become pictures, animations and sheets, read back here.

use std::{
    fs::{self, File},
    io::BufReader,
    path::Path,
};

use crate::support::{program, scene};
use exr::prelude::{AnyChannels, FlatSamples, Layer, read_first_flat_layer_from_file};
use glam::{DQuat, DVec3};
use immerse::{
    algebra::Complex,
    digest::Key,
    evolve::Frame,
    evolve::FrameReport,
    film::{Event, FilmError, FilmFolder, FilmMesh, FilmSpec, make_pictures, make_poster, take_picture},
    mesh::Mesh,
    scene::Scene,
    spin::SpinStructure,
};

/// A film of these positions on disk, one frame each, at times from 0 to 1.
fn film(folder: &Path, triangles: &[[u32; 3]], frames: &[Vec<DVec3>]) {
    let mesh = Mesh::from_faces(frames[0].len(), triangles).expect("a manifold");
    let film = FilmSpec {
        scene: "test".into(),
        sections: Default::default(),
        keys: (1..=frames.len()).map(|frame| Key::of_bytes(&[frame as u8])).collect(),
        checks: scene("").checks.clone(),
        text: String::new(),
    };
    let kept = FilmMesh { places: Some(frames[0].clone()), ..FilmMesh::of(mesh.clone().into()) };
    let cache = FilmFolder::open_or_create(folder, &film, &kept).expect("a film").0;
    for (k, positions) in frames.iter().enumerate() {
        let time = if frames.len() > 1 { k as f64 / (frames.len() - 1) as f64 } else { 0.0 };
        let report = FrameReport {
            frame: k + 1,
            time,
            l2_length_error: 0.00123,
            spin_class: "01".into(),
            converged: true,
            ..FrameReport::default()
        };
        cache
            .write_frame(&Frame {
                positions: positions.clone(),
                face_frames: vec![DQuat::IDENTITY; mesh.face_count()],
                spin: SpinStructure::from_transports(&mesh, vec![Complex::ONE; mesh.edge_count()]).expect("transports"),
                edge_lengths: vec![1.0; mesh.edge_count()],
                rims: Vec::new(),
                report,
            })
            .expect("a frame");
    }
}

fn make(scene: &Scene, folder: &Path, frames: &[usize]) -> Result<usize, FilmError> {
    make_pictures(scene, folder, frames, &mut |_| {}).map(|pictured| pictured.made + pictured.kept)
}

/// A ball that grows from frame to frame.
fn growing_ball(folder: &Path, frames: usize) {
    let surface = scene("[mesh]\nshape = 'sphere'\nsubdivisions = 2").surface().expect("a ball");
    let positions = surface.positions.expect("positions");
    let sizes = (0..frames).map(|k| 1.0 + 0.1 * k as f64);
    let frames: Vec<Vec<DVec3>> = sizes.map(|size| positions.iter().map(|place| *place * size).collect()).collect();
    film(folder, &surface.mesh.triangles(), &frames);
}

const SMALL: &str = "[output]\nsize = [64, 48]\nsamples = 4\n";

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .map(|path| (path.file_name().expect("a name").to_string_lossy().into(), fs::read(&path).expect("a file")))
        .collect();
    files.sort();
    files
}

#[test]
fn pictures_are_the_same_bytes_for_any_number_of_threads_and_one_by_one() {
    let text = "[output]\nsize = [64, 48]\nsamples = 4\nformat = ['png', 'exr']\nanimation = ['gif', 'apng']\nsheet = 4\n\
                [camera]\nturntable = 90\nshutter = 0.5\nshutter_samples = 3\n[clock]\nframes = 7";
    let all: Vec<usize> = (1..=7).collect();
    let made: Vec<Vec<(String, Vec<u8>)>> = [1, 2, 4]
        .map(|threads| {
            let folder = tempfile::tempdir().expect("a folder");
            growing_ball(folder.path(), 7);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| make(&scene(text), folder.path(), &all)).expect("pictures");
            files(folder.path())
        })
        .into();
    let names: Vec<&str> = made[0].iter().map(|(name, _)| name.as_str()).collect();
    let stills = (1..=7).flat_map(|k| [format!("00000{k}.exr"), format!("00000{k}.png")]);
    let others = ["film.apng", "film.gif", "manifest.json", "mesh.npz", "sheet.png"].map(str::to_owned);
    assert_eq!(names, stills.chain(others).collect::<Vec<_>>(), "and no temporary file");
    assert!(made[0] == made[1] && made[0] == made[2]);

    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 7);
    let stills_only = scene(&text.replace("sheet = 4", "").replace("animation = ['gif', 'apng']", ""));
    for frame in [6, 2] {
        make(&stills_only, folder.path(), &[frame]).expect("a picture");
    }
    for (name, bytes) in files(folder.path()) {
        let in_film = made[0].iter().find(|(other, _)| *other == name).expect("the same");
        assert!(in_film.1 == bytes, "{name} made alone differs: the camera holds for the whole film");
    }
}

#[test]
fn a_picture_in_memory_has_the_pixels_of_the_file_and_leaves_none() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 3);
    let scene = scene(&format!("{SMALL}[clock]\nframes = 3"));
    let picture = take_picture(&scene, folder.path(), 2, &mut |_| {}).expect("a picture");
    assert!(!folder.path().join("000002.png").exists());
    make(&scene, folder.path(), &[1, 2, 3]).expect("pictures");
    let file = |name: &str| image::open(folder.path().join(name)).expect(name).into_rgb8().into_raw();
    assert_eq!(picture.srgb_bytes(), file("000002.png"));
    assert_ne!(picture.srgb_bytes(), file("000003.png"));
    let error = take_picture(&scene, folder.path(), 4, &mut |_| {}).expect_err("there are three");
    assert!(matches!(error, FilmError::NoSuchFrame { frame: 4, .. }), "{error}");
}

#[test]
fn progress_is_told_in_order() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 9);
    let mut told = Vec::new();
    let scene = scene(&format!("{SMALL}[clock]\nframes = 9"));
    make_pictures(&scene, folder.path(), &[2, 4, 6, 8], &mut |event| told.push(event)).expect("pictures");
    let done = |parts: usize| (1..=parts).map(Event::Done);
    let wanted: Vec<Event> = [Event::Begin("camera", 9)]
        .into_iter()
        .chain(done(9))
        .chain([Event::Begin("render", 4)])
        .chain(done(4))
        .collect();
    assert_eq!(told, wanted);
}

#[test]
fn moving_pictures_have_all_frames_and_their_delay() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 2);
    let text =
        "[output]\nsize = [64, 48]\nsamples = 4\nframe_rate = 12.5\nanimation = ['gif', 'apng']\n[clock]\nframes = 2";
    make(&scene(text), folder.path(), &[1, 2]).expect("pictures");
    let still = |frame: usize| {
        image::open(folder.path().join(format!("00000{frame}.png"))).expect("a still").into_rgb8().into_raw()
    };

    let open = |name: &str| BufReader::new(File::open(folder.path().join(name)).expect("a file"));
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = options.read_info(open("film.gif")).expect("a GIF");
    assert_eq!((reader.width(), reader.height(), reader.repeat()), (64, 48, gif::Repeat::Infinite));
    let mut frames = 0;
    while let Some(frame) = reader.read_next_frame().expect("a frame") {
        frames += 1;
        assert_eq!(frame.delay, 8, "hundredths of a second");
        let read: Vec<u8> = frame.buffer.chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
        let made = still(frames);
        assert_eq!(read[..3], made[..3], "the background is exact");
        let error: u64 = read.iter().zip(&made).map(|(a, b)| u64::from(a.abs_diff(*b)).pow(2)).sum();
        let error = (error as f64 / read.len() as f64).sqrt();
        assert!(error < 6.0, "256 colours suffice: {error}");
    }
    assert_eq!(frames, 2);

    let mut reader = png::Decoder::new(open("film.apng")).read_info().expect("an APNG");
    let control = reader.info().animation_control.expect("an animation");
    assert_eq!((control.num_frames, control.num_plays), (2, 0), "it loops for ever");
    for frame in 1..=2 {
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("a frame");
        let shown = reader.info().frame_control.expect("a frame of an animation");
        assert_eq!(u32::from(shown.delay_den) * 2, u32::from(shown.delay_num) * 25, "0.08 seconds");
        assert!(bytes == still(frame));
    }
}

#[test]
fn what_is_too_fast_for_hundredths_of_a_second_is_evened_out() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 6);
    let text = "[output]\nsize = [16, 12]\nframe_rate = 24\nanimation = ['gif']\n[clock]\nframes = 6";
    let mut scene = scene(text);
    scene.output.png = false;
    make(&scene, folder.path(), &[1, 2, 3, 4, 5, 6]).expect("a GIF");
    let mut reader = gif::DecodeOptions::new()
        .read_info(BufReader::new(File::open(folder.path().join("film.gif")).expect("a file")))
        .expect("a GIF");
    let mut delays = Vec::new();
    while let Some(frame) = reader.next_frame_info().expect("a frame") {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [4, 4, 5, 4, 4, 4], "25 hundredths of a second in all");
    assert!(!folder.path().join("000001.png").exists(), "no stills were asked for");
}

fn size(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).expect("a picture")
}

#[test]
fn a_sheet_is_about_16_to_9_and_one_frame_is_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 12);
    let text = "[output]\nsize = [640, 480]\nsamples = 1\nsheet = 12\n[clock]\nframes = 12";
    let mut film = scene(text);
    film.output.png = false;
    make(&film, folder.path(), &(1..=12).collect::<Vec<_>>()).expect("a sheet");
    // Four columns of (1920 - 5 * 8) / 4 = 470 pixels and margins of 8.
    assert_eq!(size(&folder.path().join("sheet.png")), (5 * 8 + 4 * 470, 4 * 8 + 3 * 353));
    make(&film, folder.path(), &[5]).expect("a sheet");
    assert_eq!(size(&folder.path().join("sheet.png")), (640, 480));

    let poster = folder.path().join("poster.png");
    make_poster(&scene("[output]\nsamples = 1\nsheet = 2\n[clock]\nframes = 12"), folder.path(), &poster, &mut |_| {})
        .expect("a poster");
    // The first and the last frame, each (1920 - 3 * 8) / 2 wide.
    assert_eq!(size(&poster), (3 * 8 + 2 * 948, 2 * 8 + 711));
}

#[test]
fn the_poster_of_a_still_is_1200_pixels_wide() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 1);
    let poster = folder.path().join("poster.png");
    make_poster(&scene("[output]\nsize = [1600, 1000]\nsamples = 1"), folder.path(), &poster, &mut |_| {})
        .expect("a poster");
    assert_eq!(size(&poster), (1200, 750));
}

fn exr(folder: &Path, frame: usize) -> Layer<AnyChannels<FlatSamples>> {
    let path = folder.join(format!("{frame:06}.exr"));
    read_first_flat_layer_from_file(path).expect("a readable EXR").layer_data
}

fn channel(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> Vec<f64> {
    let found = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name);
    found.unwrap_or_else(|| panic!("no {name}")).sample_data.values_as_f32().map(f64::from).collect()
}

/// A square from -1 to 1 that moves to the right, and two specks that hold the picture from -2 to 2.
fn moving_square(folder: &Path, steps: &[f64]) {
    let speck = |x: f64, y: f64| [DVec3::new(x, y, 0.0), DVec3::new(x * 0.999, y, 0.0), DVec3::new(x, y * 0.999, 0.0)];
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = |x: f64| {
        let square = corners.map(|[cx, cy]| DVec3::new(cx + x, cy, 0.0));
        [&square[..], &speck(-2.0, -2.0), &speck(2.0, 2.0)].concat()
    };
    let frames: Vec<Vec<DVec3>> = steps.iter().map(|&x| positions(x)).collect();
    film(folder, &[[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9]], &frames);
}

/// 80 pixels show the square from -2 to 2: 20 pixels a unit.
fn square_scene(camera: &str, frames: usize) -> Scene {
    scene(&format!(
        "[camera]\ndirection = [0, 0, 1]\nup = [0, 1, 0]\nfield_of_view = 0\nfill = 1\n{camera}\n\
         [output]\nsize = [80, 80]\nsamples = 16\nformat = ['exr']\n[look]\nlines = false\n[clock]\nframes = {frames}"
    ))
}

#[test]
fn motion_blur_spreads_as_far_as_the_square_goes_while_the_shutter_is_open() {
    let folder = tempfile::tempdir().expect("a folder");
    moving_square(folder.path(), &[-0.5, 0.5]);
    let coverage = |camera: &str, frame: usize| {
        make(&square_scene(camera, 2), folder.path(), &[frame]).expect("a picture");
        channel(&exr(folder.path(), frame), "A")[80 * 40..80 * 41].to_vec()
    };
    // The square begins at pixel 10 and ends at 50; it moves by 20 pixels to the next frame.
    let still = coverage("", 1);
    assert_eq!((still[8], still[12], still[47], still[52]), (0.0, 1.0, 1.0, 0.0));
    let shut = coverage("shutter = 0\nshutter_samples = 5", 1);
    assert_eq!(still, shut);
    // Half the way in 11 pictures: one pixel further from each to the next.
    let blurred = coverage("shutter = 0.5\nshutter_samples = 11", 1);
    let sum = |row: &[f64]| row.iter().sum::<f64>();
    assert!((sum(&blurred) - sum(&still)).abs() < 0.1, "as much is covered");
    for (pixel, alpha) in blurred.iter().enumerate() {
        let x = pixel as f64 + 0.5;
        let pictures = (0..11).filter(|k| (10.0..50.0).contains(&(x - f64::from(*k)))).count();
        assert!((alpha - pictures as f64 / 11.0).abs() < 0.1, "pixel {pixel}: {alpha}, {pictures} of 11");
    }
    assert_eq!(coverage("shutter = 0.5", 2), coverage("", 2), "the last frame goes nowhere");
}

#[test]
fn the_last_frame_of_a_film_that_loops_goes_on_to_the_first() {
    let folder = tempfile::tempdir().expect("a folder");
    moving_square(folder.path(), &[0.0, 0.5, 0.25]);
    let mut scene = square_scene("", 3);
    scene.clock.looping = true;
    make(&scene, folder.path(), &[1, 2, 3]).expect("pictures");
    for (frame, wanted) in [(1, 10.0), (2, -5.0), (3, -5.0)] {
        let motion = channel(&exr(folder.path(), frame), "motion.X")[80 * 40 + 40];
        assert!((motion - wanted).abs() < 1e-3, "frame {frame} moves by {motion} pixels");
    }
}

#[test]
fn motion_vectors_know_that_the_camera_moves() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 4);
    let text = format!("{SMALL}format = ['exr']\n[camera]\nturntable = 40\n[clock]\nframes = 4");
    make(&scene(&text), folder.path(), &[1, 2]).expect("pictures");
    let [now, next] = [1, 2].map(|frame| exr(folder.path(), frame));
    let matrix =
        |layer: &Layer<AnyChannels<FlatSamples>>| layer.attributes.world_to_normalized_device.expect("a matrix");
    let pixel = |point: [f64; 3], matrix: [f32; 16]| {
        let sum = |column: usize| {
            (0..3).map(|k| point[k] * f64::from(matrix[4 * k + column])).sum::<f64>() + f64::from(matrix[12 + column])
        };
        [64.0 * sum(0) / sum(3), 48.0 * sum(1) / sum(3)]
    };
    let [x, y, z, across, down, side] =
        ["P.X", "P.Y", "P.Z", "motion.X", "motion.Y", "side"].map(|name| channel(&now, name));
    let mut moved = 0.0_f64;
    for index in (0..64 * 48).filter(|&index| side[index] != 0.0) {
        let (here, growth) = ([x[index], y[index], z[index]], 1.1);
        let from = pixel(here, matrix(&now));
        let to = pixel(here.map(|coordinate| coordinate * growth), matrix(&next));
        assert!((to[0] - from[0] - across[index]).abs() < 0.01 && (to[1] - from[1] - down[index]).abs() < 0.01);
        moved = moved.max(across[index].abs());
    }
    assert!(moved > 3.0, "{moved}");
}

#[test]
fn faces_are_hidden_by_formula_and_by_number() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 1);
    let sides = |look: &str| {
        let text = format!(
            "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n{SMALL}format = ['exr']\n[look]\n{look}\n\
             [camera]\ndirection = [0, 0, 1]\nup = [0, 1, 0]"
        );
        make(&scene(&text), folder.path(), &[1]).expect("a picture");
        channel(&exr(folder.path(), 1), "side")
    };
    let middle = 64 * 24 + 32;
    assert_eq!(sides("")[middle], 1.0);
    assert_eq!(sides("hide = 'z'")[middle], -1.0, "the upper half is away, and the inside of the lower is seen");
    let below = sides("hide = '-z'");
    assert_eq!(below[middle], 1.0);
    let all: Vec<String> = (0..80).map(|face| face.to_string()).collect();
    assert!(sides(&format!("hide_faces = [{}]", all.join(","))).iter().all(|side| *side == 0.0));
}

#[test]
fn components_are_moved_apart_and_still_framed() {
    let folder = tempfile::tempdir().expect("a folder");
    let triangle = |x: f64| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[a, b]| DVec3::new(a + x, b, 0.0));
    film(folder.path(), &[[0, 1, 2], [3, 4, 5]], &[[triangle(-1.5), triangle(1.5)].concat()]);
    let text = format!("{SMALL}format = ['exr']\n[look]\nexplode = 2\n[camera]\ndirection = [0, 0, 1]\nup = [0, 1, 0]");
    make(&scene(&text), folder.path(), &[1]).expect("a picture");
    let layer = exr(folder.path(), 1);
    let (x, side) = (channel(&layer, "P.X"), channel(&layer, "side"));
    let seen = x.iter().zip(&side).filter(|(_, side)| **side != 0.0).map(|(x, _)| *x);
    let (low, high) = seen.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    // Each is pushed outward by twice its distance from the middle, 1.5.
    assert!((low + 4.5).abs() < 0.3 && (high - 5.5).abs() < 0.5, "from {low} to {high}");
}

#[test]
fn texts_are_filled_in_and_stand_in_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 2);
    let text = format!(
        "{SMALL}[clock]\nframes = 2\n[[look.text]]\ntext = '{{scene}}, {{frame}}/{{frames}}, t = {{time}}, {{faces}} faces'\n\
         [[look.text]]\ntext = '{{error}}, class {{class}}, {{rims}} rims'"
    );
    make(&scene(&text), folder.path(), &[2]).expect("a picture");
    let file = BufReader::new(File::open(folder.path().join("000002.png")).expect("a file"));
    let reader = png::Decoder::new(file).read_info().expect("a PNG");
    let comment = reader.info().utf8_text.iter().find(|chunk| chunk.keyword == "Comment").expect("a comment");
    assert_eq!(comment.get_text().expect("text"), "test, 2/2, t = 1.00, 80 faces\n0.12 %, class 01, 0 rims");
}

#[test]
fn what_cannot_be_is_said_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 2);
    let sphere = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n";
    for (text, frames, part) in [
        ("[clock]\nframes = 9", vec![1, 5], "frame 5 has not been computed; run `immerse simulate` first"),
        ("[look]\nhide_faces = [80]", vec![1], "there is no face 80"),
        ("[look]\nhide = 'q'", vec![1], "there is no `q`"),
        ("[[look.text]]\ntext = '{fame}'", vec![1], "asks for `{fame}`"),
        ("[camera]\ndirection = [0, 0, 1]\nup = [0, 0, -1]", vec![1], "parallel to the direction of view"),
    ] {
        let text = if text.contains("[mesh]") { text.to_owned() } else { format!("{sphere}{text}") };
        let error = make(&scene(&text), folder.path(), &frames).expect_err("refused");
        assert!(error.is_fault_of_input() && error.to_string().contains(part), "{text}: {error}");
    }
    #[cfg(not(feature = "mp4"))]
    {
        let error = make(&scene("[output]\nanimation = ['mp4']"), folder.path(), &[1]).expect_err("no encoder");
        assert!(error.to_string().contains("cargo build --release --features mp4"), "{error}");
    }
    assert_eq!(files(folder.path()).len(), 2, "nothing was written");
}

#[test]
#[cfg(feature = "mp4")]
fn an_mp4_is_written_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    growing_ball(folder.path(), 3);
    let text = format!("{SMALL}animation = ['mp4']\n[clock]\nframes = 3");
    make(&scene(&text), folder.path(), &[1, 2, 3]).expect("a film");
    let bytes = fs::read(folder.path().join("film.mp4")).expect("a file");
    assert_eq!(bytes[4..8], *b"ftyp");
}

const FILM: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 1\n[start]\nfrom = 'mesh'\n[clock]\nframes = 4\n\
                    [output]\nsize = [64, 48]\nsamples = 1\n[look]\nfront = '#000000'\n";

#[test]
fn flags_take_the_place_of_what_the_scene_says() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("film.toml"), FILM).expect("a scene");
    let flags = ["--frames", "1-4:3", "--size", "80x40", "--format", "png,gif", "--crop", "8,4,32x20", "--sheet", "2"];
    let (code, out, err) =
        program(folder.path(), &[&["run", "film.toml", "--out", "out", "--samples", "4"], &flags[..]].concat());
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("4 frames computed") && out.contains("2 pictures made"), "{out}");
    let out = folder.path().join("out");
    let names: Vec<String> =
        files(&out).into_iter().map(|(name, _)| name).filter(|name| !name.starts_with('m')).collect();
    assert_eq!(names, ["000001.png", "000004.png", "curves.csv", "curves.svg", "film.gif", "report.html", "sheet.png"]);
    assert_eq!(size(&out.join("000004.png")), (32, 20));
    let film = gif::DecodeOptions::new().read_info(File::open(out.join("film.gif")).expect("a file")).expect("a GIF");
    assert_eq!((film.width(), film.height()), (32, 20));

    let (code, _, err) =
        program(folder.path(), &["render", "film.toml", "--out", "out", "--frames", "2", "--look", "studio"]);
    assert_eq!(code, 0, "{err}");
    let picture = image::open(out.join("000002.png")).expect("a picture").into_rgb8();
    assert_eq!(picture.dimensions(), (64, 48));
    assert!(picture.get_pixel(32, 24).0[0] > 100, "the look of the scene, which is black, is replaced as a whole");
}

#[test]
fn wrong_flags_end_with_2_and_say_what_to_write() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("film.toml"), FILM).expect("a scene");
    for (flags, part) in [
        (&["--size", "80"][..], "write width and height like 1920x1080"),
        (&["--size", "80x-4"], "write width and height like 1920x1080"),
        (&["--size", "0x40"], "each side is at least 1"),
        (&["--samples", "3"], "write 1, 4, 8 or 16"),
        (&["--format", "png,jpeg"], "[possible values: png, exr, gif, apng, mp4]"),
        (&["--look", "glass"], "[possible values: studio, clay, soap, bands, blueprint, error]"),
        (&["--crop", "1,2,3"], "write x, y, width and height like 100,50,640x480"),
        (&["--crop", "60,0,5x5"], "does not lie in the picture of 64 x 48 pixels"),
        (&["--sheet", "401"], "401"),
        (&["--frames", "0"], "frames are counted from 1"),
        (&["--frames", "1-5"], "frame 5 is asked for, but the film has 4"),
    ] {
        for command in ["run", "render"] {
            let (code, out, err) = program(folder.path(), &[&[command, "film.toml", "--out", "out"], flags].concat());
            assert_eq!((code, out.as_str()), (2, ""), "{command} {flags:?}: {err}");
            let err = err.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(err.contains(part), "{command} {flags:?}: {err}");
            assert!(!folder.path().join("out").exists(), "nothing is computed for pictures that cannot be made");
        }
    }
}

#[test]
fn a_gallery_has_one_picture_of_each_scene_and_skips_what_is_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = folder.path().join("scenes");
    fs::create_dir(&scenes).expect("a folder");
    fs::write(scenes.join("film.toml"), FILM).expect("a scene");
    fs::write(scenes.join("still.toml"), FILM.replace("frames = 4", "frames = 1")).expect("a scene");
    fs::write(scenes.join("absent.toml"), "[mesh]\nfile = 'absent.obj'").expect("a scene");
    let (code, out, err) = program(folder.path(), &["gallery", "--quiet"]);
    assert_eq!(code, 0, "{err}");
    assert_eq!(out, "renders/film.png\nrenders/still.png\nrenders: 2 pictures made, 1 scenes skipped\n");
    assert!(err.contains("scenes/absent.toml: skipped; ") && err.contains("absent.obj"), "{err}");
    assert_eq!(size(&folder.path().join("renders/still.png")), (64, 48));
    // Two rows of two 64 x 48 pictures with margins of 8.
    assert_eq!(size(&folder.path().join("renders/film.png")), (3 * 8 + 2 * 64, 3 * 8 + 2 * 48));
    assert!(folder.path().join("target/gallery/film/frames/000004.npz").exists());
    let (code, _, err) = program(folder.path(), &["gallery", "scenes/absent.toml"]);
    assert_eq!(code, 2, "what is named has to be there: {err}");
}
