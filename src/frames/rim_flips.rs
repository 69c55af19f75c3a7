//! Signs of whole regions, for rims that are nothing else.
//!
//! λ and −λ are frames of the same surface. Where −λ took hold in a region while frames were still random, its outline is
//! of rims that no step removes, since all frames within would have to turn by 360° at once. Cut along rims, the surface
//! falls into regions; to turn the signs of one makes no rim anywhere, and ends those on its outline whose other
//! side keeps its sign.

use super::shell::{Hinge, Shell};
use glam::DQuat;

/// Turns the signs of frames, |F|, in the regions that rims cut the surface into, such that few rims are left, by their
/// lengths (of edges, |E|). Returns how many faces it turned.
///
/// Rims between two regions go together, longest first: the two are given signs that end them, unless signs given
/// before say otherwise. Where rims are outlines of regions and nothing else none are left.
pub fn flip_along_rims(shell: &Shell, edge_lengths: &[f64], frames: &mut [DQuat]) -> usize {
    let (rims, others): (Vec<&Hinge>, Vec<&Hinge>) = shell.hinges().iter().partition(|hinge| hinge.is_rim(frames));
    let mut signs = Signs::new(frames.len());
    others.iter().for_each(|hinge| signs.join(hinge.i.index(), hinge.j.index(), false));
    let mut borders: Vec<Border> = rims
        .iter()
        .filter_map(|hinge| {
            let [a, b] = [hinge.i, hinge.j].map(|face| signs.root(face.index()).0);
            (a != b).then(|| Border { regions: [a.min(b), a.max(b)], length: edge_lengths[hinge.edge.index()] })
        })
        .collect();
    borders.sort_by_key(|border| border.regions);
    borders.dedup_by(|next, border| {
        let same = next.regions == border.regions;
        border.length += if same { next.length } else { 0.0 };
        same
    });
    borders.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.regions.cmp(&b.regions)));
    borders.iter().for_each(|border| signs.join(border.regions[0], border.regions[1], true));
    let mut turned = 0;
    for (face, frame) in frames.iter_mut().enumerate() {
        if signs.root(face).1 {
            *frame = -*frame;
            turned += 1;
        }
    }
    turned
}

/// All rims between two regions.
struct Border {
    /// In order.
    regions: [usize; 2],
    length: f64,
}

/// Faces that hang together, each with its sign relative to the one that stands for them.
struct Signs {
    parents: Vec<(usize, bool)>,
}

impl Signs {
    fn new(count: usize) -> Signs {
        Signs { parents: (0..count).map(|k| (k, false)).collect() }
    }

    /// What stands for `k`, and whether `k` has the other sign.
    fn root(&mut self, mut k: usize) -> (usize, bool) {
        let mut is_opposite = false;
        loop {
            let (parent, sign) = self.parents[k];
            if parent == k {
                return (k, is_opposite);
            }
            let (grandparent, further) = self.parents[parent];
            self.parents[k] = (grandparent, sign ^ further);
            is_opposite ^= sign ^ further;
            k = grandparent;
        }
    }

    /// Gives two the same sign or opposite ones, unless what was said before decides.
    fn join(&mut self, a: usize, b: usize, are_opposite: bool) {
        let ([a, b], signs) = {
            let (a, b) = (self.root(a), self.root(b));
            ([a.0, b.0], a.1 ^ b.1)
        };
        if a != b {
            self.parents[a.max(b)] = (a.min(b), signs ^ are_opposite);
        }
    }
}
