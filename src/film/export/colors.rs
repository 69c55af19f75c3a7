//! The colours of a look as exports have them.

use crate::immersion::{FieldName, FieldValues};
use crate::render::{ColorMap, Look, Paint};
use glam::Vec3;

/// What gives the surface its colour.
#[derive(Default)]
pub(super) struct Colors {
    /// Linear light of front and back.
    pub sides: [Vec3; 2],
    map: Option<(FieldName, ColorMap, [f32; 2])>,
}

impl Colors {
    /// Those of a look that shows this field, if it shows one.
    pub fn of_look(look: &Look, field: Option<FieldName>) -> Colors {
        match (look.paint, field) {
            (Paint::Sides(sides), _) => Colors { sides, map: None },
            (Paint::Map { map, range }, field) => {
                let middle = map.color(0.5 * (range[0] + range[1]), range);
                Colors { sides: [middle; 2], map: field.map(|field| (field, map, range)) }
            }
        }
    }

    /// The field that is shown as colour.
    pub fn field(&self) -> Option<FieldName> {
        self.map.map(|(field, ..)| field)
    }

    /// The colours of its values.
    pub fn of(&self, values: &FieldValues) -> FieldColors {
        let color = |&value: &f32| self.map.map_or(self.sides[0], |(_, map, range)| map.color(value, range));
        FieldColors { per_face: values.is_per_face(), colors: values.all().iter().map(color).collect() }
    }
}

/// Colours of faces or vertices.
pub(super) struct FieldColors {
    pub per_face: bool,
    pub colors: Vec<Vec3>,
}
