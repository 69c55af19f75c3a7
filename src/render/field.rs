//! A quantity on the surface.

/// Values of a quantity, with a name and a unit for legends and layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// As in scene files: `length_error`.
    pub name: String,
    /// Written behind numbers, such as `%` or `°`; empty for pure numbers.
    pub unit: &'static str,
    /// The values.
    pub values: FieldValues,
    /// Values that differ by a period mean the same, as angles do.
    pub period: Option<f32>,
}

/// Where the values of a field are.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValues {
    /// One per triangle.
    PerFace(Vec<f32>),
    /// One per vertex, linear on triangles.
    PerVertex(Vec<f32>),
}

impl Field {
    /// Values at the corners of a triangle of the scenery. Corners of a periodic field are within half a
    /// period of the first.
    pub fn at_corners(&self, triangle: usize, corners: [u32; 3]) -> [f32; 3] {
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
    pub(super) fn len(&self) -> usize {
        match &self.values {
            FieldValues::PerFace(values) | FieldValues::PerVertex(values) => values.len(),
        }
    }
}
