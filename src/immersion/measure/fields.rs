//! Quantities of a frame that can be seen: errors, curvatures, energies.

use super::{ConformalFactor, bending_angles, gaussian_curvatures, length_errors, mean_curvatures};
use crate::advice::Advice;
use crate::algebra::CholeskyError;
use crate::frames::{Shell, ShellError, Stiffness, hinge_energies, strains};
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::metric::Metric;
use crate::spin::{Homology, SpinStructure};
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// Quantities of a frame that can be shown as colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldName {
    /// Relative error of the lengths around a face, root mean square, as a ratio: 0.01 is one per cent.
    LengthError,
    /// Gaussian curvature of the metric asked for: angle defect over area, per vertex.
    GaussianCurvature,
    /// Mean curvature of the surface, per vertex.
    MeanCurvature,
    /// Logarithm of the scale of the metric against that of the first frame, per vertex.
    ConformalFactor,
    /// Energy per area of the frame field (Eq. 21), per face.
    EnergyDensity,
    /// Angle between a face and its neighbours, root mean square, in degrees.
    BendingAngle,
    /// Strips of the generators, numbered from 1, per face.
    Generators,
}

impl FieldName {
    /// All of them by the names.
    pub const ALL: [(&'static str, FieldName); 7] = [
        ("length_error", FieldName::LengthError),
        ("gaussian_curvature", FieldName::GaussianCurvature),
        ("mean_curvature", FieldName::MeanCurvature),
        ("conformal_factor", FieldName::ConformalFactor),
        ("energy_density", FieldName::EnergyDensity),
        ("bending_angle", FieldName::BendingAngle),
        ("generators", FieldName::Generators),
    ];

    /// Whether it has a value for each face rather than each vertex.
    pub fn is_per_face(self) -> bool {
        use FieldName::{BendingAngle, EnergyDensity, Generators, LengthError};
        matches!(self, LengthError | EnergyDensity | BendingAngle | Generators)
    }

    /// Its name, as in `length_error`.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, field)| *field == self).map_or("", |(name, _)| name)
    }
}

/// Values of a quantity and where they are.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValues {
    /// One per triangle.
    PerFace(Vec<f32>),
    /// One per vertex, linear on triangles.
    PerVertex(Vec<f32>),
}

impl FieldValues {
    /// Whether there is one for each triangle rather than each vertex.
    pub fn is_per_face(&self) -> bool {
        matches!(self, FieldValues::PerFace(_))
    }

    /// The values in order, wherever they are.
    pub fn all(&self) -> &[f32] {
        match self {
            FieldValues::PerFace(values) | FieldValues::PerVertex(values) => values,
        }
    }
}

/// Why a field cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// The conformal factor.
    #[error("{}; {}", .0, self.remedy())]
    ConformalFactor(#[from] CholeskyError),
    /// The frame.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

impl Advice for FieldError {
    fn remedy(&self) -> String {
        match self {
            FieldError::ConformalFactor(_) => "show another field, or free memory".into(),
            FieldError::Shell(error) => error.remedy(),
        }
    }
}

/// The frame of a film whose fields are wanted.
#[derive(Clone, Copy, Debug)]
pub struct FieldInput<'a> {
    /// Edge lengths that are asked for.
    pub metric: &'a Metric,
    /// Vertex positions, |V|.
    pub positions: &'a [DVec3],
    /// Unit quaternions, |F|.
    pub frames: &'a [DQuat],
    /// The spin connection of the metric.
    pub spin: &'a SpinStructure,
}

/// Computes fields of the frames of a film. What they share is made when it is first asked for.
#[derive(Debug)]
pub struct Fields {
    mesh: Arc<Mesh>,
    first: Metric,
    stiffness: Stiffness,
    scale: OnceLock<Result<ConformalFactor, CholeskyError>>,
    strips: OnceLock<Vec<f32>>,
}

impl Fields {
    /// For a film whose first frame has the metric `first`, and whose energy is measured with `stiffness`: that of its
    /// last phase, as in the reports of frames.
    pub fn new(mesh: Arc<Mesh>, first: Metric, stiffness: Stiffness) -> Fields {
        Fields { mesh, first, stiffness, scale: OnceLock::new(), strips: OnceLock::new() }
    }

