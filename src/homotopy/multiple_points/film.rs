//! Multiple points of a film, whose frames come one after the other.

use super::general_position::in_general_position;
use super::moment::{Moment, moments};
use super::surface::Sheets;
use crate::algebra::box_of;
use crate::mesh::{FaceId, Mesh};
use glam::DVec3;

/// A moment of a film at which four sheets meet in a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadruplePoint {
    /// Between which frames: those of this number and of the next one, counted from 0.
    pub interval: usize,
    /// When, from 0 to 1 between the two frames.
    pub time: f64,
    /// A face of each sheet.
    pub faces: [FaceId; 4],
    /// Where.
    pub place: DVec3,
}

/// What is known of a film. Vertices move on straight lines from each frame to the next.
#[derive(Clone, Debug)]
pub struct MultiplePoints {
    triangles: Vec<[u32; 3]>,
    /// Extent of the first frame.
    size: f64,
    last: Vec<DVec3>,
    frames: Vec<Sheets>,
    quadruple: Vec<QuadruplePoint>,
}

impl MultiplePoints {
    /// Without any frame.
    pub fn new(mesh: &Mesh) -> MultiplePoints {
        let triangles = mesh.triangles();
        MultiplePoints { triangles, size: 0.0, last: Vec::new(), frames: Vec::new(), quadruple: Vec::new() }
    }

    /// Appends a frame: counts what there is on it, and finds what happens after the frame before. There must be one position per vertex,
    /// finite and in reach.
    pub fn append(&mut self, positions: &[DVec3]) {
        if self.frames.is_empty() {
            let [low, high] = box_of(positions.iter().copied());
            self.size = (high - low).max_element();
        }
        let here = in_general_position(positions, self.size);
        self.frames.push(Sheets::of(&self.triangles, &here));
        if let Some(interval) = self.frames.len().checked_sub(2) {
            let found = moments(&self.triangles, &self.last, &here).into_iter();
            self.quadruple.extend(found.map(|Moment { time, faces, place }| QuadruplePoint {
                interval,
                time,
                faces: faces.map(FaceId::new),
                place,
            }));
        }
        self.last = here;
    }

    /// Of each frame, in order.
    pub fn frames(&self) -> &[Sheets] {
        &self.frames
    }

    /// All quadruple points, in the order of their times.
    pub fn quadruple_points(&self) -> &[QuadruplePoint] {
        &self.quadruple
    }
}
