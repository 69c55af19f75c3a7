//! Picture files, read back by other code than wrote them.

use exr::prelude::{AnyChannels, FlatSamples, Layer, read_first_flat_layer_from_file};
use glam::{DVec3, Vec3};
use immerse::render::{
    Camera, Exposure, Extent, Lights, Look, Metadata, Output, Picture, Png, RenderError, Scenery, View, render,
};

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn corners() -> [DVec3; 4] {
    [DVec3::new(-1.0, -0.8, -0.2), DVec3::new(1.0, -0.7, 0.1), DVec3::new(0.1, 1.0, 0.0), DVec3::new(0.0, 0.0, 1.3)]
}

fn camera(output: &Output) -> Camera {
    Camera::framing(&View::default(), &Extent::of(&corners()), output).expect("a view")
}

fn picture(output: &Output) -> Picture {
    let positions = corners();
    let next: Vec<DVec3> = positions.iter().map(|place| *place + DVec3::new(0.01, 0.02, 0.0)).collect();
    let scenery =
        Scenery { triangles: &TETRAHEDRON, positions: &positions, next_positions: &next, ..Scenery::default() };
    render(&scenery, &camera(output), &Lights::default(), &Look::default(), output).expect("a picture")
}

fn metadata(output: &Output) -> Metadata {
    Metadata {
        scene: "Knäuel".into(),
        frame: 3,
        time: 0.25,
        frame_rate: 24.0,
        comment: "error 0.1 %".into(),
        camera: Some(camera(output)),
    }
}

fn channel(layer: &Layer<AnyChannels<FlatSamples>>, name: &str) -> Vec<f64> {
    let found = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == name);
    match &found.unwrap_or_else(|| panic!("no channel {name}")).sample_data {
        FlatSamples::F16(values) => values.iter().map(|value| f64::from(value.to_f32())).collect(),
        FlatSamples::F32(values) => values.iter().map(|value| f64::from(*value)).collect(),
        FlatSamples::U32(values) => values.iter().map(|value| f64::from(*value)).collect(),
    }
}

#[test]
fn an_exr_has_every_layer_in_its_type() {
    let output = Output::new(80, 60, 4).expect("a size").with_layers(true);
    let film = picture(&output);
    let layers = film.layers().expect("layers");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("frame.exr");
    film.write_exr(&path, &metadata(&output)).expect("an EXR");

    let image = read_first_flat_layer_from_file(&path).expect("a readable EXR");
    let layer = &image.layer_data;
    let types: Vec<String> = layer
        .channel_data
        .list
        .iter()
        .map(|channel| {
            let letter = match channel.sample_data {
                FlatSamples::F16(_) => "half",
                FlatSamples::F32(_) => "float",
                FlatSamples::U32(_) => "uint",
            };
            format!("{} {letter}", channel.name)
        })
        .collect();
    assert_eq!(
        types,
        [
            "A half",
            "B half",
            "G half",
            "N.X half",
            "N.Y half",
            "N.Z half",
            "P.X float",
            "P.Y float",
            "P.Z float",
            "R half",
            "Z float",
            "faceId uint",
            "motion.X float",
            "motion.Y float",
            "occlusion half",
            "side half"
        ]
    );
    let same = |name: &str, values: &mut dyn Iterator<Item = f32>, tolerance: f64| {
        for (read, made) in channel(layer, name).into_iter().zip(values) {
            let made = f64::from(made);
            assert!(read == made || (read - made).abs() <= tolerance, "{name}: {read} for {made}");
        }
    };
    same("R", &mut film.beauty().iter().map(|light| light.x), 1e-3);
    same("A", &mut film.beauty().iter().map(|light| light.w), 1e-3);
    same("N.Y", &mut layers.normals.iter().map(|normal| normal.y), 1e-3);
    same("P.X", &mut layers.positions.iter().map(|place| place.x), 0.0);
    same("Z", &mut layers.depth.iter().copied(), 0.0);
    same("motion.Y", &mut layers.motion.iter().map(|motion| motion.y), 0.0);
    let ids = channel(layer, "faceId");
    assert!(ids.iter().zip(&layers.face_ids).all(|(read, made)| *read == f64::from(*made)));
    assert!(ids.contains(&f64::from(u32::MAX)), "nothing is seen in the corners");

    let attributes = &layer.attributes;
    let text = |name: &str| match &attributes.other[&exr::meta::attribute::Text::new_or_panic(name)] {
        exr::meta::attribute::AttributeValue::Text(text) => text.to_string(),
        exr::meta::attribute::AttributeValue::I32(number) => number.to_string(),
        exr::meta::attribute::AttributeValue::F64(number) => number.to_string(),
        other => panic!("{other:?}"),
    };
    assert_eq!(["scene", "frame", "time"].map(text), ["Knäuel", "3", "0.25"]);
    assert!(attributes.software_name.as_ref().expect("software").to_string().starts_with("immerse "));
    assert_eq!(attributes.frames_per_second, Some((24_000, 1000)));
    assert_eq!(attributes.comments.as_ref().expect("a comment").to_string(), "error 0.1 %");
    assert!(image.attributes.chromaticities.is_some());
    assert_eq!(attributes.vertical_field_of_view.map(f32::round), Some(30.0));
}

