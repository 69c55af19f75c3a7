//! The state of a frame as an `.npz` file.

use std::io;

use super::manifest::{FORMAT, MeshCounts};
use crate::algebra::Complex;
use crate::evolve::{Frame, FrameReport};
use crate::mesh::EdgeId;
use crate::npy::{ArrayReader, ArrayWriter};
use crate::spin::SpinStructure;
use glam::{DQuat, DVec3};

/// The bytes of the `.npz` file. The report is not part of it.
pub(super) fn to_npz(frame: &Frame) -> io::Result<Vec<u8>> {
    let count = |n: usize| n as u64;
    let mut file = ArrayWriter::new();
    file.array("format", &[], [FORMAT])?;
    file.array("frame", &[], [count(frame.report.frame)])?;
    file.array("time", &[], [frame.report.time])?;
    let positions = frame.positions.iter().flat_map(|p| p.to_array());
    file.array("positions", &[count(frame.positions.len()), 3], positions)?;
    let face_frames = frame.face_frames.iter().flat_map(|q| [q.w, q.x, q.y, q.z]);
    file.array("face_frames", &[count(frame.face_frames.len()), 4], face_frames)?;
    let transports = frame.spin.transports();
    file.array("transport", &[count(transports.len()), 2], transports.iter().flat_map(|t| [t.re, t.im]))?;
    file.array("edge_lengths", &[count(frame.edge_lengths.len())], frame.edge_lengths.iter().copied())?;
    let rims = frame.rim_bits();
    file.array("rims", &[count(rims.len())], rims.into_iter().map(u8::from))?;
    file.finish()
}

/// The reverse of [`to_npz`].
pub(super) fn from_npz(bytes: &[u8], report: FrameReport, mesh: &MeshCounts) -> Result<Frame, String> {
    let [vertices, edges, faces] = [mesh.vertices, mesh.edges, mesh.faces].map(|n| n as u64);
    let mut file = ArrayReader::new(bytes)?;
    let positions = file.array::<f64>("positions", &[vertices, 3])?;
    let face_frames = file.array::<f64>("face_frames", &[faces, 4])?;
    let transports = file.array::<f64>("transport", &[edges, 2])?;
    let transports = transports.as_chunks().0.iter().map(|&[re, im]| Complex { re, im }).collect();
    let rims = file.array::<u8>("rims", &[edges])?;
    Ok(Frame {
        positions: positions.as_chunks().0.iter().map(|&p| DVec3::from_array(p)).collect(),
        face_frames: face_frames.as_chunks().0.iter().map(|&[s, x, y, z]| DQuat::from_xyzw(x, y, z, s)).collect(),
        spin: SpinStructure::of_known(transports),
        edge_lengths: file.array("edge_lengths", &[edges])?,
        rims: (0..rims.len()).filter(|&e| rims[e] != 0).map(EdgeId::new).collect(),
        report,
    })
}
