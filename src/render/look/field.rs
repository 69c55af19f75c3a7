//! A quantity on the surface, and which of its values a picture shows.

use crate::immersion::{FieldName, FieldValues};

/// Values of a quantity, with a name for layers, in the unit that files have them in.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// For layers of files, as in `length_error`.
    pub name: String,
    /// The values.
    pub values: FieldValues,
    /// Values that differ by a period mean the same, as angles do.
    pub period: Option<f32>,
}

impl Field {
    /// A field of a frame.
    pub fn new(field: FieldName, values: FieldValues) -> Field {
        Field { name: field.name().to_owned(), values, period: None }
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

/// How the values of a field are told to people.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wording {
    /// Over a legend.
    pub title: &'static str,
    /// Written behind numbers, such as `%` or `°`; empty for pure numbers.
    pub unit: &'static str,
    /// So many of this unit are one of the values: people read per cent, files have ratios.
    pub factor: f64,
}

/// How the values of a field are told to people.
pub fn wording(field: FieldName) -> Wording {
    let (title, unit, factor) = match field {
        FieldName::LengthError => ("length error", "%", 100.0),
        FieldName::GaussianCurvature => ("Gaussian curvature", "", 1.0),
        FieldName::MeanCurvature => ("mean curvature", "", 1.0),
        FieldName::ConformalFactor => ("log conformal factor", "", 1.0),
        FieldName::EnergyDensity => ("energy density", "", 1.0),
        FieldName::BendingAngle => ("bending angle", "°", 1.0),
        FieldName::Generators => ("generator", "", 1.0),
    };
    Wording { title, unit, factor }
}
