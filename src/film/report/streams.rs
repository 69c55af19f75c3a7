//! Numbers in few bytes: arrays whose values are near those before them, compressed and as text.
//!
//! A page unpacks them with what browsers have (`atob`, `DecompressionStream`). Numbers of two bytes are written as all
//! lower bytes and then all upper ones, most of which are 0.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// A named array of a page.
#[derive(Clone, Debug)]
pub(super) struct Stream {
    pub name: String,
    /// Compressed (zlib) and in base64.
    pub text: String,
}

/// How hard it is tried to compress.
const LEVEL: u8 = 7;

impl Stream {
    pub fn of(name: &str, bytes: &[u8]) -> Stream {
        let packed = miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL);
        Stream { name: name.to_owned(), text: STANDARD.encode(packed) }
    }

    /// Of numbers with four bytes each: all first bytes, then all second ones, and so on.
    pub fn of_numbers(name: &str, numbers: &[u32]) -> Stream {
        let plane = |k: usize| numbers.iter().map(move |number| number.to_le_bytes()[k]);
        Stream::of(name, &(0..4).flat_map(plane).collect::<Vec<_>>())
    }
}

/// Differences as small numbers: 0, −1, 1, −2, … are 0, 1, 2, 3, ….
pub(super) fn folded(difference: u16) -> u16 {
    (difference << 1) ^ if difference & 0x8000 == 0 { 0 } else { 0xFFFF }
}

pub(super) fn push_planes(bytes: &mut Vec<u8>, numbers: &[u16]) {
    bytes.extend(numbers.iter().map(|number| number.to_le_bytes()[0]));
    bytes.extend(numbers.iter().map(|number| number.to_le_bytes()[1]));
}

/// Curves on a grid, frame by frame.
#[derive(Debug, Default)]
pub(super) struct Curves {
    /// Curves of each frame, and then points of each curve.
    counts: Vec<u32>,
    lengths: Vec<u32>,
    points: Vec<[u16; 3]>,
}

impl Curves {
    pub fn push(&mut self, chains: &[Vec<[u16; 3]>]) {
        self.counts.push(chains.len() as u32);
        self.lengths.extend(chains.iter().map(|chain| chain.len() as u32));
        self.points.extend(chains.iter().flatten());
    }

    /// How many curves and points there are, and the points, each told from the one before.
    pub fn finish(self) -> [Stream; 2] {
        let coordinates = (0..3).flat_map(|axis| self.points.iter().map(move |point| point[axis]));
        let mut before = 0;
        let errors: Vec<u16> = coordinates.map(|x| folded(x.wrapping_sub(std::mem::replace(&mut before, x)))).collect();
        let mut bytes = Vec::new();
        push_planes(&mut bytes, &errors);
        [Stream::of_numbers("crossing-counts", &[self.counts, self.lengths].concat()), Stream::of("crossings", &bytes)]
    }
}

/// Bytes of which each frame has as many, told from those of the frame before.
#[derive(Debug, Default)]
pub(super) struct Shares {
    bytes: Vec<u8>,
    before: Vec<u8>,
}

impl Shares {
    pub fn push(&mut self, now: Vec<u8>) {
        let before = |k: usize| self.before.get(k).copied().unwrap_or_default();
        self.bytes.extend(now.iter().enumerate().map(|(k, x)| x.wrapping_sub(before(k))));
        self.before = now;
    }

    pub fn finish(self, name: &str) -> Stream {
        Stream::of(name, &self.bytes)
    }
}
