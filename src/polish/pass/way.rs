//! The way down from a pass, and films of it.

use super::symmetry::SideExchange;
use glam::DVec3;

/// A path of surfaces, in mean edge lengths.
#[derive(Debug)]
pub(super) struct Way {
    /// Surfaces, each |V|.
    stations: Vec<Vec<DVec3>>,
    /// Per station: the length of the way up to it, in moves of the vertex that moves farthest.
    lengths: Vec<f64>,
}

impl Way {
    pub fn new(begin: Vec<DVec3>) -> Way {
        Way { stations: vec![begin], lengths: vec![0.0] }
    }

    /// Goes on to another surface.
    pub fn push(&mut self, next: Vec<DVec3>) {
        let far = self.end().iter().zip(&next).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        self.lengths.push(self.lengths.last().copied().unwrap_or_default() + far);
        self.stations.push(next);
    }

    /// Where it begins.
    pub fn begin(&self) -> &[DVec3] {
        &self.stations[0]
    }

    /// Where it ends.
    pub fn end(&self) -> &[DVec3] {
        self.stations.last().map_or(&[], Vec::as_slice)
    }

    /// A film of so many frames, evenly spaced: the way backwards with sides exchanged, then forwards.
    pub fn both_ways(&self, exchange: &SideExchange, frames: usize, unit: f64) -> Vec<Vec<DVec3>> {
        let last = frames.saturating_sub(1).max(1) as f64;
        let frame = |k: usize| {
            let side = 2.0 * k as f64 / last - 1.0;
            let mut places = self.at(side.abs());
            places.iter_mut().for_each(|p| *p *= unit);
            if side < 0.0 { exchange.exchanged(&places) } else { places }
        };
        (0..frames).map(frame).collect()
    }

    /// The surface at a share of the whole length.
    fn at(&self, share: f64) -> Vec<DVec3> {
        let length = share * self.lengths.last().copied().unwrap_or_default();
        let next = self.lengths.partition_point(|there| *there < length).clamp(1, self.stations.len() - 1);
        let [from, to] = [self.lengths[next - 1], self.lengths[next]];
        let part = if to > from { (length - from) / (to - from) } else { 1.0 };
        if part >= 1.0 {
            return self.stations[next].clone();
        }
        self.stations[next - 1].iter().zip(&self.stations[next]).map(|(a, b)| a.lerp(*b, part)).collect()
    }
}
