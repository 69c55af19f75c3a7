//! The way down from a pass, and films of it.

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

    /// The surface at a share of the whole length.
    pub fn at(&self, share: f64) -> Vec<DVec3> {
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
