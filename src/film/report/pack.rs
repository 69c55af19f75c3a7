//! As much of a film as a page has room for.

use std::collections::BTreeMap;
use std::io;

use glam::DVec3;
use rayon::prelude::*;

use super::chains::chains;
use super::measure::{Small, Subject};
use super::places::Places;
use super::records::{Record, Records};
use super::streams::{Curves, Shares, Stream};
use crate::immersion::FieldName;
use crate::render::ColorMap;

/// Bytes that all streams may take together; the rest of a page is small.
const MOST_BYTES: usize = 9_600_000;

/// Bytes before they are compressed. More would hardly fit, and take memory.
const MOST_RAW_BYTES: usize = 64 << 20;

/// The box around all frames, cut into 2¹⁶ − 1 steps along its longest side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub origin: DVec3,
    pub step: f64,
}

/// What is greater than 65 534 steps away rounds to the last one.
const LAST: f64 = 65535.0;

impl Grid {
    /// Around everything between two corners.
    pub fn around(low: DVec3, high: DVec3) -> Grid {
        Grid { origin: low, step: ((high - low).max_element() / LAST).max(f64::MIN_POSITIVE) }
    }

    /// The nearest point of the grid.
    fn nearest(&self, point: DVec3) -> [u16; 3] {
        ((point - self.origin) / self.step).round().clamp(DVec3::ZERO, DVec3::splat(LAST)).to_array().map(|x| x as u16)
    }
}

/// Curves are drawn several pixels wide, so that sixteen steps of the grid are one of theirs.
pub(super) const CURVE_STEPS: u16 = 16;

fn coarse(x: u16) -> u16 {
    (x / CURVE_STEPS).saturating_add(u16::from(x % CURVE_STEPS >= CURVE_STEPS / 2))
}

/// Segments on the coarser grid, each once: a surface that is crumpled passes through itself a hundred times in one place.
fn segments_of(crossings: &[[DVec3; 2]], grid: &Grid) -> Vec<[[u16; 3]; 2]> {
    let ends = |ends: &[DVec3; 2]| ends.map(|end| grid.nearest(end).map(coarse));
    let ordered = |[a, b]: [[u16; 3]; 2]| if a <= b { [a, b] } else { [b, a] };
    let mut segments: Vec<_> = crossings.iter().map(ends).filter(|[a, b]| a != b).map(ordered).collect();
    segments.sort_unstable();
    segments.dedup();
    if segments.len() > MOST_SEGMENTS {
        let length = |[a, b]: &[[u16; 3]; 2]| (0..3).map(|k| u64::from(a[k].abs_diff(b[k])).pow(2)).sum::<u64>();
        segments.sort_by_key(|ends| std::cmp::Reverse(length(ends)));
        segments.truncate(MOST_SEGMENTS);
        segments.sort_unstable();
    }
    segments
}

/// A frame that passes through itself in more segments than this has its longest ones: there are so many only where frames are drawn
/// at random, and there they cover everything.
const MOST_SEGMENTS: usize = 30_000;

/// A field with the range in which it is shown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    pub name: FieldName,
    /// Where it is in [`Record::fields`].
    pub place: usize,
    pub map: ColorMap,
    pub range: [f32; 2],
}

impl Shown {
    /// 0 to 254 from the least to the greatest shown value, or the number itself of what names things; 255 for no number.
    fn byte(&self, value: f32) -> u8 {
        let [low, high] = self.range;
        let part = if self.map == ColorMap::Categorical { value } else { 254.0 * (value - low) / (high - low) };
        if part.is_finite() { part.round().clamp(0.0, 254.0) as u8 } else { 255 }
    }
}

/// What a page holds of a film.
pub(super) struct Packed {
    pub streams: Vec<Stream>,
    /// Places of the frames that it has, among those that were measured.
    pub frames: Vec<usize>,
    /// Those fields that it has.
    pub fields: Vec<Shown>,
}

