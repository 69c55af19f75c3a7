//! See-through gaps between the bands of a pattern, cut out sample by sample.

use glam::DVec3;

use super::{draw::Target, samples::SamplePattern};
use crate::render::{Pattern, PatternKind, stage::Stage};

/// The gaps of a picture.
pub struct Gaps<'a> {
    bands: Pattern,
    stage: &'a Stage,
    positions: &'a [DVec3],
}

impl<'a> Gaps<'a> {
    /// None if the pattern has no gaps.
    pub fn new(pattern: Option<Pattern>, stage: &'a Stage, positions: &'a [DVec3]) -> Option<Self> {
        let bands = pattern.filter(|pattern| pattern.kind == PatternKind::Bands && pattern.gap > 0.0)?;
        (!stage.along[0].is_empty()).then_some(Self { bands, stage, positions })
    }

    /// A target that leaves out the gaps of a face.
    pub fn over<'c, C, const S: usize>(
        &self,
        target: &'c mut C,
        face: usize,
        pattern: &'c SamplePattern<S>,
    ) -> Gapped<'c, C, S> {
        let corners = self.stage.faces[face].map(|vertex| self.positions[vertex as usize]);
        let [value, scale] = self.stage.projection.seen_values(corners, self.stage.along[0][face]);
        Gapped { target, pattern, bands: self.bands, value, scale }
    }
}

/// A target that is not covered where the gaps of a face are.
pub struct Gapped<'c, C, const S: usize> {
    target: &'c mut C,
    pattern: &'c SamplePattern<S>,
    bands: Pattern,
    /// Planes in pixels of value / w and of 1 / w.
    value: [f64; 3],
    scale: [f64; 3],
}

impl<C: Target<S>, const S: usize> Target<S> for Gapped<'_, C, S> {
    fn begin(&mut self, id: u32) {
        self.target.begin(id);
    }

    fn hides(&mut self, x: i32, y: i32, nearest: f32) -> bool {
        self.target.hides(x, y, nearest)
    }

    fn cover(&mut self, x: i32, y: i32, mut outside: [i32; S], depth: [f32; S]) {
        for (sample, outside) in outside.iter_mut().enumerate() {
            if *outside < 0 {
                continue;
            }
            let place = self.pattern.place(sample);
            let at = [f64::from(x) + f64::from(place[0]), f64::from(y) + f64::from(place[1])];
            let seen = |plane: &[f64; 3]| plane[0] + plane[1] * at[0] + plane[2] * at[1];
            if self.bands.is_gap(seen(&self.value) / seen(&self.scale)) {
                *outside = -1;
            }
        }
        self.target.cover(x, y, outside, depth);
    }
}
