//! `[bending]` as target bending angles.

use std::sync::Arc;

use glam::DVec3;

use crate::immersion::{TargetBending, bending_angles};
use crate::mesh::{Surface, read_positions, select_edges};
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
        let angles_of = |shape: Option<&[DVec3]>| match shape {
            Some(positions) => Ok(bending_angles(mesh, positions)),
            None => Err(self.complain(
                "bending.from",
                "bending angles are to come from positions, but the mesh has none",
                "use a mesh that has them, or a `file`",
            )),
        };
        let angles = match &section.from {
            None => None,
            Some(BendingFrom::Mesh) => Some(angles_of(positions)?),
            Some(BendingFrom::Start) => Some(angles_of(start)?),
            // A reflection keeps the surface's orientation and turns every fold around.
            Some(BendingFrom::Mirror) => Some(angles_of(positions)?.into_iter().map(|angle| -angle).collect()),
            Some(BendingFrom::File(path)) => {
                let positions = read_positions(&self.resolve(path), mesh)
                    .map_err(|error| self.complain_about("bending.file", &error))?;
                Some(bending_angles(mesh, &positions))
            }
        };
        let amount = self.number("bending.amount", &section.amount, parameters)?;
        let mut bending = match angles {
            Some(angles) => TargetBending::of_shape(mesh, angles, amount),
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