/// Packs as many frames as there is room for, evenly spread, and then fields in their order.
pub(super) fn pack(
    subject: &Subject,
    records: &mut Records,
    small: &[Small],
    lengths: &[usize],
    grid: &Grid,
    wanted: &[Shown],
) -> io::Result<Packed> {
    let mesh = mesh_streams(subject);
    let bytes_of_frame =
        8 * subject.mesh.vertex_count() + wanted.iter().map(|shown| lengths[shown.place]).sum::<usize>();
    let mut frames = evenly(small.len(), small.len().min(MOST_RAW_BYTES / bytes_of_frame.max(1)).max(1));
    loop {
        let Changing { always: mut streams, mut fields } =
            frame_streams(subject, records, small, lengths, grid, &frames, wanted)?;
        let size = |streams: &[Stream]| streams.iter().map(|stream| stream.text.len()).sum::<usize>();
        let least = size(&mesh) + size(&streams) + fields.first().map_or(0, |(_, stream)| stream.text.len());
        if least > MOST_BYTES && frames.len() > 1 {
            let fitting = frames.len() as f64 * 0.97 * MOST_BYTES as f64 / least as f64;
            frames = evenly(small.len(), (fitting as usize).clamp(1, frames.len() - 1));
            continue;
        }
        let mut room = MOST_BYTES.saturating_sub(size(&mesh) + size(&streams));
        fields.retain(|(_, stream)| {
            let fits = stream.text.len() <= room;
            room -= if fits { stream.text.len() } else { 0 };
            fits
        });
        let (kept, of_fields): (Vec<Shown>, Vec<Stream>) = fields.into_iter().unzip();
        streams.extend(of_fields);
        streams.extend(mesh);
        return Ok(Packed { streams, frames, fields: kept });
    }
}

/// So many of all, the first and the last among them if they are two or more.
fn evenly(all: usize, count: usize) -> Vec<usize> {
    (0..count).map(|k| if count > 1 { k * (all - 1) / (count - 1) } else { 0 }).collect()
}

fn mesh_streams(subject: &Subject) -> Vec<Stream> {
    let corners: Vec<u32> = subject.triangles.iter().flatten().copied().collect();
    vec![Stream::of_numbers("triangles", &corners), Stream::of_numbers("pins", &subject.pins)]
}

/// What changes from frame to frame.
struct Changing {
    /// Streams that every page has.
    always: Vec<Stream>,
    fields: Vec<(Shown, Stream)>,
}

/// Packs what changes from one of these frames to the next.
fn frame_streams(
    subject: &Subject,
    records: &mut Records,
    small: &[Small],
    lengths: &[usize],
    grid: &Grid,
    frames: &[usize],
    wanted: &[Shown],
) -> io::Result<Changing> {
    let vertices = subject.mesh.vertex_count();
    let mut places = Places::new(vertices, &subject.triangles);
    let (mut curves, mut sky) = (Curves::default(), Shares::default());
    let mut fields: Vec<Shares> = wanted.iter().map(|_| Shares::default()).collect();
    for &frame in frames {
        let Record { positions, sky: [front, back], fields: values, crossings } =
            records.read(frame, vertices, lengths)?;
        places.push(&positions.iter().map(|&point| grid.nearest(point)).collect::<Vec<_>>());
        curves.push(&chains(&segments_of(&crossings, grid)));
        sky.push([front, back].concat());
        for (field, shown) in fields.iter_mut().zip(wanted) {
            field.push(values[shown.place].iter().map(|&value| shown.byte(value)).collect());
        }
    }
    let lists = |list: &dyn Fn(&Small) -> Vec<u32>| -> Vec<u32> {
        let lists: Vec<Vec<u32>> = frames.iter().map(|&frame| list(&small[frame])).collect();
        lists.iter().map(|list| list.len() as u32).chain(lists.iter().flatten().copied()).collect()
    };
    let mut streams = vec![
        Stream::of_numbers("rims", &lists(&|small| small.rims.iter().flatten().copied().collect())),
        Stream::of_numbers("pinch-points", &lists(&|small| small.pinch_points.clone())),
        // Of every frame, as curves are.
        Stream::of_numbers("histogram", &small.iter().flat_map(|small| small.histogram).collect::<Vec<_>>()),
    ];
    let (large, packed) = rayon::join(
        || [places.finish("positions"), sky.finish("sky")],
        || {
            let named: BTreeMap<usize, (Shown, Shares)> = wanted.iter().copied().zip(fields).enumerate().collect();
            let finish = |(_, (shown, shares)): (usize, (Shown, Shares))| (shown, shares.finish(shown.name.name()));
            named.into_par_iter().map(finish).collect::<Vec<_>>()
        },
    );
    streams.extend(large);
    streams.extend(curves.finish());
    Ok(Changing { always: streams, fields: packed })
}
