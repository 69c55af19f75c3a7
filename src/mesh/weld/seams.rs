//! Boundary edges that lie upon each other, and how they are glued.

use super::coincident::{at_equal_positions, coincident};
use super::components::Components;
use crate::mesh::faults::orient;
use crate::mesh::union_find::root;
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;

/// Faces that turn back by less than this angle lie upon each other.
const FLAT: f64 = 1e-4;
/// How often gluing is taken back around edges that it would spoil, before all of it is.
const TRIES: usize = 10;

/// Which vertices are one, and what is left.
pub(in crate::mesh) struct Welded {
    /// Per vertex: the smallest of those that it is one with.
    pub first: Vec<u32>,
    /// How many pairs of boundary edges were glued.
    pub glued: usize,
    /// Boundary vertices that coincide with another one still, or nearly.
    pub coincident: Vec<[u32; 2]>,
    /// How far apart the first of these are.
    pub distance: f64,
    /// Boundary vertices that coincide with one inside, each with that one.
    pub on_inside: Vec<[u32; 2]>,
}

/// Sides whose ends coincide, in either direction.
struct Group {
    ups: Vec<usize>,
    downs: Vec<usize>,
}

pub(super) struct Seams<'a> {
    oriented: Vec<[u32; 3]>,
    positions: &'a [DVec3],
    /// Per side 3 f + k of the faces: whether another face is there in the file.
    is_inner: Vec<bool>,
    components: Components,
    /// Pairs of sides.
    glued: Vec<[usize; 2]>,
}

