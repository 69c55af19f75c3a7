//! What happens between two surfaces.

use super::exact::{folds, vanishings};
use super::search::Root;
use super::settled::{does_not_fold, does_not_vanish};
use crate::mesh::{EdgeId, FaceId, Mesh, VertexId};
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;

/// What an event happens to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Element {
    /// A hinge that folds: its faces lie upon each other.
    Hinge(EdgeId),
    /// A face that vanishes: its corners lie on a line.
    Face(FaceId),
}

impl Element {
    /// The vertices a, b, c, d of the hinge with faces (a, b, c) and (b, a, d), or a, b, c of the face.
    pub fn vertices(self, mesh: &Mesh) -> Vec<VertexId> {
        match self {
            Element::Hinge(edge) => mesh.hinge_vertices(edge).map(Vec::from).unwrap_or_default(),
            Element::Face(face) => mesh.corners(face).into(),
        }
    }
}

/// A moment at which a surface that moves is no immersion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// What it happens to.
    pub element: Element,
    /// It happens not before the first and not after the second of these times, which run from 0 to 1 between the two surfaces.
    /// Both are the same where the time is known exactly.
    pub time: [f64; 2],
    /// Whether it lasts all of that time, as where a hinge stays in a plane that it is folded in.
    pub lasts: bool,
    /// The middle of the hinge's edge, or of the face, in the middle of that time.
    pub place: DVec3,
    /// Which way the hinge is folded right before and right after: the sign of its volume. `Equal` of a face, of what
    /// lasts, and beyond the two surfaces.
    pub sides: [Ordering; 2],
}

impl Event {
    /// Whether it is known to happen at this time exactly.
    pub(super) fn is_at(&self, time: f64) -> bool {
        self.time == [time; 2]
    }
}

/// Hinges and faces that one task decides.
const TASK: usize = 4096;

/// All events while the vertices of a mesh move on straight lines from one place to another, in the order of their times. Positions
/// must be finite and in reach ([`crate::mesh::is_in_reach`]).
///
/// An event at the beginning or at the end counts.
pub fn events_between(mesh: &Mesh, from: &[DVec3], to: &[DVec3]) -> Vec<Event> {
    let moving = |v: VertexId| [from[v.index()], to[v.index()]];
    let of_hinge = |edge: EdgeId| {
        let places = mesh.hinge_vertices(edge)?.map(moving);
        if does_not_fold(places) {
            return None;
        }
        let [a, b, ..] = places;
        Some(events(Element::Hinge(edge), folds(places), &[a, b]))
    };
    let of_face = |face: FaceId| {
        let places = mesh.corners(face).map(moving);
        if does_not_vanish(places) {
            return None;
        }
        Some(events(Element::Face(face), vanishings(places), &places))
    };
    let edges = (0..mesh.edge_count()).into_par_iter().with_min_len(TASK);
    let faces = (0..mesh.face_count()).into_par_iter().with_min_len(TASK);
    let mut found: Vec<Event> = edges.filter_map(|e| of_hinge(EdgeId::new(e))).flatten().collect();
    found.par_extend(faces.filter_map(|f| of_face(FaceId::new(f))).flatten());
    found.sort_by(|a, b| a.time[0].total_cmp(&b.time[0]).then(a.element.cmp(&b.element)));
    found
}

fn events(element: Element, roots: Vec<Root>, places: &[[DVec3; 2]]) -> Vec<Event> {
    let at = |time: f64| {
        let sum: DVec3 = places.iter().map(|[from, to]| from.lerp(*to, time)).sum();
        sum / places.len() as f64
    };
    let event = |Root { time, sides, lasts }: Root| {
        let place = at(0.5 * (time[0] + time[1]));
        Event { element, time, lasts, place, sides }
    };
    roots.into_iter().map(event).collect()
}
