//! NumPy: a file of each frame with positions and all fields, in the order of the arrays of `mesh.npz`.

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};
use crate::npy::ArrayWriter;

pub(super) struct Npz<'a>(pub &'a Subject);

impl Layout for Npz<'_> {
    fn ending(&self) -> Option<&'static str> {
        Some("npz")
    }

    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        self.arrays(moment).map(|bytes| vec![bytes]).map_err(|error| error.to_string())
    }

    fn end(&self, _: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        Vec::new()
    }
}

impl Npz<'_> {
    fn arrays(&self, moment: &Moment) -> std::io::Result<Vec<u8>> {
        let Subject { triangles, edges, .. } = self.0;
        let count = |n: usize| n as u64;
        let mut file = ArrayWriter::new();
        file.array("frame", &[], [count(moment.number)])?;
        file.array("time", &[], [moment.time])?;
        file.array("triangles", &[count(triangles.len()), 3], triangles.iter().flatten().copied())?;
        file.array("edges", &[count(edges.len()), 2], edges.iter().flatten().copied())?;
        let positions = moment.positions.iter().flat_map(|place| place.to_array());
        file.array("positions", &[count(moment.positions.len()), 3], positions)?;
        let normals = moment.normals.iter().flat_map(|normal| normal.to_array());
        file.array("normals", &[count(moment.normals.len()), 3], normals)?;
        file.array("edge_lengths", &[count(edges.len())], moment.edge_lengths.iter().copied())?;
        file.array("bending_angles", &[count(edges.len())], moment.bending_angles.iter().copied())?;
        for (name, values) in &moment.fields {
            file.array(name.name(), &[count(values.all().len())], values.all().iter().copied())?;
        }
        file.finish()
    }
}
