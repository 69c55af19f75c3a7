//! What a run takes of memory and of the disk.

use crate::scene::Scene;

/// Bytes that a simulation takes for each face, about; a million faces take 2.7 GiB.
const OF_FACE: usize = 3 << 10;
/// Bytes that pictures in the making take for each pixel, about.
const OF_PIXEL: usize = 250;
/// Bytes of the program itself.
const OF_PROGRAM: usize = 64 << 20;

/// Bytes of memory that a run takes at most, about.
pub(in crate::cli) fn memory_of_run(scene: &Scene, faces: usize) -> usize {
    OF_PROGRAM + OF_FACE.saturating_mul(faces) + OF_PIXEL.saturating_mul(pixels(scene))
}

/// Bytes of an EXR file for each pixel, about, without its layers of fields, and for each of those.
const OF_EXR: usize = 16;
const OF_LAYER: usize = 3;
/// Bytes of the page of a film for each face of each frame, about, and at most.
const OF_PAGE: usize = 4;
const LARGEST_PAGE: usize = 10 << 20;
/// Of the report of a frame, about.
const OF_REPORT: usize = 2 << 10;

/// Bytes of the frames of a film, and of all its files but moving pictures and exports, for a mesh of so many vertices, edges and
/// faces, and pictures of so many bytes as PNG.
pub(super) fn disk_of_film(scene: &Scene, [vertices, edges, faces]: [usize; 3], png: usize) -> [usize; 2] {
    let frames = scene.clock.frames;
    // Positions and frames of faces, transports, lengths and rims of edges, in double precision.
    let of_frames = frames.saturating_mul(24 * vertices + 32 * faces + 25 * edges + OF_REPORT);
    let output = &scene.output;
    let of_png = if output.png { png } else { 0 };
    let of_exr = if output.exr { pixels(scene).saturating_mul(OF_EXR + OF_LAYER * output.fields.len()) } else { 0 };
    let of_page = match output.report {
        true => (OF_PAGE * faces).saturating_mul(frames).min(LARGEST_PAGE),
        false => 0,
    };
    let of_mesh = 40 * (vertices + edges + faces);
    [of_frames, of_frames.saturating_add((of_png + of_exr).saturating_mul(frames)).saturating_add(of_page + of_mesh)]
}

fn pixels(scene: &Scene) -> usize {
    let [width, height] = scene.output.size;
    width.saturating_mul(height)
}

/// "340 MB"
pub(super) fn in_words(bytes: usize) -> String {
    let bytes = bytes as f64;
    match bytes {
        ..1e6 => format!("{:.0} kB", (bytes / 1e3).max(1.0)),
        ..1e7 => format!("{:.1} MB", bytes / 1e6),
        ..1e9 => format!("{:.0} MB", bytes / 1e6),
        _ => format!("{:.1} GB", bytes / 1e9),
    }
}