/// Rows times matrix, divided by w.
fn transformed(point: [f64; 3], matrix: [f32; 16]) -> [f64; 3] {
    let row = [point[0], point[1], point[2], 1.0];
    let sum = |column: usize| (0..4).map(|k| row[k] * f64::from(matrix[4 * k + column])).sum::<f64>();
    [0, 1, 2].map(|column| sum(column) / sum(3))
}

#[test]
fn the_matrices_of_an_exr_lead_from_its_positions_to_its_pixels_and_depths() {
    for field_of_view in [None, Some(0.0)] {
        let output = Output::new(80, 60, 4).expect("a size").with_layers(true);
        let view = field_of_view.map_or(Ok(View::default()), |angle| View::default().with_field_of_view(angle));
        let camera = Camera::framing(&view.expect("a view"), &Extent::of(&corners()), &output).expect("a view");
        let positions = corners();
        let scenery = Scenery { triangles: &TETRAHEDRON, positions: &positions, ..Scenery::default() };
        let film = render(&scenery, &camera, &Lights::default(), &Look::default(), &output).expect("a picture");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("frame.exr");
        film.write_exr(&path, &Metadata { camera: Some(camera), ..metadata(&output) }).expect("an EXR");
        let image = read_first_flat_layer_from_file(&path).expect("a readable EXR");
        let layer = &image.layer_data;
        let to_camera = layer.attributes.world_to_camera.expect("a matrix");
        let to_device = layer.attributes.world_to_normalized_device.expect("a matrix");
        let [x, y, z, depth, alpha, face] = ["P.X", "P.Y", "P.Z", "Z", "A", "faceId"].map(|name| channel(layer, name));
        let mut seen = 0;
        for index in 0..80 * 60 {
            // Pixels at an edge look at another place than their middle.
            let same = |at: usize| at < alpha.len() && alpha[at] == 1.0 && face[at] == face[index];
            let around = [index, index + 1, index.wrapping_sub(1), index + 80, index.wrapping_sub(80)];
            if face[index] > 3.0 || !around.into_iter().all(same) {
                continue;
            }
            seen += 1;
            let point = [x[index], y[index], z[index]];
            let device = transformed(point, to_device);
            let middle = [(index % 80) as f64 + 0.5, (index / 80) as f64 + 0.5];
            assert!((device[0] * 80.0 - middle[0]).abs() < 0.01, "{device:?} at {middle:?}");
            assert!((device[1] * 60.0 - middle[1]).abs() < 0.01, "{device:?} at {middle:?}");
            assert!((transformed(point, to_camera)[2] - depth[index]).abs() < 1e-4, "in front is positive");
        }
        assert!(seen > 500, "{seen} pixels");
    }
}

#[test]
fn a_crop_is_cut_out_of_the_whole_to_the_last_bit() {
    let output = Output::new(80, 60, 4).expect("a size").with_layers(true);
    let whole = picture(&output);
    let cropped = picture(&output.with_crop([30, 12, 33, 40]).expect("a part"));
    assert_eq!((cropped.width(), cropped.height(), cropped.corner(), cropped.whole()), (33, 40, [30, 12], [80, 60]));
    let (part, all) = (cropped.srgb_bytes(), whole.srgb_bytes());
    for y in 0..40 {
        let from = (12 + y) * 80 + 30;
        assert_eq!(part[3 * 33 * y..][..3 * 33], all[3 * from..][..3 * 33], "row {y}");
        let layers = [&cropped, &whole].map(|film| film.layers().expect("layers"));
        assert_eq!(layers[0].face_ids[33 * y..][..33], layers[1].face_ids[from..][..33]);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("frame.exr");
    cropped.write_exr(&path, &metadata(&output)).expect("an EXR");
    let image = read_first_flat_layer_from_file(&path).expect("a readable EXR");
    let layer = &image.layer_data;
    assert_eq!((layer.size.0, layer.size.1), (33, 40));
    assert_eq!((layer.attributes.layer_position.0, layer.attributes.layer_position.1), (30, 12), "the data window");
    let display = image.attributes.display_window;
    assert_eq!((display.position.0, display.position.1, display.size.0, display.size.1), (0, 0, 80, 60));

    for window in [[0, 0, 0, 5], [79, 0, 2, 5], [0, 61, 1, 1], [usize::MAX, 0, 2, 2]] {
        let message = output.with_crop(window).expect_err("not in the picture").to_string();
        assert!(message.contains("80 x 60 pixels; write a part of it"), "{message}");
    }
}

#[test]
fn a_png_has_8_or_16_bits_and_says_where_it_comes_from() {
    let output = Output::new(80, 60, 4).expect("a size");
    let film = picture(&output);
    let folder = tempfile::tempdir().expect("a folder");
    for (style, depth) in [
        (Png::default(), png::BitDepth::Eight),
        (Png { small: true, ..Png::default() }, png::BitDepth::Eight),
        (Png { sixteen_bits: true, small: false }, png::BitDepth::Sixteen),
    ] {
        let path = folder.path().join("frame.png");
        film.write_png(&path, style, &metadata(&output)).expect("a PNG");
        let file = std::io::BufReader::new(std::fs::File::open(&path).expect("a file"));
        let mut reader = png::Decoder::new(file).read_info().expect("a readable PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("pixels");
        reader.finish().expect("an end");
        let info = reader.info();
        assert_eq!((info.width, info.height, info.bit_depth, info.color_type), (80, 60, depth, png::ColorType::Rgb));
        assert!(info.srgb.is_some());
        let texts: Vec<(String, String)> =
            info.utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().expect("a text"))).collect();
        let wanted = [
            ("Software", Metadata::SOFTWARE),
            ("Scene", "Knäuel"),
            ("Frame", "3"),
            ("Time", "0.25"),
            ("Comment", "error 0.1 %"),
        ];
        assert_eq!(texts, wanted.map(|(keyword, text)| (keyword.to_owned(), text.to_owned())));
        if style.sixteen_bits {
            let words: Vec<u16> = bytes.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            assert_eq!(words, film.srgb_words());
            let eight = film.srgb_bytes();
            assert!(words.iter().zip(&eight).all(|(word, byte)| word.abs_diff(u16::from(*byte) * 257) <= 257));
        } else {
            assert_eq!(bytes, film.srgb_bytes());
            assert_eq!(bytes[..3], [0xF4, 0xF3, 0xF0], "the background is exact");
        }
    }
    let left = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 1, "no temporary is left behind");
}

