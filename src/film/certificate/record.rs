//! `certificate.json`: what was decided, and of which numbers.

use serde::{Deserialize, Serialize};

use crate::digest::Key;
use crate::homotopy::{Change, RimCounts, Sheets};

/// Its name in the folder of the film.
pub const CERTIFICATE: &str = "certificate.json";

/// Counts the ways in which films have been certified, so that a certificate of an earlier one is made anew.
pub const CERTIFIER: u32 = 1;

/// What happens between the frames of a film when all vertices move on straight lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// [`CERTIFIER`]
    pub certifier: u32,
    /// Which program made it.
    pub program: String,
    /// Whether the film is a regular homotopy: its first frame has no pinch points, and there are no events.
    pub is_regular_homotopy: bool,
    /// Pinch points of the first frame. A surface that has any is no immersion.
    pub pinch_points: usize,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces, each of which was decided in each interval.
    pub faces: usize,
    /// Number of hinges, which are the edges inside, each of which was decided in each interval.
    pub hinges: usize,
    /// SHA-256 of the corners of all faces, as `triangles` in `mesh.npz`: |F| × 3 numbers of 4 bytes, the smallest first.
    pub triangles_sha256: Key,
    /// All frames, in order.
    pub frames: Vec<CertifiedFrame>,
    /// Events of each kind.
    pub counts: RimCounts,
    /// Events grouped into rims.
    pub rims: Vec<CertifiedRim>,
    /// All events, in the order of their times.
    pub events: Vec<CertifiedEvent>,
    /// Where sheets pass through each other, if that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub multiple_points: Option<CertifiedPoints>,
}

impl Certificate {
    /// Of each frame, how many events there are on the way from the one before it.
    pub fn events_before_frames(&self) -> Vec<usize> {
        let mut counts = vec![0; self.frames.len()];
        for event in &self.events {
            if let Some(count) = counts.get_mut(event.frames[0]) {
                *count += 1;
            }
        }
        counts
    }
}

/// Double curves, triple points and quadruple points of a film.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CertifiedPoints {
    /// Of each frame, in order.
    pub frames: Vec<Sheets>,
    /// All moments at which four sheets meet in a point, in order.
    pub quadruple_points: Vec<CertifiedQuadruple>,
}

/// A moment at which four sheets meet in a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CertifiedQuadruple {
    /// Between which frames.
    pub frames: [usize; 2],
    /// When, from 0 to 1 between the two frames.
    pub time: f64,
    /// A triangle of each sheet, by its vertices: numbers of the mesh file, from 0.
    pub faces: [[usize; 3]; 4],
    /// Where.
    pub place: [f64; 3],
}

/// A frame whose positions were read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CertifiedFrame {
    /// Its number, from 1.
    pub frame: usize,
    /// Its time on the clock of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Its file, in the folder.
    pub file: String,
    /// SHA-256 of the file.
    pub file_sha256: Key,
    /// SHA-256 of its positions: |V| × 3 numbers of 8 bytes, the smallest first.
    pub positions_sha256: Key,
}

/// A rim and what becomes of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CertifiedRim {
    /// Its events by their places in the list, counted from 0.
    pub events: Vec<usize>,
    /// How many of each kind.
    pub counts: RimCounts,
    /// Edges of it that are left on the last frame.
    pub edges_left: usize,
}

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// The faces of a hinge lie upon each other.
    Fold,
    /// The corners of a face lie on a line.
    Face,
}

/// A moment at which the surface is no immersion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CertifiedEvent {
    /// Between which frames. What happens on a frame exactly stands in the interval that ends with it.
    pub frames: [usize; 2],
    /// Not before the first and not after the second of these times, which run from 0 to 1 between the two frames.
    pub time: [f64; 2],
    /// What happens.
    pub kind: EventKind,
    /// What that is to the rims of the surface.
    pub change: Change,
    /// Whether it lasts all of that time.
    pub lasts: bool,
    /// The vertices a, b, c, d of the hinge with faces (a, b, c) and (b, a, d), or those of the face: numbers of the mesh file, from 0.
    pub vertices: Vec<usize>,
    /// The middle of the hinge's edge, or of the face, then.
    pub place: [f64; 3],
}
