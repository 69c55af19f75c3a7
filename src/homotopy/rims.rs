//! From single events to rims that are born, move, join, part and die.

use super::events::Element;
use super::film::FilmEvent;
use crate::mesh::{EdgeId, Mesh, VertexId};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// What an event is to the rims of a surface: curves of edges that have folded over, and not back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// A rim appears where there was none.
    Birth,
    /// A rim gains an edge or loses one.
    Move,
    /// Rims become one.
    Join,
    /// A rim comes apart.
    Part,
    /// The last edge of a rim folds back.
    Death,
    /// A hinge folds and opens again the same way, or stays folded: no rim changes.
    Touch,
    /// A face vanishes.
    Vanishing,
}

/// How often each happens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)] // as the changes are called
pub struct RimCounts {
    pub births: usize,
    pub moves: usize,
    pub joins: usize,
    pub parts: usize,
    pub deaths: usize,
    pub touches: usize,
    pub vanishings: usize,
}

/// A run of events: a rim from its birth to its death or to the end of the film, with all that joins it. A touch or a face that
/// vanishes is a run of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rim {
    /// Its events by their numbers in the film, in order. A rim that is there from the beginning and never changes has none.
    pub events: Vec<usize>,
    /// What they are.
    pub counts: RimCounts,
    /// Edges of it that are left in the end.
    pub edges_left: usize,
}

/// All rims of a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rims {
    /// In the order of their first events.
    pub runs: Vec<Rim>,
    /// Per event what it is.
    pub changes: Vec<Change>,
    /// Over all events.
    pub counts: RimCounts,
}

/// Follows rims through the events of a film, given those that its first frame has.
pub fn rims_through_time(mesh: &Mesh, first: &[EdgeId], events: &[FilmEvent]) -> Rims {
    let mut tracks = Tracks { mesh, runs: Vec::new(), run_of_edge: BTreeMap::new(), edges_at: BTreeMap::new() };
    for &edge in first {
        tracks.add(edge);
    }
    let mut changes = Vec::with_capacity(events.len());
    for (number, event) in events.iter().enumerate() {
        let (change, run) = match event.event.element {
            Element::Face(_) => (Change::Vanishing, tracks.begin()),
            Element::Hinge(_) if !event.passes() => (Change::Touch, tracks.begin()),
            Element::Hinge(edge) => tracks.fold(edge),
        };
        tracks.runs[run].events.push(number);
        changes.push(change);
    }
    tracks.finish(changes)
}

/// Rims as they are at one time, and all that have been.
struct Tracks<'a> {
    mesh: &'a Mesh,
    runs: Vec<Track>,
    run_of_edge: BTreeMap<EdgeId, usize>,
    edges_at: BTreeMap<VertexId, BTreeSet<EdgeId>>,
}

#[derive(Default)]
struct Track {
    events: Vec<usize>,
    /// The run that it became a part of.
    joined: Option<usize>,
}

impl Tracks<'_> {
    fn begin(&mut self) -> usize {
        self.runs.push(Track::default());
        self.runs.len() - 1
    }

    /// The run that another one is a part of now.
    fn whole(&self, mut run: usize) -> usize {
        while let Some(other) = self.runs[run].joined {
            run = other;
        }
        run
    }

    /// Adds an edge. All runs at its ends become the one that began first; where there is none, one begins.
    fn add(&mut self, edge: EdgeId) -> usize {
        let near: BTreeSet<usize> = self.near(edge).iter().map(|other| self.whole(self.run_of_edge[other])).collect();
        let run = near.first().copied().unwrap_or_else(|| self.begin());
        for other in near.into_iter().skip(1) {
            let events = std::mem::take(&mut self.runs[other].events);
            self.runs[run].events.extend(events);
            self.runs[other].joined = Some(run);
        }
        self.run_of_edge.insert(edge, run);
        for v in self.mesh.edge_vertices(edge) {
            self.edges_at.entry(v).or_default().insert(edge);
        }
        run
    }

    /// Edges of rims that share a vertex with an edge.
    fn near(&self, edge: EdgeId) -> BTreeSet<EdgeId> {
        let ends = self.mesh.edge_vertices(edge);
        let all = ends.iter().filter_map(|v| self.edges_at.get(v)).flatten().copied();
        all.filter(|other| *other != edge).collect()
    }

    /// A hinge folds over: it becomes a part of a rim, or is one no longer.
    fn fold(&mut self, edge: EdgeId) -> (Change, usize) {
        let near = self.near(edge);
        if let Some(run) = self.run_of_edge.remove(&edge) {
            for v in self.mesh.edge_vertices(edge) {
                self.edges_at.entry(v).or_default().remove(&edge);
            }
            let change = match self.pieces(&near) {
                0 => Change::Death,
                1 => Change::Move,
                _ => Change::Part,
            };
            return (change, self.whole(run));
        }
        let change = match self.pieces(&near) {
            0 => Change::Birth,
            1 => Change::Move,
            _ => Change::Join,
        };
        (change, self.add(edge))
    }

    /// In how many connected pieces of rims some edges lie.
    fn pieces(&self, edges: &BTreeSet<EdgeId>) -> usize {
        let mut left = edges.clone();
        let mut pieces = 0;
        while let Some(start) = left.pop_first() {
            pieces += 1;
            let (mut seen, mut open) = (BTreeSet::from([start]), vec![start]);
            while let Some(edge) = open.pop().filter(|_| !left.is_empty()) {
                for other in self.near(edge) {
                    if seen.insert(other) {
                        left.remove(&other);
                        open.push(other);
                    }
                }
            }
        }
        pieces
    }

    fn finish(self, changes: Vec<Change>) -> Rims {
        let mut edges_left = vec![0; self.runs.len()];
        for run in self.run_of_edge.values() {
            edges_left[self.whole(*run)] += 1;
        }
        let all = self.runs.into_iter().zip(edges_left).filter(|(track, _)| track.joined.is_none());
        let mut runs: Vec<Rim> = all
            .map(|(track, edges_left)| {
                let mut events = track.events;
                events.sort_unstable();
                Rim { counts: RimCounts::of(events.iter().map(|event| changes[*event])), events, edges_left }
            })
            .collect();
        // Those that never change come last.
        runs.sort_by_key(|run| run.events.first().copied().unwrap_or(usize::MAX));
        let counts = RimCounts::of(changes.iter().copied());
        Rims { runs, changes, counts }
    }
}

impl RimCounts {
    fn of(changes: impl Iterator<Item = Change>) -> RimCounts {
        let mut counts = RimCounts::default();
        for change in changes {
            *match change {
                Change::Birth => &mut counts.births,
                Change::Move => &mut counts.moves,
                Change::Join => &mut counts.joins,
                Change::Part => &mut counts.parts,
                Change::Death => &mut counts.deaths,
                Change::Touch => &mut counts.touches,
                Change::Vanishing => &mut counts.vanishings,
            } += 1;
        }
        counts
    }
}