#[test]
fn a_file_that_cannot_be_written_is_an_error_with_its_path() {
    let output = Output::new(8, 6, 1).expect("a size");
    let film = picture(&output);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("missing").join("frame.png");
    let message =
        film.write_png(&path, Png::default(), &Metadata::default()).expect_err("there is no such folder").to_string();
    assert!(message.contains("missing") && message.contains("check that the folder exists"), "{message}");
}

#[test]
fn an_exposure_is_the_mean_of_its_pictures_in_linear_light() {
    let output = Output::new(16, 12, 4).expect("a size");
    let film = picture(&output);
    let mut exposure = Exposure::of(film.clone());
    let nothing = Picture::blank(16, 12, Vec3::ONE);
    exposure.add(&nothing);
    exposure.add(&nothing);
    exposure.add(&film);
    let mean = exposure.develop();
    assert!(mean.beauty().iter().zip(film.beauty()).all(|(half, whole)| *half == *whole / 2.0));
    assert_eq!(Exposure::of(film.clone()).develop(), film);
}

#[test]
fn a_picture_pasted_on_a_larger_one_stays_as_it_is() {
    let output = Output::new(16, 12, 4).expect("a size");
    let film = picture(&output);
    let ground = Look::default().background[0];
    for background in [ground, Vec3::ZERO] {
        let mut sheet = Picture::blank(40, 30, background);
        sheet.paste(&film, [3, 5]);
        sheet.paste(&film, [30, 25]);
        let (part, all) = (film.srgb_bytes(), sheet.srgb_bytes());
        for y in 0..12 {
            for x in 0..3 * 16 {
                let pasted = all[3 * ((5 + y) * 40 + 3) + x];
                assert!(pasted.abs_diff(part[3 * 16 * y + x]) <= 1, "up to the dither");
            }
        }
    }
}

#[test]
fn frames_beyond_what_an_exr_counts_are_not_negative() {
    let output = Output::new(4, 3, 1).expect("a size");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("late.exr");
    let late = Metadata { frame: 1 << 31, ..metadata(&output) };
    picture(&output).write_exr(&path, &late).expect("an EXR");
    let image = read_first_flat_layer_from_file(&path).expect("a readable EXR");
    let value = &image.layer_data.attributes.other[&exr::meta::attribute::Text::new_or_panic("frame")];
    assert_eq!(*value, exr::meta::attribute::AttributeValue::I32(i32::MAX));
}

#[test]
fn a_picture_without_pixels_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for [width, height] in [[0, 0], [0, 3], [3, 0]] {
        let nothing = Picture::blank(width, height, Vec3::ONE);
        assert!(nothing.srgb_bytes().is_empty() && nothing.srgb_words().is_empty());
        for sixteen_bits in [false, true] {
            let style = Png { sixteen_bits, ..Png::default() };
            let written = nothing.write_png(&folder.path().join("nothing.png"), style, &Metadata::default());
            assert!(matches!(written, Err(RenderError::Write { .. })), "{width} x {height}: {written:?}");
        }
    }
}
