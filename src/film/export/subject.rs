//! What is exported: the surface, and its frames one by one.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::camera::CameraPath;
use super::colors::{Colors, FieldColors};
use super::view::View;
use crate::evolve::Frame;
use crate::film::disk::{FilmFolder, FilmMesh};
use crate::film::error::FilmError;
use crate::film::metric_of_frame::metric_of_frame;
use crate::immersion::{FieldInput, FieldName, FieldValues, Fields, bending_angles};
use crate::mesh::{EdgeId, Mesh};
use crate::render::{self_intersections, smooth_normals};

/// What is the same in all frames.
pub(super) struct Subject {
    /// "immerse 0.1.0: hare"
    pub made_by: String,
    pub name: String,
    pub mesh: Arc<Mesh>,
    pub vertices: usize,
    /// Corners of each face, counterclockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// The ends of each edge.
    pub edges: Vec<[u32; 2]>,
    /// What the mesh file calls vertices and faces, from 0.
    pub file_vertices: Vec<u32>,
    pub file_faces: Vec<u32>,
    /// Faces of each connected component.
    pub components: Vec<Vec<u32>>,
    /// Vertices along each loop of the boundary.
    pub boundary: Vec<Vec<u32>>,
    pub pins: Vec<u32>,
    /// The numbers of the frames that are exported, in order.
    pub frames: Vec<usize>,
    /// Where the vertices of the first of them are, |V|.
    pub first: Vec<DVec3>,
    /// Frames a second.
    pub frame_rate: f64,
    /// Length of the diagonal of what is seen, by which widths of lines are measured.
    pub size: f64,
    pub camera: CameraPath,
    pub colors: Colors,
    fields: Fields,
    wants: Wants,
}

/// A frame, with what is wanted of it.
pub(super) struct Moment {
    pub number: usize,
    /// Its place among the frames that are exported, from 0.
    pub place: usize,
    pub time: f64,
    /// |V|
    pub positions: Vec<DVec3>,
    /// Unit normals of the front, |V|.
    pub normals: Vec<Vec3>,
    /// In the order of [`FieldName::ALL`].
    pub fields: Vec<(FieldName, FieldValues)>,
    /// Linear light of the front.
    pub colors: Option<FieldColors>,
    /// Lengths that are asked for, |E|.
    pub edge_lengths: Vec<f64>,
    /// Angles between the normals of neighbouring faces in radians, positive where the edge is convex, |E|.
    pub bending_angles: Vec<f64>,
    pub rims: Vec<[u32; 2]>,
    /// Segments in which the surface passes through itself.
    pub crossings: Vec<[DVec3; 2]>,
}

/// What a format wants to know of frames beside positions, lengths and rims.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wants {
    pub normals: bool,
    pub fields: bool,
    /// Camera, lights and colours, as pictures have them; they depend on the whole film.
    pub view: bool,
    pub crossings: bool,
    pub angles: bool,
}

impl Subject {
    /// Of a film, some of whose frames are exported.
    pub fn of(
        film: &FilmFolder,
        frames: &[usize],
        View { frame_rate, camera, colors, .. }: View,
        wants: Wants,
    ) -> Result<Subject, FilmError> {
        let name = &film.manifest().scene;
        let FilmMesh { mesh, pins, .. } = film.mesh()?;
        let first = film.read_frame(1)?;
        let fields = Fields::new(mesh.clone(), metric_of_frame(&mesh, &first)?, first.report.stiffness);
        let size = size_of(&first.positions);
        let boundary = mesh.boundary_loops();
        let first_positions = match frames.first() {
            Some(&frame) if frame != 1 => film.read_frame(frame)?.positions,
            _ => first.positions,
        };
        Ok(Subject {
            made_by: format!("immerse {}: {name}", env!("CARGO_PKG_VERSION")),
            name: name.clone(),
            vertices: mesh.vertex_count(),
            triangles: mesh.triangles(),
            edges: mesh.edges().map(|e| ends(&mesh, e)).collect(),
            file_vertices: film.file_vertices()?,
            file_faces: film.file_faces()?,
            components: mesh.components().into_iter().map(|c| c.into_iter().map(|f| f.0).collect()).collect(),
            boundary: boundary.iter().map(|cycle| cycle.iter().map(|&h| mesh.tail(h).0).collect()).collect(),
            pins: pins.into_iter().map(|v| v.0).collect(),
            frames: frames.to_vec(),
            frame_rate,
            first: first_positions,
            size,
            camera,
            colors,
            fields,
            wants,
            mesh,
        })
    }

