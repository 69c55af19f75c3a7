//! Points moved by formulas, one for each coordinate.

use super::error::TimelineError;
use super::formula::{Formula, FormulaAt, Parameters};
use glam::DVec3;
use std::sync::Arc;

/// Three formulas in x, y and z of a point.
#[derive(Clone, Debug)]
pub struct PointFormula([Formula; 3]);

impl PointFormula {
    /// Parses the formulas of the three coordinates.
    ///
    /// # Errors
    /// [`TimelineError::Formula`]
    pub fn parse(texts: &[String; 3], parameters: &Arc<Parameters>) -> Result<PointFormula, TimelineError> {
        let parse = |text: &String| Formula::parse(text, &["x", "y", "z"], parameters);
        let [x, y, z] = texts.each_ref().map(parse);
        Ok(PointFormula([x?, y?, z?]))
    }

    /// At a time, to be evaluated at many points.
    pub fn at(&self, time: f64) -> PointFormulaAt<'_> {
        PointFormulaAt(self.0.each_ref().map(|formula| formula.at(time)))
    }

    /// Whether the points can depend on time.
    pub fn changes(&self) -> bool {
        self.0.iter().any(Formula::changes)
    }
}

/// A motion of points at one time.
#[derive(Clone, Debug)]
pub struct PointFormulaAt<'a>([FormulaAt<'a>; 3]);

impl PointFormulaAt<'_> {
    /// Where a point goes; not finite where a formula has no value.
    pub fn point(&self, point: DVec3) -> DVec3 {
        DVec3::from_array(self.0.each_ref().map(|formula| formula.value(&point.to_array())))
    }
}
