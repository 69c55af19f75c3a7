//! Point constraints (Sec. 5.4.1): vertices whose positions are given, at each time.

use crate::advice::Advice;
use crate::algebra::quaternion;
use crate::mesh::{LARGEST_COORDINATE, Mesh, VertexId, is_in_reach};
use crate::timeline::{Keyframes, PointFormula};
use glam::DVec3;

/// Why pins are refused. Vertices are those of the mesh file, groups those that pins are made of, from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum PinError {
    #[error("it has {positions} positions for {vertices} vertices; {}", self.remedy())]
    Count { vertices: usize, positions: usize },
    #[error("it gives no positions and the mesh has none; {}", self.remedy())]
    NoPositions,
    #[error("vertex {vertex} is pinned to {first:?} and to {second:?} at time {time}; {}", self.remedy())]
    Contradiction { group: usize, vertex: usize, first: [f64; 3], second: [f64; 3], time: f64 },
    #[error("vertex {vertex} is led to {place:?} at time {time}; {}", self.remedy())]
    OutOfReach { group: usize, vertex: usize, place: [f64; 3], time: f64 },
}

impl PinError {
    /// The group that is at fault, where there are several.
    pub fn group(&self) -> Option<usize> {
        match *self {
            PinError::Contradiction { group, .. } | PinError::OutOfReach { group, .. } => Some(group),
            PinError::Count { .. } | PinError::NoPositions => None,
        }
    }
}

impl Advice for PinError {
    fn remedy(&self) -> String {
        match self {
            PinError::Count { .. } => "give one position per vertex, or none".into(),
            PinError::NoPositions => "add `positions`, one per vertex".into(),
            PinError::Contradiction { .. } => "keep one of the two".into(),
            PinError::OutOfReach { .. } => format!(
                "correct the formula or the keyframes there; coordinates must be finite and at most {LARGEST_COORDINATE:e}"
            ),
        }
    }
}

/// All pins of a surface.
#[derive(Clone, Debug, Default)]
pub struct Pins {
    groups: Vec<PinGroup>,
    /// The pinned vertices, each once, in order.
    vertices: Vec<VertexId>,
    /// The numbers of the pinned vertices in the mesh file.
    numbers: Vec<usize>,
}

/// Vertices that are held or led along together.
#[derive(Clone, Debug)]
pub struct PinGroup {
    /// Vertices and where they belong at rest.
    rest: Vec<(VertexId, DVec3)>,
    formula: Option<PointFormula>,
    /// Translation, and degrees about x, y, z.
    motion: Option<[Keyframes<DVec3>; 2]>,
}

impl Pins {
    /// Groups that agree on the vertices they share. Whether they do at a time is found by [`Pins::at`].
    pub fn new(mesh: &Mesh, groups: Vec<PinGroup>) -> Pins {
        let mut vertices: Vec<VertexId> = groups.iter().flat_map(|group| &group.rest).map(|(v, _)| *v).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let numbers = vertices.iter().map(|&v| mesh.file_vertex(v)).collect();
        Pins { groups, vertices, numbers }
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
    /// [`PinError::Contradiction`], [`PinError::OutOfReach`]
    pub fn at(&self, time: f64) -> Result<Vec<(VertexId, DVec3)>, PinError> {
        let mut places: Vec<(VertexId, DVec3, usize)> = Vec::new();
        for (k, group) in self.groups.iter().enumerate() {
            places.extend(group.at(time).into_iter().map(|(v, place)| (v, place, k)));
        }
        places.sort_by_key(|(v, _, k)| (*v, *k));
        let is_lost = |(_, place, _): &&(VertexId, DVec3, usize)| !is_in_reach(*place);
        if let Some(&(v, place, group)) = places.iter().find(is_lost) {
            return Err(PinError::OutOfReach { group, vertex: self.number(v), place: place.to_array(), time });
        }
        let apart = |a: DVec3, b: DVec3| a.distance(b) > SAME_PLACE * (1.0 + a.length());
        if let Some(&[(v, a, _), (_, b, group)]) =
            places.array_windows().find(|[(v, a, _), (w, b, _)]| v == w && apart(*a, *b))
        {
            let (first, second) = (a.to_array(), b.to_array());
            return Err(PinError::Contradiction { group, vertex: self.number(v), first, second, time });
        }
        places.dedup_by_key(|(v, ..)| *v);
        Ok(places.into_iter().map(|(v, place, _)| (v, place)).collect())
    }
}

/// Two pins may name the same vertex if they agree up to rounding.
const SAME_PLACE: f64 = 1e-12;

impl PinGroup {
    /// Vertices and where each belongs at rest, in the same order.
    ///
    /// # Errors
    /// [`PinError::Count`] unless there is one place per vertex.
    pub fn new(vertices: Vec<VertexId>, places: Vec<DVec3>) -> Result<PinGroup, PinError> {
        if vertices.len() != places.len() {
            return Err(PinError::Count { vertices: vertices.len(), positions: places.len() });
        }
        Ok(PinGroup { rest: vertices.into_iter().zip(places).collect(), formula: None, motion: None })
    }

    /// Led from there by a formula in x, y, z of the place and time.
    pub fn led_by(self, formula: PointFormula) -> PinGroup {
        PinGroup { formula: Some(formula), ..self }
    }

    /// Moved rigidly about their centroid after that: displacements, and degrees about x, then y, then z.
    pub fn moved_by(self, translation: Keyframes<DVec3>, rotation: Keyframes<DVec3>) -> PinGroup {
        PinGroup { motion: Some([translation, rotation]), ..self }
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
