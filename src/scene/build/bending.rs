//! `[bending]` as target bending angles.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use crate::immersion::{TargetBending, bending_angles};
use crate::mesh::{
    Keyframe, Mesh, MeshError, Surface, read_bending_angles, read_bending_keyframes, read_positions, select_edges,
};
use crate::scene::{BendingFrom, Scene, SceneError};
use crate::timeline::{Ease, Extrapolation, Keyframes, Parameters};

/// The angles that a file decrees, or those of its positions, |E|; none where the file says none.
fn angles_of_file(path: &Path, mesh: &Mesh) -> Result<Vec<Option<f64>>, MeshError> {
    match read_bending_angles(path, mesh)? {
        Some(angles) => Ok(angles),
        None => Ok(known(bending_angles(mesh, &read_positions(path, mesh)?))),
    }
}

fn known(angles: Vec<f64>) -> Vec<Option<f64>> {
    angles.into_iter().map(Some).collect()
}

impl Scene {
    /// The target angles of a surface; `start` is what frames start from, |V|.
    pub(super) fn target_bending(
        &self,
        surface: &Surface,
        start: Option<&[DVec3]>,
        parameters: &Arc<Parameters>,
    ) -> Result<Option<TargetBending>, SceneError> {
        let Some(section) = &self.bending else { return Ok(None) };
        let (mesh, positions) = (&surface.mesh, surface.positions.as_deref());
        let angles_of = |shape: Option<&[DVec3]>| match shape {
            Some(positions) => Ok(known(bending_angles(mesh, positions))),
            None => Err(self.complain(
                "bending.from",
                "bending angles are to come from positions, but the mesh has none",
                "use a mesh that has them, or a `file`",
            )),
        };
        // Those that the file of the mesh decrees, or those of its positions.
        let of_mesh = || match self.mesh.file() {
            Some(path) => match read_bending_angles(&self.resolve(path), mesh) {
                Ok(Some(angles)) => Ok(angles),
                Ok(None) => angles_of(positions),
                Err(error) => Err(self.complain_about("bending.from", &error)),
            },
            None => angles_of(positions),
        };
        let keys = match &section.from {
            None => None,
            Some(BendingFrom::Mesh) => Some(Keyframes::constant(of_mesh()?)),
            Some(BendingFrom::Start) => Some(Keyframes::constant(angles_of(start)?)),
            // A reflection keeps the surface's orientation and turns every fold around.
            Some(BendingFrom::Mirror) => {
                Some(Keyframes::constant(of_mesh()?.into_iter().map(|angle| Some(-angle?)).collect()))
            }
            Some(BendingFrom::File(path)) => {
                let angles = angles_of_file(&self.resolve(path), mesh);
                Some(Keyframes::constant(angles.map_err(|error| self.complain_about("bending.file", &error))?))
            }
            Some(BendingFrom::Files(files)) => {
                let angles = |path: &Path| {
                    let angles = |key| match key {
                        Keyframe::Decreed(angles) => angles,
                        Keyframe::Positions(positions) => known(bending_angles(mesh, &positions)),
                    };
                    Ok(read_bending_keyframes(path, mesh)?.into_iter().map(angles).collect())
                };
                let (times, angles) = self.keyframes_of_files("bending", files, mesh, angles)?;
                let keys = Keyframes::new(times, angles, Ease::Linear, Extrapolation::Hold);
                Some(keys.map_err(|error| self.complain_about("bending.files", &error))?)
            }
        };
        let amount = self.number("bending.amount", &section.amount, parameters)?;
        let mut bending = match keys {
            Some(keys) => TargetBending::of_keyframes(mesh, keys, amount),
            None => TargetBending::flat(mesh),
        };
        for (k, region) in section.regions.iter().enumerate() {
            let key = format!("bending.region[{k}]");
            let edges = select_edges(&region.edges, mesh, surface.places())
                .map_err(|error| self.complain_about(&key, &error))?;
            let angle = self.number(&format!("{key}.angle"), &region.angle, parameters)?;
            bending = bending.with_region(edges, angle);
        }
        Ok(Some(bending))
    }
}
