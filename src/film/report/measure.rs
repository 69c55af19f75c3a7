//! All that a page shows of a frame.

use std::sync::Arc;

use super::records::Record;
use crate::evolve::{Frame, FrameReport};
use crate::film::disk::{FilmFolder, FilmMesh};
use crate::film::error::FilmError;
use crate::film::metric_of_frame::metric_of_frame;
use crate::film::pictures::Views;
use crate::immersion::{FieldInput, FieldName, Fields, bending_angles, length_errors, pinch_points};
use crate::mesh::{EdgeId, Mesh};
use crate::metric::Metric;
use crate::render::{Output, Scenery, self_intersections, sky_all_around};

/// What is the same in all frames.
pub(super) struct Subject {
    pub mesh: Arc<Mesh>,
    pub triangles: Vec<[u32; 3]>,
    /// Vertices that are held.
    pub pins: Vec<u32>,
    /// The lengths that are asked for in the first frame.
    pub first: Metric,
    fields: Fields,
}

/// A frame, measured.
pub(super) struct Measured {
    pub record: Record,
    pub small: Small,
}

/// What is small enough to stay in memory.
pub(super) struct Small {
    pub report: FrameReport,
    /// Mean of the absolute values of the length errors.
    pub mean_error: f64,
    /// Numbers of edges by the size of their length errors; see [`BINS`].
    pub histogram: [u32; BINS],
    /// Of bending, rotation about the normal and torsion.
    pub energy: [f64; 3],
    /// Root mean square of the angles between neighbouring faces in degrees, weighted by length.
    pub bend: f64,
    pub rims: Vec<[u32; 2]>,
    pub pinch_points: Vec<u32>,
}

/// Bins of length errors: six a decade from 10⁻⁶ to 1; the first and the last one hold what is beyond.
pub(super) const BINS: usize = 36;
pub(super) const BINS_A_DECADE: f64 = 6.0;
pub(super) const LEAST_BIN: f64 = -6.0;

/// Steps of shares of the sky from 0 to 1.
const SKY_STEPS: f32 = 63.0;

/// Sine of the angle between sheets below which they cross in nothing but noise.
const FAINTEST_CROSSING: f64 = 0.0625;

impl Subject {
    pub fn of(film: &FilmFolder) -> Result<Subject, FilmError> {
        let FilmMesh { mesh, pins, .. } = film.mesh()?;
        let first = film.read_frame(1)?;
        let metric = metric_of_frame(&mesh, &first)?;
        Ok(Subject {
            triangles: mesh.triangles(),
            pins: pins.into_iter().map(|v| v.0).collect(),
            fields: Fields::new(mesh.clone(), metric.clone(), first.report.stiffness),
            first: metric,
            mesh,
        })
    }

    /// Measures a frame, which is seen in such a way; the sky only if that is wanted. Fields are in the order of
    /// [`FieldName::ALL`].
    pub fn measure(
        &self,
        frame: &Frame,
        views: &Views,
        output: &Output,
        wants_sky: bool,
    ) -> Result<Measured, FilmError> {
        let Subject { mesh, triangles, fields, .. } = self;
        let Frame { positions, face_frames: frames, spin, .. } = frame;
        let metric = metric_of_frame(mesh, frame)?;
        let input = FieldInput { metric: &metric, positions, frames, spin };
        let values =
            |&(_, name): &(&str, FieldName)| Ok(fields.of(name, &input).map_err(FilmError::field)?.all().to_vec());
        let errors = length_errors(mesh, &metric, positions);
        let ends = |e: EdgeId| mesh.edge_vertices(e).map(|v| v.0);
        let mut sky = [Vec::new(), Vec::new()];
        if let Some(camera) = views.cameras.first().filter(|_| wants_sky) {
            let scenery = Scenery { triangles, positions, ..Scenery::default() };
            let shares = sky_all_around(&scenery, camera, &views.look, output)?;
            sky = shares.map(|side| side.iter().map(|share| (SKY_STEPS * share).round() as u8).collect());
        }
        let crossings = self_intersections(triangles, positions);
        Ok(Measured {
            record: Record {
                positions: positions.clone(),
                sky,
                fields: FieldName::ALL.iter().map(values).collect::<Result<_, FilmError>>()?,
                crossings: crossings.into_iter().filter(|c| c.sine > FAINTEST_CROSSING).map(|c| c.ends).collect(),
            },
            small: Small {
                report: frame.report.clone(),
                mean_error: errors.iter().map(|error| error.abs()).sum::<f64>() / errors.len().max(1) as f64,
                histogram: histogram(&errors),
                energy: fields.energy_terms(&input).map_err(FilmError::field)?,
                bend: root_mean_square_angle(mesh, &metric, &bending_angles(mesh, positions)),
                rims: frame.rims.iter().map(|&e| ends(e)).collect(),
                pinch_points: pinch_points(mesh, positions).into_iter().map(|v| v.0).collect(),
            },
        })
    }
}

fn histogram(errors: &[f64]) -> [u32; BINS] {
    let mut counts = [0; BINS];
    for error in errors {
        let bin = (libm::log10(error.abs().max(f64::MIN_POSITIVE)) - LEAST_BIN) * BINS_A_DECADE;
        counts[(bin.max(0.0) as usize).min(BINS - 1)] += 1;
    }
    counts
}

fn root_mean_square_angle(mesh: &Mesh, metric: &Metric, angles: &[f64]) -> f64 {
    let (mut squares, mut lengths) = (0.0, 0.0);
    for e in mesh.interior_edges() {
        squares += metric.length(e) * angles[e.index()] * angles[e.index()];
        lengths += metric.length(e);
    }
    if lengths > 0.0 { (squares / lengths).sqrt().to_degrees() } else { 0.0 }
}
