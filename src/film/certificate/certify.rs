//! Reads all frames and decides what happens between them.

use std::path::Path;

use glam::DVec3;
use rayon::prelude::*;

use super::record::{
    CERTIFICATE, CERTIFIER, Certificate, CertifiedEvent, CertifiedFrame, CertifiedPoints, CertifiedQuadruple,
    CertifiedRim, EventKind,
};
use super::surfaces::{Frame, Surfaces};
use crate::digest::Key;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::pictures::{Arrivals, Event, Watch};
use crate::homotopy::{Change, Element, FilmEvent, Homotopy, MultiplePoints, QuadruplePoint, rims_through_time};
use crate::immersion::pinch_points;
use crate::mesh::{EdgeId, FaceId, Mesh};
use crate::whole_file;

/// Frames that are read side by side.
const AT_A_TIME: usize = 8;

/// Decides what happens between the frames of a film, or between the OBJ files of a folder in the order of their names, whose faces must be
/// the same. With `points` also where sheets pass through each other, which takes longer.
///
/// # Errors
/// [`FilmError::Disk`] if a frame is not there, [`FilmError::NothingToCertify`] if there are no surfaces, [`FilmError::Mesh`] if they are not of
/// one mesh, [`FilmError::Stopped`].
pub fn certify(folder: &Path, points: bool, arrivals: &Arrivals, watch: &mut Watch) -> Result<Certificate, FilmError> {
    let (surfaces, notes) = Surfaces::of(folder)?;
    notes.into_iter().for_each(|note| watch(Event::Note(note)));
    decide(folder, &surfaces, points, arrivals, watch)
}

/// The certificate of a film: the one that is kept beside it, if that is of its frames as they are, or else a new one.
///
/// # Errors
/// Those of [`certify`].
pub fn certificate_of(film: &FilmFolder, arrivals: &Arrivals, watch: &mut Watch) -> Result<Certificate, FilmError> {
    match kept_certificate(film) {
        Some(certificate) => Ok(certificate),
        None => decide(film.folder(), &Surfaces::of_film(film.clone())?, false, arrivals, watch),
    }
}

/// Writes a certificate into the folder of its film, unless it is there.
///
/// # Errors
/// [`FilmError::Render`] if it cannot be written.
pub fn write_certificate(folder: &Path, certificate: &Certificate) -> Result<(), FilmError> {
    let path = folder.join(CERTIFICATE);
    let mut text = serde_json::to_vec_pretty(certificate).map_err(|error| FilmError::write(&path, error))?;
    text.push(b'\n');
    whole_file::write_unless_same(&path, &text).map_err(|error| FilmError::write(&path, error))
}

/// The certificate that is kept beside a film, if it is of its frames as they are.
pub fn kept_certificate(film: &FilmFolder) -> Option<Certificate> {
    let bytes = whole_file::read(&film.folder().join(CERTIFICATE), 1 << 32).ok()?;
    let certificate: Certificate = serde_json::from_slice(&bytes).ok()?;
    let is_of = |frame: &CertifiedFrame| film.state(frame.frame).is_ok_and(|state| state == Some(frame.file_sha256));
    let numbers = certificate.frames.iter().map(|frame| frame.frame);
    let is_whole = certificate.certifier == CERTIFIER && numbers.eq(1..=film.manifest().frame_count);
    (is_whole && certificate.frames.iter().all(is_of)).then_some(certificate)
}

/// Whether a certificate is kept beside a film that is not of its frames as they are.
pub(in crate::film) fn is_stale(film: &FilmFolder) -> bool {
    kept_certificate(film).is_none()
}