    /// The values of a field on a frame:
    ///
    /// - length error: a ratio (1 is a hundred per cent), per face, root mean square over its edges;
    /// - Gaussian curvature: [`gaussian_curvatures`]; mean curvature: [`mean_curvatures`]; both per vertex;
    /// - conformal factor: [`ConformalFactor`] against the first frame, per vertex;
    /// - energy density: per face, half the energy of its hinges (Eq. 39, with no target bending angles) over its area. It
    ///   integrates to the energy; faces at the boundary have a hinge less, and so have less of it;
    /// - bending angle: degrees, per face, root mean square over its interior edges;
    /// - generators: per face, the number from 1 of the strip through it, the lowest of several, or 0.
    ///
    /// # Errors
    /// [`FieldError`] if the memory does not suffice for a conformal factor, or the frame is not of the mesh.
    pub fn of(&self, name: FieldName, frame: &FieldInput) -> Result<FieldValues, FieldError> {
        let FieldInput { metric, positions, frames, spin } = *frame;
        let mesh = self.mesh.as_ref();
        Ok(match name {
            FieldName::LengthError => {
                let errors = length_errors(mesh, metric, positions);
                self.per_face(|f| self.mean_square(f, |e| Some(errors[e.index()])).sqrt())
            }
            FieldName::GaussianCurvature => per_vertex(&gaussian_curvatures(mesh, metric)),
            FieldName::MeanCurvature => per_vertex(&mean_curvatures(mesh, positions)),
            FieldName::ConformalFactor => {
                let first = || self.first.edge_lengths().to_vec();
                let scale = self.scale.get_or_init(|| ConformalFactor::new(mesh, first())).as_ref();
                per_vertex(&scale.map_err(Clone::clone)?.of(mesh, metric.edge_lengths()))
            }
            FieldName::EnergyDensity => {
                let shell = Shell::new(mesh, metric, spin, None)?;
                let energies = hinge_energies(&shell, self.stiffness, frames);
                self.per_face(|f| {
                    let hinges = shell.face_hinges()[f.index()].iter().flatten();
                    0.5 * hinges.map(|&(hinge, _)| energies[hinge as usize]).sum::<f64>() / metric.area(f)
                })
            }
            FieldName::BendingAngle => {
                let angles = bending_angles(mesh, positions);
                let inner = |e: EdgeId| (!mesh.is_boundary_edge(e)).then(|| angles[e.index()]);
                self.per_face(|f| self.mean_square(f, inner).sqrt().to_degrees())
            }
            FieldName::Generators => FieldValues::PerFace(self.strips.get_or_init(|| self.strip_numbers()).clone()),
        })
    }

    /// The energy of bending, of rotation about the normal and of torsion (Eq. 39), with no target bending angles. Together
    /// they are the energy of the frames, as lengths of unit quaternions add nothing.
    ///
    /// # Errors
    /// [`FieldError`] if the frame is not of the mesh.
    pub fn energy_terms(&self, frame: &FieldInput) -> Result<[f64; 3], FieldError> {
        let shell = Shell::new(&self.mesh, frame.metric, frame.spin, None)?;
        let mut terms = [0.0; 3];
        for (hinge, strains) in shell.hinges().iter().zip(strains(&shell, frame.frames)) {
            for k in 0..3 {
                terms[k] += 0.5 * hinge.weight * self.stiffness[k + 1] * strains[k] * strains[k];
            }
        }
        Ok(terms)
    }

    fn per_face(&self, value: impl Fn(FaceId) -> f64 + Sync) -> FieldValues {
        let faces = (0..self.mesh.face_count()).into_par_iter().with_min_len(1024);
        FieldValues::PerFace(faces.map(|f| value(FaceId::new(f)) as f32).collect())
    }

    /// Over the edges of a face that have a value; 0 if none has.
    fn mean_square(&self, f: FaceId, value: impl Fn(EdgeId) -> Option<f64>) -> f64 {
        let values = f.halfedges().into_iter().filter_map(|h| value(self.mesh.edge(h)));
        let (sum, count) = values.fold((0.0, 0), |(sum, count), x| (sum + x * x, count + 1));
        if count > 0 { sum / f64::from(count) } else { 0.0 }
    }

    fn strip_numbers(&self) -> Vec<f32> {
        let mut numbers = vec![0.0; self.mesh.face_count()];
        let homology = Homology::new(&self.mesh, &self.first);
        for (k, generator) in homology.generators().iter().enumerate().rev() {
            generator.strip.exits().iter().for_each(|h| numbers[h.face().index()] = (k + 1) as f32);
        }
        numbers
    }
}

fn per_vertex(values: &[f64]) -> FieldValues {
    FieldValues::PerVertex(values.iter().map(|&value| value as f32).collect())
}