    /// What is wanted of the frame at a place among those that are exported.
    pub fn moment(&self, place: usize, frame: &Frame) -> Result<Moment, FilmError> {
        let Subject { mesh, wants, triangles, .. } = self;
        let fields = match wants.fields {
            true => self.fields_of(frame, FieldName::ALL.iter().map(|(_, name)| *name))?,
            false => Vec::new(),
        };
        let shown = self.colors.field();
        let colors = match fields.iter().find(|(name, _)| Some(*name) == shown) {
            Some((_, values)) => Some(self.colors.of(values)),
            None => self.fields_of(frame, shown)?.first().map(|(_, values)| self.colors.of(values)),
        };
        let crossings = match wants.crossings {
            true => self_intersections(triangles, &frame.positions).into_iter().map(|c| c.ends).collect(),
            false => Vec::new(),
        };
        Ok(Moment {
            number: frame.report.frame,
            place,
            time: frame.report.time,
            positions: frame.positions.clone(),
            normals: if wants.normals { smooth_normals(triangles, &frame.positions) } else { Vec::new() },
            fields,
            colors,
            edge_lengths: frame.edge_lengths.clone(),
            bending_angles: if wants.angles { bending_angles(mesh, &frame.positions) } else { Vec::new() },
            rims: frame.rims.iter().map(|&e| ends(mesh, e)).collect(),
            crossings,
        })
    }

    /// Fields of a frame.
    fn fields_of(
        &self,
        frame: &Frame,
        names: impl IntoIterator<Item = FieldName>,
    ) -> Result<Vec<(FieldName, FieldValues)>, FilmError> {
        let mut names = names.into_iter().peekable();
        if names.peek().is_none() {
            return Ok(Vec::new());
        }
        let Frame { positions, face_frames: frames, spin, .. } = frame;
        let input = FieldInput { metric: &metric_of_frame(&self.mesh, frame)?, positions, frames, spin };
        names.map(|name| Ok((name, self.fields.of(name, &input).map_err(FilmError::field)?))).collect()
    }

    /// Whether a field has a value for each face ("uniform") or each vertex, as USD says.
    pub fn interpolation(&self, field: FieldName) -> &'static str {
        if field.is_per_face() { "uniform" } else { "vertex" }
    }

    /// The same of colours; `None` if the surface has one.
    pub fn color_interpolation(&self) -> Option<&'static str> {
        self.colors.field().map(|field| self.interpolation(field))
    }
}

fn ends(mesh: &Mesh, e: EdgeId) -> [u32; 2] {
    mesh.edge_vertices(e).map(|v| v.0)
}

/// The diagonal of the box around points.
fn size_of(points: &[DVec3]) -> f64 {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    if points.is_empty() { 1.0 } else { low.distance(high).max(f64::MIN_POSITIVE) }
}

/// What the values of a field are, for people.
pub(super) fn unit_in_words(field: FieldName) -> &'static str {
    match field {
        FieldName::LengthError => "relative length error, root mean square over the edges of a face, as a ratio",
        FieldName::GaussianCurvature => "Gaussian curvature of the metric that was asked for, 1 / length squared",
        FieldName::MeanCurvature => "mean curvature of the surface, 1 / length",
        FieldName::ConformalFactor => "logarithm of the scale of the metric against the first frame",
        FieldName::EnergyDensity => "energy of the frames over area, 1 / length squared",
        FieldName::BendingAngle => "angle to neighbouring faces, root mean square, degrees",
        FieldName::Generators => "number from 1 of the strip through the face, or 0",
    }
}
