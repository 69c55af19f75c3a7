//! How many pictures are made at a time.

use crate::film::pictures::plan::Plan;
use crate::render::Output;

/// Bytes that frames in the making may take together.
const MEMORY: usize = 1 << 30;

/// How many things of so many bytes are made at a time: enough to keep all threads busy, and no more than memory has
/// room for.
pub(in crate::film) fn at_a_time(bytes: usize) -> usize {
    (MEMORY / bytes.max(1)).clamp(1, 2 * rayon::current_num_threads())
}

/// Bytes that a picture in the making takes, about, with what becomes of it.
pub(in crate::film::pictures) fn picture_bytes(plan: &Plan, output: &Output) -> usize {
    let beauty = 60;
    let layers = if plan.output.has_layers() { 150 + 12 * plan.scene.output.fields.len() } else { 0 };
    let shutter = if plan.scene.camera.shutter > 0.0 { 20 } else { 0 };
    output.width() * output.height() * (beauty + layers + shutter)
}
