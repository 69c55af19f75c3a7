//! A frame of a film: the state of the surface and what it is worth.

use super::report::FrameReport;
use crate::advice::Advice;
use crate::algebra::Complex;
use crate::mesh::{EdgeId, Mesh};
use crate::spin::SpinStructure;
use glam::{DQuat, DVec3};

/// Everything that a frame hands on: to the next one, to whoever goes on later, and to the pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Vertex positions, |V|.
    pub positions: Vec<DVec3>,
    /// The quaternion field: unit quaternions, |F|.
    pub face_frames: Vec<DQuat>,
    /// The spin connection with its signs.
    pub spin: SpinStructure,
    /// The lengths that the metric asks for, |E|.
    pub edge_lengths: Vec<f64>,
    /// Edges with rim bit 1, in order.
    pub rims: Vec<EdgeId>,
    /// Which frame it is, when, and what it is worth.
    pub report: FrameReport,
}

/// Why a frame does not belong to a mesh, or is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum UnfitFrame {
    #[error("there are {found} {what}, the mesh wants {expected}; {}", self.remedy())]
    Count { what: &'static str, found: usize, expected: usize },
    #[error("the {what} hold numbers that are not finite, the first at {first}; {}", self.remedy())]
    NotFinite { what: &'static str, first: String },
    #[error("the face frame of face {face} has length {length}; {}", self.remedy())]
    NotUnit { face: usize, length: f64 },
    #[error("the transport of edge {edge} has modulus {modulus}; {}", self.remedy())]
    NotUnitTransport { edge: usize, modulus: f64 },
    #[error("edge {edge} is a rim, and the mesh has {edges} edges; {}", self.remedy())]
    NoSuchEdge { edge: usize, edges: usize },
}

impl Advice for UnfitFrame {
    fn remedy(&self) -> String {
        match self {
            UnfitFrame::Count { .. } | UnfitFrame::NoSuchEdge { .. } => "take a frame of a film on this mesh".into(),
            UnfitFrame::NotFinite { .. } => "the simulation has diverged, simulate anew".into(),
            UnfitFrame::NotUnit { .. } => "give unit quaternions".into(),
            UnfitFrame::NotUnitTransport { .. } => "give unit complex numbers".into(),
        }
    }
}

impl Frame {
    /// Whether its arrays belong to this mesh and hold numbers.
    ///
    /// # Errors
    /// [`UnfitFrame`] for the first array that does not.
    pub fn fits(&self, mesh: &Mesh) -> Result<(), UnfitFrame> {
        self.fits_counts(mesh.vertex_count(), mesh.edge_count(), mesh.face_count())
    }

    /// As [`Frame::fits`], of a mesh with so many vertices, edges and faces.
    ///
    /// # Errors
    /// [`UnfitFrame`]
    pub fn fits_counts(&self, vertices: usize, edges: usize, faces: usize) -> Result<(), UnfitFrame> {
        let transports = self.spin.transports();
        let sizes = [
            ("positions", self.positions.len(), vertices),
            ("face frames", self.face_frames.len(), faces),
            ("transports", transports.len(), edges),
            ("edge lengths", self.edge_lengths.len(), edges),
        ];
        if let Some((what, found, expected)) = sizes.into_iter().find(|(_, found, expected)| found != expected) {
            return Err(UnfitFrame::Count { what, found, expected });
        }
        if let Some(edge) = self.rims.iter().map(|e| e.index()).find(|edge| *edge >= edges) {
            return Err(UnfitFrame::NoSuchEdge { edge, edges });
        }
        let lost = [
            ("positions", "vertex", self.positions.iter().position(|p| !p.is_finite())),
            ("face frames", "face", self.face_frames.iter().position(|q| !q.is_finite())),
            ("transports", "edge", transports.iter().position(|t| !(t.re.is_finite() && t.im.is_finite()))),
            ("edge lengths", "edge", self.edge_lengths.iter().position(|x| !x.is_finite())),
        ];
        if let Some((what, first)) =
            lost.into_iter().find_map(|(what, element, at)| Some((what, format!("{element} {}", at?))))
        {
            return Err(UnfitFrame::NotFinite { what, first });
        }
        if let Some(first) = self.report.first_lost() {
            return Err(UnfitFrame::NotFinite { what: "measures", first: format!("`{first}`") });
        }
        let modulus = |t: &Complex| (t.re * t.re + t.im * t.im).sqrt();
        if let Some(edge) = transports.iter().position(|t| (modulus(t) - 1.0).abs() > UNIT) {
            return Err(UnfitFrame::NotUnitTransport { edge, modulus: modulus(&transports[edge]) });
        }
        check_face_frames(&self.face_frames, faces)
    }

    /// Per edge: whether the surface folds over there, |E|.
    pub fn rim_bits(&self) -> Vec<bool> {
        let mut bits = vec![false; self.edge_lengths.len()];
        self.rims.iter().for_each(|e| bits[e.index()] = true);
        bits
    }
}

/// Steps leave frames and transports unit up to rounding, which is far less than this.
const UNIT: f64 = 1e-6;

/// Whether these are the frames of so many faces.
pub(super) fn check_face_frames(frames: &[DQuat], faces: usize) -> Result<(), UnfitFrame> {
    if frames.len() != faces {
        return Err(UnfitFrame::Count { what: "face frames", found: frames.len(), expected: faces });
    }
    let is_unit = |q: &DQuat| (q.length() - 1.0).abs() <= UNIT;
    match frames.iter().position(|q| !is_unit(q)) {
        Some(face) => Err(UnfitFrame::NotUnit { face, length: frames[face].length() }),
        None => Ok(()),
    }
}