fn decide(
    folder: &Path,
    surfaces: &Surfaces,
    points: bool,
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Certificate, FilmError> {
    let (mesh, count) = (surfaces.mesh(), surfaces.count());
    let mut film = Homotopy::new(mesh);
    let mut sheets = points.then(|| MultiplePoints::new(mesh));
    let (mut frames, mut rims, mut pinched) = (Vec::with_capacity(count), Vec::new(), 0);
    watch(Event::Begin("certificate", count));
    let numbers: Vec<usize> = (1..=count).collect();
    for some in numbers.chunks(AT_A_TIME) {
        let read: Vec<Result<Frame, FilmError>> = some.par_iter().map(|number| surfaces.frame(*number)).collect();
        for (&frame, read) in some.iter().zip(read) {
            if arrivals.is_stopped() {
                return Err(FilmError::Stopped);
            }
            let Frame { time, file, file_sha256, positions, rims: of_frame } = read?;
            let positions_sha256 = key_of_positions(&positions);
            if frame == 1 {
                pinched = pinch_points(mesh, &positions).len();
                rims = of_frame;
            }
            let appended = film.append(positions);
            appended.map_err(|source| FilmError::Positions { path: folder.join(&file), source })?;
            if let Some(sheets) = &mut sheets {
                sheets.append(film.last_positions());
            }
            frames.push(CertifiedFrame { frame, time, file, file_sha256, positions_sha256 });
            watch(Event::Done(frame));
        }
    }
    let certificate = record(surfaces, frames, &rims, pinched, film.events());
    let multiple_points = sheets.map(|sheets| of_sheets(surfaces, &sheets));
    Ok(Certificate { multiple_points, ..certificate })
}

fn record(
    surfaces: &Surfaces,
    frames: Vec<CertifiedFrame>,
    first_rims: &[EdgeId],
    pinch_points: usize,
    events: &[FilmEvent],
) -> Certificate {
    let mesh = surfaces.mesh();
    let rims = rims_through_time(mesh, first_rims, events);
    let certified = |(event, change): (&FilmEvent, &Change)| of_event(surfaces, event, *change);
    let kept = rims.runs.into_iter();
    let [program, version] = [env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")];
    Certificate {
        certifier: CERTIFIER,
        program: format!("{program} {version}"),
        is_regular_homotopy: pinch_points == 0 && events.is_empty(),
        pinch_points,
        vertices: mesh.vertex_count(),
        faces: mesh.face_count(),
        hinges: mesh.interior_edges().count(),
        triangles_sha256: key_of_triangles(mesh),
        frames,
        counts: rims.counts,
        events: events.iter().zip(&rims.changes).map(certified).collect(),
        rims: kept
            .map(|run| CertifiedRim { events: run.events, counts: run.counts, edges_left: run.edges_left })
            .collect(),
        multiple_points: None,
    }
}

fn of_event(surfaces: &Surfaces, &FilmEvent { interval, event }: &FilmEvent, change: Change) -> CertifiedEvent {
    let vertices = event.element.vertices(surfaces.mesh());
    CertifiedEvent {
        frames: [interval + 1, interval + 2],
        time: event.time,
        kind: match event.element {
            Element::Hinge(_) => EventKind::Fold,
            Element::Face(_) => EventKind::Face,
        },
        change,
        lasts: event.lasts,
        vertices: vertices.into_iter().map(|v| surfaces.file_vertex(v)).collect(),
        place: event.place.to_array(),
    }
}

fn of_sheets(surfaces: &Surfaces, sheets: &MultiplePoints) -> CertifiedPoints {
    let corners = |face: FaceId| surfaces.mesh().corners(face).map(|v| surfaces.file_vertex(v));
    let quadruple = |&QuadruplePoint { interval, time, faces, place }: &QuadruplePoint| CertifiedQuadruple {
        frames: [interval + 1, interval + 2],
        time,
        faces: faces.map(corners),
        place: place.to_array(),
    };
    CertifiedPoints {
        frames: sheets.frames().to_vec(),
        quadruple_points: sheets.quadruple_points().iter().map(quadruple).collect(),
    }
}

fn key_of_positions(positions: &[DVec3]) -> Key {
    let numbers = positions.iter().flat_map(|place| place.to_array());
    Key::of_bytes(&numbers.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
}

fn key_of_triangles(mesh: &Mesh) -> Key {
    let corners = mesh.triangles().into_iter().flatten();
    Key::of_bytes(&corners.flat_map(u32::to_le_bytes).collect::<Vec<u8>>())
}
