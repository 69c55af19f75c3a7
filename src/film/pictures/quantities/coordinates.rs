//! What the patterns of a look run along: coordinates of the mesh as fields.

use std::sync::Arc;

use glam::DVec3;

use crate::film::disk::FilmMesh;
use crate::immersion::FieldValues;
use crate::mesh::VertexId;
use crate::metric::shortest_paths;
use crate::render::Field;
use crate::scene::PatternAlong;
use crate::timeline::{Formula, Parameters, TimelineError};

/// What is known of the mesh apart from its shape in space.
pub(super) struct Chart<'a> {
    /// Connectivity, places, and the sides of a flat torus, whose coordinates go around.
    pub surface: &'a FilmMesh,
    /// One per edge.
    pub edge_lengths: &'a [f64],
}

impl Chart<'_> {
    /// The coordinate a pattern runs along and, where there is one, the coordinate across, in periods: from 0 to
    /// `count`. Fields, which the chart does not know, give none.
    ///
    /// # Errors
    /// [`TimelineError::Formula`] if the formula is none.
    pub fn coordinates(
        &self,
        along: &PatternAlong,
        count: usize,
        parameters: &Arc<Parameters>,
    ) -> Result<[Option<Field>; 2], TimelineError> {
        Ok(match along {
            PatternAlong::Parallels => [Some(self.height(count)), self.angle(count)],
            PatternAlong::Meridians => match self.angle(count) {
                Some(angle) => [Some(angle), Some(self.height(count))],
                None => [Some(self.height(count)), None],
            },
            PatternAlong::Formula(text) => [Some(self.formula(text, count, parameters)?), None],
            PatternAlong::Field(_) => [None, None],
        })
    }

    /// The height z; on flat meshes the distance from the origin, on flat tori the part of the way along `b`, and
    /// without places the distance from the first vertex.
    fn height(&self, count: usize) -> Field {
        let Some(places) = &self.surface.places else { return spread(self.distances(), count) };
        if let Some(lattice) = self.lattice() {
            return around(places.iter().map(|&place| lattice(place)[1]), count);
        }
        let (low, high) = places.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
        if high.z - low.z > 1e-9 * (high - low).length() {
            spread(places.iter().map(|place| place.z).collect(), count)
        } else {
            spread(places.iter().map(|place| place.truncate().length()).collect(), count)
        }
    }

    /// The part of the way around the z axis, or along `a` of a flat torus.
    fn angle(&self, count: usize) -> Option<Field> {
        let places = self.surface.places.as_ref()?;
        let turn = |place: &DVec3| libm::atan2(place.y, place.x) / std::f64::consts::TAU;
        Some(match self.lattice() {
            Some(lattice) => around(places.iter().map(|&place| lattice(place)[0]), count),
            None => around(places.iter().map(turn), count),
        })
    }

    /// Parts of the way along the lattice vectors of a flat torus.
    fn lattice(&self) -> Option<impl Fn(DVec3) -> [f64; 2]> {
        let [a, b] = self.surface.lattice?.map(glam::DVec2::from);
        let area = a.perp_dot(b);
        Some(move |place: DVec3| [place.truncate().perp_dot(b) / area, a.perp_dot(place.truncate()) / area])
    }

    fn formula(&self, text: &str, count: usize, parameters: &Arc<Parameters>) -> Result<Field, TimelineError> {
        let formula = Formula::parse(text, &["x", "y", "z"], parameters)?;
        let at = formula.at(0.0);
        let places = self.surface.places.as_deref().unwrap_or_default();
        let values = places.iter().map(|place| at.value(&place.to_array())).collect::<Vec<f64>>();
        Ok(if places.is_empty() { self.height(count) } else { spread(values, count) })
    }

    /// Lengths of the shortest paths along edges from vertex 0; 0 where none leads.
    fn distances(&self) -> Vec<f64> {
        let distances = shortest_paths(&self.surface.mesh, self.edge_lengths, VertexId::new(0));
        distances.into_iter().map(|distance| if distance.is_finite() { distance } else { 0.0 }).collect()
    }
}

/// Values spread from 0 to `count`.
fn spread(values: Vec<f64>, count: usize) -> Field {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::MAX, f64::min), finite().fold(f64::MIN, f64::max));
    let scale = if high > low { count as f64 / (high - low) } else { 0.0 };
    // The greatest value belongs to the last period, not to the next.
    let place = |value: &f64| ((value - low) * scale).min(count as f64 * (1.0 - 1e-6)) as f32;
    Field { name: "pattern".into(), values: FieldValues::PerVertex(values.iter().map(place).collect()), period: None }
}

/// Parts of the way around, as `count` periods.
fn around(parts: impl Iterator<Item = f64>, count: usize) -> Field {
    let values = parts.map(|part| ((part - part.floor()) * count as f64) as f32).collect();
    Field { name: "pattern".into(), values: FieldValues::PerVertex(values), period: Some(count as f32) }
}
