//! A quantity on the surface, and which of its values a picture shows.

use crate::immersion::{FieldName, FieldValues};

/// Values of a quantity, with a name and a unit for legends and layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// For layers of files, as in `length_error`.
    pub name: String,
    /// Written behind numbers, such as `%` or `°`; empty for pure numbers.
    pub unit: &'static str,
    /// The values.
    pub values: FieldValues,
    /// Values that differ by a period mean the same, as angles do.
    pub period: Option<f32>,
}

impl Field {
    /// A field of a frame.
    pub fn new(field: FieldName, values: FieldValues) -> Field {
        let [_, unit] = description(field);
        Field { name: field.name().to_owned(), unit, values, period: None }
    }

    /// Values at the corners of a triangle of the scenery. Corners of a periodic field are within half a
    /// period of the first.
    pub(in crate::render) fn at_corners(&self, triangle: usize, corners: [u32; 3]) -> [f32; 3] {
        match &self.values {
            FieldValues::PerFace(values) => [values[triangle]; 3],
            FieldValues::PerVertex(values) => {
                let [first, second, third] = corners.map(|vertex| values[vertex as usize]);
                let near = |value: f32| match self.period {
                    Some(period) => value - ((value - first) / period).round() * period,
                    None => value,
                };
                [first, near(second), near(third)]
            }
        }
    }

    /// Number of values.
    pub(in crate::render) fn len(&self) -> usize {
        self.values.all().len()
    }
}

/// Words for a legend, and unit.
pub fn description(field: FieldName) -> [&'static str; 2] {
    match field {
        FieldName::LengthError => ["length error", "%"],
        FieldName::GaussianCurvature => ["Gaussian curvature", ""],
        FieldName::MeanCurvature => ["mean curvature", ""],
        FieldName::ConformalFactor => ["log conformal factor", ""],
        FieldName::EnergyDensity => ["energy density", ""],
        FieldName::BendingAngle => ["bending angle", "°"],
        FieldName::Generators => ["generator", ""],
    }
}
