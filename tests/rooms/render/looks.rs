//! Each look on a surface that passes through itself, shows both sides and has an end, against a picture that
//! was looked at. `IMMERSE_BLESS=1` writes the pictures anew: look at them before you keep them.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use immerse::{
    immersion::FieldValues,
    render::{
        Camera, Extent, Field, Lights, Look, LookName, Metadata, Output, Picture, Plane, Png, Scenery, View, render,
    },
};

const LOOKS: [(LookName, &str); 6] = [
    (LookName::Studio, "studio"),
    (LookName::Clay, "clay"),
    (LookName::Soap, "soap"),
    (LookName::Bands, "bands"),
    (LookName::Blueprint, "blueprint"),
    (LookName::Error, "error"),
];

/// Five sixths of a ring whose cross-section is a figure eight.
struct Ring {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    boundary: Vec<[u32; 2]>,
    around: Field,
}

fn ring() -> Ring {
    let (columns, rows) = (60, 48);
    let place = |index: u32| {
        let (u, v) = (f64::from(index / rows) / f64::from(columns), f64::from(index % rows) / f64::from(rows));
        let (turn, eight) = (0.4 + TAU * u * 5.0 / 6.0, TAU * v);
        let (out, up) = (0.45 * libm::sin(2.0 * eight), 0.6 * libm::sin(eight));
        DVec3::new((1.2 + out) * libm::cos(turn), up, -(1.2 + out) * libm::sin(turn))
    };
    let id = |u: u32, v: u32| u * rows + v % rows;
    let cells = (0..columns).flat_map(|u| (0..rows).map(move |v| (u, v)));
    let triangles = cells
        .flat_map(|(u, v)| [[id(u, v), id(u + 1, v), id(u + 1, v + 1)], [id(u, v), id(u + 1, v + 1), id(u, v + 1)]]);
    let ends = [0, columns].into_iter().flat_map(|u| (0..rows).map(move |v| [id(u, v), id(u, v + 1)]));
    let around = (0..(columns + 1) * rows).map(|index| (index / rows) as f32 / 5.0).collect();
    Ring {
        positions: (0..(columns + 1) * rows).map(place).collect(),
        triangles: triangles.collect(),
        boundary: ends.collect(),
        around: Field { name: "around".into(), values: FieldValues::PerVertex(around), period: None },
    }
}

fn picture(name: LookName, size: [usize; 2]) -> Picture {
    let Ring { positions, triangles, boundary, around } = ring();
    let heights = positions.iter().map(|position| position.y as f32 + 0.5).collect();
    let height = Field { name: "height".into(), values: FieldValues::PerVertex(heights), period: None };
    let output = Output::new(size[0], size[1], 8).expect("a size");
    let view = View::default().with_direction(DVec3::new(0.5, 0.7, 1.0)).and_then(|view| view.with_up(DVec3::Y));
    let camera = Camera::framing(&view.expect("a view"), &Extent::of(&positions), &output).expect("a view");
    let scenery = Scenery {
        triangles: &triangles,
        positions: &positions,
        boundary: &boundary,
        rims: &[[20 * 48 + 4, 20 * 48 + 5], [20 * 48 + 5, 20 * 48 + 6]],
        color: Some(&height),
        along: [Some(&around), None],
        ground: Some(Plane { normal: DVec3::Y, offset: -0.62 }),
        ..Scenery::default()
    };
    render(&scenery, &camera, &Lights::default(), &Look::preset(name), &output).expect("a picture")
}

fn kept(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/render/looks").join(name).with_extension("png")
}

#[test]
fn every_look_is_as_it_was_when_it_was_looked_at() {
    for (look, name) in LOOKS {
        let film = picture(look, [200, 150]);
        if std::env::var_os("IMMERSE_BLESS").is_some() {
            film.write_png(&kept(name), Png::default(), &Metadata::default()).expect("a writable folder");
        }
        let wanted = image::open(kept(name)).expect("tests/rooms/render/looks holds the pictures").into_rgb8();
        let difference = difference(&film.srgb_bytes(), wanted.as_raw(), 200);
        // A just noticeable difference is about 0.02 in this space.
        assert!(difference.mean < 0.002 && difference.largest < 0.03, "{name}: {difference:?}");
    }
}

#[test]
fn no_two_looks_are_alike() {
    let pictures: Vec<Vec<u8>> = LOOKS.iter().map(|(look, _)| picture(*look, [100, 75]).srgb_bytes()).collect();
    for (one, (_, name)) in pictures.iter().zip(LOOKS) {
        for (other, (_, other_name)) in pictures.iter().zip(LOOKS) {
            assert!(name == other_name || difference(one, other, 100).mean > 0.02, "{name} and {other_name}");
        }
    }
}

#[derive(Debug)]
struct Difference {
    mean: f32,
    largest: f32,
}

/// Distance of two pictures in Oklab, each averaged over 3 x 3 pixels as by an eye that is not too near.
fn difference(one: &[u8], other: &[u8], width: usize) -> Difference {
    assert_eq!(one.len(), other.len());
    let [one, other] = [one, other].map(|bytes| blurred(&bytes.chunks(3).map(oklab).collect::<Vec<_>>(), width));
    let distances: Vec<f32> = one.iter().zip(&other).map(|(a, b)| a.distance(*b)).collect();
    Difference {
        mean: distances.iter().sum::<f32>() / distances.len() as f32,
        largest: distances.iter().copied().fold(0.0, f32::max),
    }
}

fn blurred(pixels: &[Vec3], width: usize) -> Vec<Vec3> {
    let height = pixels.len() / width;
    let mean = |index: usize| {
        let (x, y) = (index % width, index / width);
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let count = (columns.len() * rows.len()) as f32;
        rows.flat_map(|row| columns.clone().map(move |column| pixels[row * width + column])).sum::<Vec3>() / count
    };
    (0..pixels.len()).map(mean).collect()
}

/// Björn Ottosson's perceptual space.
fn oklab(rgb: &[u8]) -> Vec3 {
    let linear = |byte: u8| {
        let value = f32::from(byte) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    };
    let [r, g, b] = [linear(rgb[0]), linear(rgb[1]), linear(rgb[2])];
    let l = (0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b).cbrt();
    let m = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b).cbrt();
    let s = (0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b).cbrt();
    Vec3::new(
        0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    )
}
