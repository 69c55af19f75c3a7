//! The events of a film, whose frames come one after the other.

use super::events::{Element, Event, events_between};
use crate::mesh::{Mesh, SurfaceError, VertexId, first_out_of_reach};
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// An event of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmEvent {
    /// Between which frames it happens: those of this number and of the next one, counted from 0.
    pub interval: usize,
    /// What happens there.
    pub event: Event,
}

/// A film of a mesh: vertices move on straight lines from each frame to the next.
#[derive(Clone, Debug)]
pub struct Homotopy<'a> {
    mesh: &'a Mesh,
    last: Vec<DVec3>,
    frames: usize,
    events: Vec<FilmEvent>,
    /// Those that happen on the last frame exactly.
    on_frame: BTreeMap<Element, usize>,
}

impl<'a> Homotopy<'a> {
    /// Without any frame.
    pub fn new(mesh: &'a Mesh) -> Homotopy<'a> {
        Homotopy { mesh, last: Vec::new(), frames: 0, events: Vec::new(), on_frame: BTreeMap::new() }
    }

    /// Appends a frame: decides every hinge and every face from the frame before to this one. Of what happens on a frame exactly
    /// the intervals on both sides know; it counts once, in the first of them.
    ///
    /// # Errors
    /// [`SurfaceError`] if there is not one position per vertex, finite and in reach.
    pub fn append(&mut self, positions: Vec<DVec3>) -> Result<(), SurfaceError> {
        let (found, expected) = (positions.len(), self.mesh.vertex_count());
        if found != expected {
            return Err(SurfaceError::Count { what: "positions", found, expected });
        }
        if let Some((vertex, place)) = first_out_of_reach(&positions) {
            let vertex = self.mesh.file_vertex(VertexId::new(vertex));
            return Err(SurfaceError::OutOfReach { vertex, place });
        }
        if let Some(interval) = self.frames.checked_sub(1) {
            let found = events_between(self.mesh, &self.last, &positions);
            self.join(interval, found);
        }
        self.last = positions;
        self.frames += 1;
        Ok(())
    }

    /// How many frames there are.
    pub fn frame_count(&self) -> usize {
        self.frames
    }

    /// Positions of the last frame; none before the first.
    pub fn last_positions(&self) -> &[DVec3] {
        &self.last
    }

    /// All events so far, in the order of their times.
    pub fn events(&self) -> &[FilmEvent] {
        &self.events
    }

    /// Takes the events of the next interval. What happens as it begins is known already, but not what follows.
    fn join(&mut self, interval: usize, found: Vec<Event>) {
        let on_frame = std::mem::take(&mut self.on_frame);
        for event in found {
            if interval > 0 && event.is_at(0.0) {
                if let Some(&before) = on_frame.get(&event.element) {
                    self.events[before].event.sides[1] = event.sides[1];
                }
                continue;
            }
            if event.is_at(1.0) {
                self.on_frame.insert(event.element, self.events.len());
            }
            self.events.push(FilmEvent { interval, event });
        }
    }
}

impl FilmEvent {
    /// Whether the hinge folds over for good: it is folded one way before and the other way after. What only touches does
    /// not, and of what lasts nobody knows.
    pub fn passes(&self) -> bool {
        let [before, after] = self.event.sides;
        before != after && before != Ordering::Equal && after != Ordering::Equal
    }
}
