//! Target bending angles of a scene (Sec. 6.3), at each time.

use super::bending_angles;
use crate::mesh::{EdgeId, MeshError, SelectionError, Surface, read_positions, select_edges};
use crate::scene::{AtKey, BendingFrom, BendingSection};
use crate::timeline::{Number, Parameters, TimelineError};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// Why target angles are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BendingError {
    /// Angles of positions that do not exist.
    #[error("bending angles are to come from positions, but the mesh has none; use a mesh that has them, or a `file`")]
    NoPositions,
    /// The other mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// An amount or angle.
    #[error(transparent)]
    Timeline(#[from] TimelineError),
    /// A region.
    #[error(transparent)]
    Selection(#[from] SelectionError),
    /// A formula without a value.
    #[error("it is {value} at time {time}; correct the formula, it must be finite there")]
    NotFinite {
        /// What it is.
        value: f64,
        /// When.
        time: f64,
    },
}

/// Target bending angles at all times.
#[derive(Clone, Debug)]
pub struct TargetBending {
    /// |E|, in radians.
    angles: Vec<f64>,
    amount: Number,
    /// Edges with an angle of their own, in degrees.
    regions: Vec<(Vec<EdgeId>, Number)>,
    /// Per edge: whether an angle is asked for, |E|. Where only regions have angles, all else is merely flat at rest.
    is_asked: Vec<bool>,
}

impl TargetBending {
    /// Validates what the scene says of a surface; `start` is what frames start from, |V|.
    ///
    /// # Errors
    /// [`BendingError`] with the key of the scene that is at fault.
    pub fn from_scene(
        section: &BendingSection,
        folder: &Path,
        surface: &Surface,
        start: Option<&[DVec3]>,
        parameters: &Arc<Parameters>,
    ) -> Result<TargetBending, AtKey<BendingError>> {
        let (mesh, positions) = (&surface.mesh, surface.positions.as_deref());
        let angles_of = |shape: Option<&[DVec3]>| match shape {
            Some(positions) => Ok(bending_angles(mesh, positions)),
            None => Err(AtKey { key: "bending.from".into(), error: BendingError::NoPositions }),
        };
        let angles = match &section.from {
            None => vec![0.0; mesh.edge_count()],
            Some(BendingFrom::Mesh) => angles_of(positions)?,
            Some(BendingFrom::Start) => angles_of(start)?,
            // A reflection keeps the surface's orientation and turns every fold around.
            Some(BendingFrom::Mirror) => angles_of(positions)?.into_iter().map(|angle| -angle).collect(),
            Some(BendingFrom::File(path)) => {
                bending_angles(mesh, &read_positions(&folder.join(path), mesh).map_err(AtKey::of("bending.file"))?)
            }
        };
        let amount = Number::from_scene(&section.amount, parameters).map_err(AtKey::of("bending.amount"))?;
        let mut regions = Vec::new();
        for (k, region) in section.regions.iter().enumerate() {
            let key = format!("bending.region[{k}]");
            let edges = select_edges(&region.edges, mesh, surface.places()).map_err(AtKey::of(&*key))?;
            let angle = Number::from_scene(&region.angle, parameters).map_err(AtKey::of(format!("{key}.angle")))?;
            regions.push((edges, angle));
        }
        let mut is_asked: Vec<bool> =
            mesh.edges().map(|e| section.from.is_some() && !mesh.is_boundary_edge(e)).collect();
        regions.iter().flat_map(|(edges, _)| edges).for_each(|e| is_asked[e.index()] = true);
        Ok(TargetBending { angles, amount, regions, is_asked })
    }

    /// Whether any depends on time.
    pub fn changes(&self) -> bool {
        self.amount.changes() || self.regions.iter().any(|(_, angle)| angle.changes())
    }

    /// Per edge: whether an angle is asked for, |E|.
    pub fn is_asked(&self) -> &[bool] {
        &self.is_asked
    }

    /// The targets at a time in radians, |E|; those of boundary edges mean nothing.
    ///
    /// # Errors
    /// [`BendingError::NotFinite`] with the key of the amount or angle.
    pub fn at(&self, time: f64) -> Result<Vec<f64>, AtKey<BendingError>> {
        let finite = |number: &Number, key: &str| match number.at(time) {
            value if value.is_finite() => Ok(value),
            value => Err(AtKey { key: key.to_owned(), error: BendingError::NotFinite { value, time } }),
        };
        let amount = finite(&self.amount, "bending.amount")?;
        let mut angles: Vec<f64> = self.angles.iter().map(|angle| amount * angle).collect();
        for (k, (edges, angle)) in self.regions.iter().enumerate() {
            let angle = finite(angle, &format!("bending.region[{k}].angle"))?.to_radians();
            edges.iter().for_each(|e| angles[e.index()] = angle);
        }
        Ok(angles)
    }
}
