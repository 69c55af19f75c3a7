//! The state and the report of one frame.

use std::io;

use super::manifest::MeshCounts;
use super::npz::{ArrayReader, ArrayWriter};
use crate::evolve::FrameReport;
use glam::{DQuat, DVec3};

/// Everything a frame hands on to the next one and to the pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameState {
    /// Counted from 1.
    pub frame: usize,
    /// In the units of the scene.
    pub time: f64,
    /// One per vertex.
    pub positions: Vec<DVec3>,
    /// The quaternion field, one unit quaternion per face.
    pub frames: Vec<DQuat>,
    /// The spin connection with its signs, one complex number (real, imaginary) per edge.
    pub transport: Vec<[f64; 2]>,
    /// What the metric asks of each edge.
    pub edge_lengths: Vec<f64>,
    /// Whether the surface folds over, per edge.
    pub rims: Vec<bool>,
    /// What the frame is worth.
    pub report: FrameReport,
}

impl FrameState {
    /// Why this state must not be kept: arrays that do not fit the mesh, or numbers that are none.
    pub(super) fn unfit(&self, mesh: &MeshCounts) -> Option<String> {
        let sizes = [
            ("positions", self.positions.len(), mesh.vertices),
            ("frames", self.frames.len(), mesh.faces),
            ("transport", self.transport.len(), mesh.edges),
            ("edge lengths", self.edge_lengths.len(), mesh.edges),
            ("rims", self.rims.len(), mesh.edges),
        ];
        if let Some((name, found, expected)) = sizes.into_iter().find(|(_, found, expected)| found != expected) {
            return Some(format!("there are {found} {name}, the mesh wants {expected}"));
        }
        if self.frame != self.report.frame {
            return Some(format!("its report is that of frame {}", self.report.frame));
        }
        let finite = self.positions.iter().all(|p| p.is_finite())
            && self.frames.iter().all(|q| q.is_finite())
            && self.transport.iter().flatten().all(|x| x.is_finite())
            && self.edge_lengths.iter().all(|x| x.is_finite())
            && self.report.is_finite();
        (!finite).then(|| "it holds numbers that are not finite, so the simulation has diverged".into())
    }

    /// The bytes of the `.npz` file. The report is not part of it.
    pub(super) fn to_npz(&self) -> io::Result<Vec<u8>> {
        let count = |n: usize| n as u64;
        let mut file = ArrayWriter::new();
        file.array("format", &[], [super::FORMAT])?;
        file.array("frame", &[], [count(self.frame)])?;
        file.array("time", &[], [self.time])?;
        let positions = self.positions.iter().flat_map(|p| p.to_array());
        file.array("positions", &[count(self.positions.len()), 3], positions)?;
        let frames = self.frames.iter().flat_map(|q| [q.w, q.x, q.y, q.z]);
        file.array("face_frames", &[count(self.frames.len()), 4], frames)?;
        file.array("transport", &[count(self.transport.len()), 2], self.transport.iter().copied().flatten())?;
        file.array("edge_lengths", &[count(self.edge_lengths.len())], self.edge_lengths.iter().copied())?;
        file.array("rims", &[count(self.rims.len())], self.rims.iter().map(|&rim| u8::from(rim)))?;
        file.finish()
    }

    /// The reverse of [`FrameState::to_npz`].
    pub(super) fn from_npz(bytes: &[u8], report: FrameReport, mesh: &MeshCounts) -> Result<FrameState, String> {
        let [vertices, edges, faces] = [mesh.vertices, mesh.edges, mesh.faces].map(|n| n as u64);
        let mut file = ArrayReader::new(bytes)?;
        let positions = file.array::<f64>("positions", &[vertices, 3])?;
        let frames = file.array::<f64>("face_frames", &[faces, 4])?;
        let transport = file.array::<f64>("transport", &[edges, 2])?;
        Ok(FrameState {
            frame: report.frame,
            time: file.array::<f64>("time", &[])?.first().copied().unwrap_or(report.time),
            positions: positions.as_chunks().0.iter().map(|&p| DVec3::from_array(p)).collect(),
            frames: frames.as_chunks().0.iter().map(|&[s, x, y, z]| DQuat::from_xyzw(x, y, z, s)).collect(),
            transport: transport.as_chunks().0.to_vec(),
            edge_lengths: file.array("edge_lengths", &[edges])?,
            rims: file.array::<u8>("rims", &[edges])?.into_iter().map(|rim| rim != 0).collect(),
            report,
        })
    }
}

impl FrameReport {
    fn is_finite(&self) -> bool {
        let errors = [self.l2_length_error, self.max_length_error, self.median_length_error, self.p95_length_error];
        let rest = [self.time, self.rim_length, self.energy, self.period_error, self.seconds];
        errors.iter().chain(&rest).all(|x| x.is_finite())
    }
}
