//! Point constraints (Sec. 5.4.1): vertices whose positions are given, at each time.

use crate::algebra::quaternion;
use crate::mesh::{SelectionError, Surface, VertexId, select_vertices};
use crate::scene::{AtKey, Extrapolation, PinSection};
use crate::timeline::{Keyframes, Parameters, PointFormula, TimelineError};
use glam::DVec3;
use std::sync::Arc;

/// Why pins are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum PinError {
    #[error(transparent)]
    Selection(#[from] SelectionError),
    #[error(transparent)]
    Timeline(#[from] TimelineError),
    #[error("it has {positions} positions for {vertices} vertices; give one position per vertex, or none")]
    Count { vertices: usize, positions: usize },
    #[error("it gives no positions and the mesh has none; add `positions`, one per vertex")]
    NoPositions,
    #[error("vertex {vertex} is pinned to {first:?} and to {second:?} at time {time}; keep one of the two")]
    Contradiction { vertex: usize, first: [f64; 3], second: [f64; 3], time: f64 },
    #[error("vertex {vertex} is led to {place:?} at time {time}; correct the formula there")]
    NotFinite { vertex: usize, place: [f64; 3], time: f64 },
}

/// All pins of a scene.
#[derive(Clone, Debug)]
pub struct Pins {
    groups: Vec<Group>,
    /// The pinned vertices, each once, in order,
    vertices: Vec<VertexId>,
    /// and their numbers in the mesh file.
    numbers: Vec<usize>,
}

/// One `[[pin]]`.
#[derive(Clone, Debug)]
struct Group {
    /// Vertices and where they belong at rest.
    rest: Vec<(VertexId, DVec3)>,
    formula: Option<PointFormula>,
    /// Translation, and degrees about x, y, z.
    motion: Option<[Keyframes<DVec3>; 2]>,
}

impl Pins {
    /// Validates what the scene says of a surface.
    ///
    /// # Errors
    /// [`PinError`] with the key of the pin. Pins that contradict each other at another time than `start` are found
    /// by [`Pins::at`].
    pub fn from_scene(
        sections: &[PinSection],
        surface: &Surface,
        parameters: &Arc<Parameters>,
        start: f64,
    ) -> Result<Pins, AtKey<PinError>> {
        let mut groups = Vec::new();
        for (k, section) in sections.iter().enumerate() {
            groups.push(Group::from_scene(section, surface, parameters).map_err(AtKey::of(format!("pin[{k}]")))?);
        }
        let mut vertices: Vec<VertexId> = groups.iter().flat_map(|group| &group.rest).map(|(v, _)| *v).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let numbers = vertices.iter().map(|&v| surface.mesh.file_vertex(v)).collect();
        let pins = Pins { groups, vertices, numbers };
        pins.at(start)?;
        Ok(pins)
    }

    /// The pinned vertices, each once, in order.
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    fn number(&self, v: VertexId) -> usize {
        self.vertices.binary_search(&v).map_or(v.index(), |k| self.numbers[k])
    }

    /// Whether any moves with time.
    pub fn changes(&self) -> bool {
        self.groups
            .iter()
            .any(|group| group.motion.is_some() || group.formula.as_ref().is_some_and(PointFormula::changes))
    }

    /// Pinned vertices and where they are at a time, each vertex once, in order.
    ///
    /// # Errors
    /// [`PinError::Contradiction`], [`PinError::NotFinite`]
    pub fn at(&self, time: f64) -> Result<Vec<(VertexId, DVec3)>, AtKey<PinError>> {
        let mut places: Vec<(VertexId, DVec3, usize)> = Vec::new();
        for (k, group) in self.groups.iter().enumerate() {
            places.extend(group.at(time).into_iter().map(|(v, place)| (v, place, k)));
        }
        places.sort_by_key(|(v, _, k)| (*v, *k));
        let at = |k: usize, error| Err(AtKey { key: format!("pin[{k}]"), error });
        if let Some((v, place, k)) = places.iter().find(|(_, place, _)| !place.is_finite()) {
            return at(*k, PinError::NotFinite { vertex: self.number(*v), place: place.to_array(), time });
        }
        let apart = |a: DVec3, b: DVec3| a.distance(b) > SAME_PLACE * (1.0 + a.length());
        if let Some([(v, a, _), (_, b, k)]) =
            places.array_windows().find(|[(v, a, _), (w, b, _)]| v == w && apart(*a, *b))
        {
            let (first, second) = (a.to_array(), b.to_array());
            return at(*k, PinError::Contradiction { vertex: self.number(*v), first, second, time });
        }
        places.dedup_by_key(|(v, ..)| *v);
        Ok(places.into_iter().map(|(v, place, _)| (v, place)).collect())
    }
}

/// Two pins may name the same vertex if they agree up to rounding.
const SAME_PLACE: f64 = 1e-12;

impl Group {
    fn from_scene(section: &PinSection, surface: &Surface, parameters: &Arc<Parameters>) -> Result<Group, PinError> {
        let vertices = select_vertices(&section.vertices, &surface.mesh, surface.places())?;
        let given = section.positions.len();
        if given > 0 && given != vertices.len() {
            return Err(PinError::Count { vertices: vertices.len(), positions: given });
        }
        let place = |(k, &v): (usize, &VertexId)| match (section.positions.get(k), &surface.positions) {
            (Some(place), _) => Ok((v, DVec3::from_array(*place))),
            (None, Some(positions)) => Ok((v, positions[v.index()])),
            (None, None) => Err(PinError::NoPositions),
        };
        let rest = vertices.iter().enumerate().map(place).collect::<Result<_, _>>()?;
        let formula = match &section.formula {
            None => None,
            Some(texts) => Some(PointFormula::parse(texts, parameters)?),
        };
        let motion = match &section.motion {
            None => None,
            Some(motion) => {
                let keyframes = |values: &[[f64; 3]]| {
                    let values = values.iter().copied().map(DVec3::from_array).collect();
                    Keyframes::new(motion.times.clone(), values, motion.ease, Extrapolation::Hold)
                };
                Some([keyframes(&motion.translations)?, keyframes(&motion.rotations)?])
            }
        };
        Ok(Group { rest, formula, motion })
    }

    fn at(&self, time: f64) -> Vec<(VertexId, DVec3)> {
        let mut places = self.rest.clone();
        if let Some(formula) = &self.formula {
            let formula = formula.at(time);
            places.iter_mut().for_each(|(_, place)| *place = formula.point(*place));
        }
        if let Some([translation, rotation]) = &self.motion {
            let center = places.iter().map(|(_, place)| *place).sum::<DVec3>() / places.len() as f64;
            let (shift, angles) = (translation.at(time), rotation.at(time));
            let turn = |axis, degrees: f64| quaternion::exp(0.5 * degrees.to_radians(), axis);
            let rotation = turn(DVec3::Z, angles.z) * turn(DVec3::Y, angles.y) * turn(DVec3::X, angles.x);
            for (_, place) in &mut places {
                *place = center + shift + rotation * (*place - center);
            }
        }
        places
    }
}