impl<'a> Seams<'a> {
    pub fn new(triangles: &[[u32; 3]], positions: &'a [DVec3]) -> Option<Seams<'a>> {
        let orientable = orient(positions.len(), triangles).ok()?;
        let oriented: Vec<[u32; 3]> = triangles
            .iter()
            .zip(&orientable.reversed)
            .map(|(&[a, b, c], &reverse)| if reverse { [a, c, b] } else { [a, b, c] })
            .collect();
        let mut is_inner = vec![false; 3 * triangles.len()];
        let mut components = Components::new(triangles.len());
        for pair in &orientable.pairs {
            components.join(pair.faces[0], pair.faces[1], false);
            for f in pair.faces {
                let on_edge = |k: &usize| [*k, (*k + 1) % 3].iter().all(|&k| pair.edge.contains(&oriented[f][k]));
                (0..3).filter(on_edge).for_each(|k| is_inner[3 * f + k] = true);
            }
        }
        Some(Seams { oriented, positions, is_inner, components, glued: Vec::new() })
    }

    pub fn glue_all(&mut self, tolerance: f64) {
        self.glue(0.0);
        if tolerance > 0.0 {
            self.glue(tolerance);
        }
    }

    /// Whether an open side has both ends in common with another side, open or not.
    pub fn is_torn(&self, tolerance: f64) -> bool {
        let open = self.open_sides();
        if open.is_empty() {
            return false;
        }
        let all: Vec<usize> = (0..self.is_inner.len()).collect();
        let corner_of = self.corners(&all, tolerance);
        let key = |&side: &usize| {
            let [a, b] = self.ends(side).map(|v| corner_of[&v]);
            [a.min(b), a.max(b)]
        };
        let mut counts: HashMap<[u32; 2], usize> = HashMap::new();
        all.iter().for_each(|side| *counts.entry(key(side)).or_default() += 1);
        open.iter().any(|side| counts[&key(side)] > 1)
    }

    fn ends(&self, side: usize) -> [u32; 2] {
        let corners = self.oriented[side / 3];
        [corners[side % 3], corners[(side % 3 + 1) % 3]]
    }

    fn open_sides(&self) -> Vec<usize> {
        let mut open: Vec<bool> = self.is_inner.iter().map(|inner| !inner).collect();
        self.glued.iter().flatten().for_each(|&side| open[side] = false);
        (0..open.len()).filter(|&side| open[side]).collect()
    }

    /// Open sides whose ends coincide with those of others, in the order of these ends.
    fn groups(&self, tolerance: f64) -> Vec<Group> {
        let open = self.open_sides();
        let corner_of = self.corners(&open, tolerance);
        let mut keyed: Vec<([u32; 2], bool, usize)> = open
            .iter()
            .map(|&side| {
                let [a, b] = self.ends(side).map(|v| corner_of[&v]);
                ([a.min(b), a.max(b)], a > b, side)
            })
            .filter(|([a, b], ..)| a != b)
            .collect();
        keyed.sort_unstable();
        let several = keyed.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        let those = |group: &[([u32; 2], bool, usize)], down: bool| {
            group.iter().filter(|side| side.1 == down).map(|side| side.2).collect()
        };
        several.map(|group| Group { ups: those(group, false), downs: those(group, true) }).collect()
    }

    /// Per end of the sides the first of the ends that coincide with it.
    fn corners(&self, sides: &[usize], tolerance: f64) -> HashMap<u32, u32> {
        let mut vertices: Vec<u32> = sides.iter().flat_map(|&side| self.ends(side)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        coincident(&vertices, self.positions, tolerance)
    }

    /// Glues open sides that coincide.
    fn glue(&mut self, tolerance: f64) {
        let groups = self.groups(tolerance);
        if groups.is_empty() {
            return;
        }
        let before = self.glued.len();
        for group in &groups {
            let (same_way, a, b) = match (&*group.ups, &*group.downs) {
                (&[a], &[b]) => (false, a, b),
                (&[a, b], []) | ([], &[a, b]) => (true, a, b),
                _ => continue,
            };
            if a / 3 != b / 3 && !self.is_flat(a, b) && self.components.join(a / 3, b / 3, same_way) {
                self.glued.push([a, b]);
            }
        }
        for group in groups.iter().filter(|group| group.ups.len() + group.downs.len() > 2) {
            self.glue_around(group);
        }
        for attempt in 0..=TRIES {
            let spoilt = self.spoilt();
            if spoilt.is_empty() {
                break;
            }
            if attempt == TRIES {
                self.glued.truncate(before);
                break;
            }
            let first = self.first();
            let touches = |pair: &[usize; 2]| {
                pair.iter().flat_map(|&side| self.ends(side)).any(|v| spoilt.contains(&first[v as usize]))
            };
            let keep: Vec<[usize; 2]> = self
                .glued
                .iter()
                .enumerate()
                .filter(|(k, pair)| *k < before || !touches(pair))
                .map(|(_, p)| *p)
                .collect();
            self.glued = keep;
        }
    }

    /// Glues sides that lie around the same line: each that runs up with the first that runs down, on the inside of it.
    fn glue_around(&mut self, Group { ups, downs }: &Group) {
        let Some(&reference) = ups.first() else { return };
        let [tail, tip] = self.ends(reference).map(|v| self.positions[v as usize]);
        let axis = (tip - tail).normalize_or_zero();
        let zero = self.outward(reference).normalize_or_zero();
        let angle = |side: usize| {
            let p = self.outward(side);
            libm::atan2(axis.cross(zero).dot(p), zero.dot(p))
        };
        let mut free: Vec<(f64, usize)> = downs.iter().map(|&side| (angle(side), side)).collect();
        let mut found = Vec::new();
        for &up in ups {
            let here = angle(up);
            let turn = |there: f64| (here - there).rem_euclid(TAU);
            let inside = free
                .iter()
                .enumerate()
                .filter(|(_, (there, side))| (FLAT..TAU - FLAT).contains(&turn(*there)) && side / 3 != up / 3);
            if let Some((k, _)) = inside.min_by(|a, b| turn(a.1.0).total_cmp(&turn(b.1.0))) {
                found.push([up, free.remove(k).1]);
            }
        }
        for [a, b] in found {
            if self.components.join(a / 3, b / 3, false) {
                self.glued.push([a, b]);
            }
        }
    }

    /// From a side to the third corner of its face, at a right angle to the side.
    fn outward(&self, side: usize) -> DVec3 {
        let corners = self.oriented[side / 3].map(|v| self.positions[v as usize]);
        let (tail, tip, top) = (corners[side % 3], corners[(side + 1) % 3], corners[(side + 2) % 3]);
        (top - tail).reject_from_normalized((tip - tail).normalize_or_zero())
    }

    /// Whether the faces of two coinciding sides lie upon each other.
    fn is_flat(&self, a: usize, b: usize) -> bool {
        let (p, q) = (self.outward(a), self.outward(b));
        p.dot(q) > 0.0 && p.cross(q).length() < FLAT * p.dot(q)
    }

    /// Per vertex the smallest that it is one with.
    fn first(&self) -> Vec<u32> {
        let mut parents: Vec<u32> = (0..self.positions.len() as u32).collect();
        for &[g, h] in &self.glued {
            let ([a, b], [mut c, mut d]) = (self.ends(g), self.ends(h));
            if self.same_way(g, h) {
                (c, d) = (d, c);
            }
            for (v, w) in [(a, d), (b, c)] {
                let (v, w) = (root(&mut parents, v), root(&mut parents, w));
                parents[v.max(w) as usize] = v.min(w);
            }
        }
        (0..parents.len() as u32).map(|v| root(&mut parents, v)).collect()
    }

    /// Whether two glued sides run in the same direction.
    fn same_way(&self, g: usize, h: usize) -> bool {
        let [[a, b], [c, d]] = [self.ends(g), self.ends(h)].map(|ends| ends.map(|v| self.positions[v as usize]));
        a.distance_squared(c) + b.distance_squared(d) < a.distance_squared(d) + b.distance_squared(c)
    }

    /// Vertices, by the smallest that they are one with, where faces would lose a side or sides would meet that were not
    /// glued.
    fn spoilt(&self) -> HashSet<u32> {
        let first = self.first();
        let mut partner: HashMap<usize, usize> = HashMap::new();
        for &[g, h] in &self.glued {
            partner.insert(g, h);
            partner.insert(h, g);
        }
        let mut sides: Vec<([u32; 2], usize)> = (0..3 * self.oriented.len())
            .map(|side| {
                let [a, b] = self.ends(side).map(|v| first[v as usize]);
                ([a.min(b), a.max(b)], side)
            })
            .collect();
        sides.sort_unstable();
        let mut spoilt = HashSet::new();
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            let fine = match *group {
                [_] => true,
                [(_, g), (_, h)] => partner.get(&g) == Some(&h) || (self.is_inner[g] && self.is_inner[h]),
                _ => false,
            };
            let [a, b] = group[0].0;
            if !fine || a == b {
                spoilt.extend([a, b]);
            }
        }
        spoilt
    }

    pub fn welded(self, near: f64) -> Welded {
        let first = self.first();
        let open = self.open_sides();
        let corner_of = self.corners(&open, near);
        let mut at: Vec<(u32, u32)> = corner_of.iter().map(|(v, corner)| (*corner, first[*v as usize])).collect();
        at.sort_unstable();
        at.dedup();
        let groups = at.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1);
        let coincident: Vec<[u32; 2]> =
            groups.flat_map(|group| group[1..].iter().map(|(_, other)| [group[0].1, *other])).collect();
        let apart = |[a, b]: &[u32; 2]| self.positions[*a as usize].distance(self.positions[*b as usize]);
        Welded {
            on_inside: self.on_inside(&open, &first),
            distance: coincident.first().map_or(0.0, apart),
            coincident,
            glued: self.glued.len(),
            first,
        }
    }

    /// Vertices of open sides that coincide with a vertex that is on none, each with that one.
    fn on_inside(&self, open: &[usize], first: &[u32]) -> Vec<[u32; 2]> {
        if open.is_empty() {
            return Vec::new();
        }
        let mut on_boundary = vec![false; first.len()];
        open.iter().flat_map(|&side| self.ends(side)).for_each(|v| on_boundary[first[v as usize] as usize] = true);
        let mut corners: Vec<u32> = self.oriented.iter().flatten().map(|&v| first[v as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        let (rim, inside): (Vec<u32>, Vec<u32>) = corners.into_iter().partition(|&v| on_boundary[v as usize]);
        at_equal_positions(&rim, &inside, self.positions)
    }
}
