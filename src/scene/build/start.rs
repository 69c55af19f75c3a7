//! `[start]` as the frames to start from.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::evolve::Start;
use crate::immersion::{mirrored, moved};
use crate::mesh::shapes::{FigureEight, Grid, Halfway, Shape};
use crate::mesh::{Surface, read_positions};
use crate::scene::{MeshSection, Scene, SceneError, StartFrom};
use crate::timeline::Parameters;

impl Scene {
    /// Where frames start, at the time of the first frame.
    pub(super) fn start_of(
        &self,
        surface: &Surface,
        parameters: &Arc<Parameters>,
        time: f64,
    ) -> Result<Start, SceneError> {
        let (section, mesh) = (&self.start, &surface.mesh);
        // Coordinates are no shape by themselves.
        let given = if section.formula.is_some() { surface.places() } else { surface.positions.as_deref() };
        let of_mesh = || match given {
            Some(positions) => Ok(positions.to_vec()),
            None => Err(self.complain(
                "start.from",
                "the frames are to start from positions, but the mesh has none",
                "write `random = 0`, name a `file`, or use a mesh that has them",
            )),
        };
        let mut positions: Vec<DVec3> = match &section.from {
            StartFrom::Random(seed) => return Ok(Start::Random(*seed)),
            StartFrom::Spectral => return Ok(Start::Spectral),
            StartFrom::Mesh => of_mesh()?,
            StartFrom::Mirror => mirrored(&of_mesh()?),
            StartFrom::Halfway(lobes) => Halfway { lobes: *lobes, time: 0.0 }.of_sphere(&of_mesh()?),
            StartFrom::FigureEight => self.figure_eight()?.at(0.0),
            StartFrom::File(path) => {
                read_positions(&self.resolve(path), mesh).map_err(|error| self.complain_about("start.file", &error))?
            }
        };
        if let Some(texts) = &section.formula {
            let formula = self.point_formula("start.formula", texts, parameters)?;
            positions = moved(mesh, &positions, &formula, time)
                .map_err(|error| self.complain_about("start.formula", &error))?;
        }
        if let Some(noise) = &section.noise {
            positions = noise.displaced(mesh, &positions);
        }
        Ok(Start::Shape { positions, is_mirrored: section.from == StartFrom::Mirror })
    }

    /// The torus of the scene as a ring whose cross-section is a figure eight.
    pub(super) fn figure_eight(&self) -> Result<FigureEight, SceneError> {
        let fault = |reason| {
            let remedy = "write shape = \"torus\", or shape = \"flat_torus\" with sides that are perpendicular and without `grid`";
            self.complain("start.from", reason, remedy)
        };
        match self.mesh {
            MeshSection::Shape(Shape::Torus { major_radius, minor_radius, columns, rows }) => {
                Ok(FigureEight { columns, rows, ring_radius: major_radius, tube_radius: minor_radius, slides: true })
            }
            MeshSection::Shape(Shape::FlatTorus { a, b, columns, rows, grid: Grid::Equilateral }) => {
                let (a, b) = (DVec2::from(a), DVec2::from(b));
                if a.dot(b).abs() > PERPENDICULAR * a.length() * b.length() {
                    return Err(fault(
                        "the ring of a figure eight takes a rectangle, and the sides of this torus are not perpendicular",
                    ));
                }
                let [ring_radius, tube_radius] = [a, b].map(|side| side.length() / TAU);
                Ok(FigureEight { columns, rows, ring_radius, tube_radius, slides: false })
            }
            _ => Err(fault("the ring of a figure eight is made of the rows of a torus, and this mesh has none")),
        }
    }

    /// Whether the scene asks for no folds: neither by a start that was made for them, nor by target bending angles, nor
    /// by phases of its own.
    pub(super) fn is_smooth(&self) -> bool {
        matches!(self.start.from, StartFrom::Mesh | StartFrom::Random(_) | StartFrom::Spectral)
            && self.start.formula.is_none()
            && self.start.noise.is_none()
            && self.bending.is_none()
            && self.phases.is_empty()
    }
}

/// The largest cosine of sides that count as perpendicular.
const PERPENDICULAR: f64 = 1e-9;
