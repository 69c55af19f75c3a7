//! `[bending]` as target bending angles.

use std::sync::Arc;

use glam::DVec3;

use crate::immersion::{TargetBending, bending_angles};
use crate::mesh::{MeshError, Surface, read_bending_angles, read_positions, select_edges};
use crate::scene::{BendingFrom, Scene, SceneError};
use crate::timeline::Parameters;

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
        let known = |angles: Vec<f64>| angles.into_iter().map(Some).collect::<Vec<_>>();
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
        let angles = match &section.from {
            None => None,
            Some(BendingFrom::Mesh) => Some(of_mesh()?),
            Some(BendingFrom::Start) => Some(angles_of(start)?),
            // A reflection keeps the surface's orientation and turns every fold around.
            Some(BendingFrom::Mirror) => Some(of_mesh()?.into_iter().map(|angle| Some(-angle?)).collect()),
            Some(BendingFrom::File(path)) => {
                let path = self.resolve(path);
                let fault = |error: MeshError| self.complain_about("bending.file", &error);
                Some(match read_bending_angles(&path, mesh).map_err(fault)? {
                    Some(angles) => angles,
                    None => known(bending_angles(mesh, &read_positions(&path, mesh).map_err(fault)?)),
                })
            }
        };
        let amount = self.number("bending.amount", &section.amount, parameters)?;
        let mut bending = match angles {
            Some(angles) => TargetBending::of_angles(mesh, angles, amount),
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
