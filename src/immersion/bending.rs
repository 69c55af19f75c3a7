//! Target bending angles (Sec. 6.3), at each time.

use crate::advice::Advice;
use crate::mesh::{EdgeId, Mesh};
use crate::timeline::{Keyframes, Number};

/// The number that target angles are refused for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BendingPart {
    /// What the angles of a shape are multiplied with.
    Amount,
    /// The angle of the region of this number, from 0.
    Region(usize),
}

/// An amount or an angle that has no value at a time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("it is {value} at time {time}; {}", self.remedy())]
pub struct NoAngle {
    /// Which.
    pub part: BendingPart,
    /// What it is.
    pub value: f64,
    /// When.
    pub time: f64,
}

impl Advice for NoAngle {
    fn remedy(&self) -> String {
        "correct the formula, it must be finite there".into()
    }
}

/// Target bending angles at all times.
#[derive(Clone, Debug)]
pub struct TargetBending {
    /// |E|, in radians.
    angles: Keyframes<Vec<f64>>,
    amount: Number,
    /// Edges with an angle of their own, in degrees.
    regions: Vec<(Vec<EdgeId>, Number)>,
    /// Per edge: whether an angle is asked for, |E|. Where only regions have angles, all else is merely flat at rest.
    is_asked: Vec<bool>,
}

impl TargetBending {
    /// So much of the angles of a shape (|E|, in radians). Everything inside is asked to bend like that.
    pub fn of_shape(mesh: &Mesh, angles: Vec<f64>, amount: Number) -> TargetBending {
        let is_asked = mesh.edges().map(|e| !mesh.is_boundary_edge(e)).collect();
        TargetBending { angles: Keyframes::constant(angles), amount, regions: Vec::new(), is_asked }
    }

    /// So much of given angles (|E|, in radians), each time's between those of the keyframes around it. Where a keyframe has
    /// none the edge is flat at rest, and no angle is asked for. Those of boundary edges mean nothing.
    pub fn of_keyframes(mesh: &Mesh, angles: Keyframes<Vec<Option<f64>>>, amount: Number) -> TargetBending {
        let is_known = |e: EdgeId| angles.values().iter().all(|angles| angles[e.index()].is_some());
        let is_asked = mesh.edges().map(|e| is_known(e) && !mesh.is_boundary_edge(e)).collect();
        let angles = angles.map(|angles| angles.into_iter().map(|angle| angle.unwrap_or(0.0)).collect());
        TargetBending { angles, amount, regions: Vec::new(), is_asked }
    }

    /// Flat at rest; no angle is asked for yet.
    pub fn flat(mesh: &Mesh) -> TargetBending {
        let amount = Number::Constant(1.0);
        let angles = Keyframes::constant(vec![0.0; mesh.edge_count()]);
        let is_asked = vec![false; mesh.edge_count()];
        TargetBending { angles, amount, regions: Vec::new(), is_asked }
    }

    /// With one angle in degrees for these edges, in place of what held before; positive as on a sphere whose normals
    /// point outward.
    pub fn with_region(mut self, edges: Vec<EdgeId>, degrees: Number) -> TargetBending {
        edges.iter().for_each(|e| self.is_asked[e.index()] = true);
        self.regions.push((edges, degrees));
        self
    }

    /// Whether any depends on time.
    pub fn changes(&self) -> bool {
        self.angles.values().len() > 1 || self.amount.changes() || self.regions.iter().any(|(_, angle)| angle.changes())
    }

    /// Per edge: whether an angle is asked for, |E|.
    pub fn is_asked(&self) -> &[bool] {
        &self.is_asked
    }

    /// The targets at a time in radians, |E|; those of boundary edges mean nothing.
    ///
    /// # Errors
    /// [`NoAngle`] with the amount or angle that has no value.
    pub fn at(&self, time: f64) -> Result<Vec<f64>, NoAngle> {
        let finite = |number: &Number, part| match number.at(time) {
            value if value.is_finite() => Ok(value),
            value => Err(NoAngle { part, value, time }),
        };
        let amount = finite(&self.amount, BendingPart::Amount)?;
        let (before, after, part) = self.angles.around(time);
        let between = |(a, b): (&f64, &f64)| match part {
            0.0 => amount * a,
            1.0 => amount * b,
            part => amount * (a + (b - a) * part),
        };
        let mut angles: Vec<f64> = before.iter().zip(after).map(between).collect();
        for (k, (edges, angle)) in self.regions.iter().enumerate() {
            let angle = finite(angle, BendingPart::Region(k))?.to_radians();
            edges.iter().for_each(|e| angles[e.index()] = angle);
        }
        Ok(angles)
    }
}
