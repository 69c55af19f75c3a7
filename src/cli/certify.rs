//! `certify`: whether a film is a regular homotopy, or what stands against it.

use std::io::{self, Write};
use std::path::Path;

use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::process::Session;
use super::results::write_table;
use crate::film::{self, Arrivals, CERTIFICATE, Certificate, CertifiedPoints, CertifiedRim, EventKind, FilmFolder};
use crate::homotopy::{RimCounts, Sheets};
use crate::scene::Scene;

/// Rims that are listed.
const SHOWN: usize = 40;

/// What a certificate is asked for.
#[derive(Clone, Copy)]
pub(super) struct Asked {
    /// Whether it is printed.
    pub json: bool,
    /// Whether it says where sheets pass through each other.
    pub points: bool,
}

/// Certifies the film in a folder, or files of surfaces, and keeps the certificate there.
pub(super) fn certify(folder: &Path, asked: Asked, session: &Session, out: &mut impl Write) -> Result<(), Failure> {
    if !folder.is_dir() {
        // Says what a film is.
        FilmFolder::open(folder).map_err(PipelineError::from)?;
    }
    session.hold(folder)?;
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    let certificate = film::certify(folder, asked.points, &arrivals, watch).map_err(PipelineError::from)?;
    session.log.finish();
    film::write_certificate(folder, &certificate).map_err(PipelineError::from)?;
    if asked.json {
        serde_json::to_writer_pretty(&mut *out, &certificate).map_err(io::Error::from)?;
        writeln!(out)?;
    } else {
        write_verdict(&certificate, out)?;
        if let Some(points) = &certificate.multiple_points {
            write_points(points, out)?;
        }
    }
    out.flush()?;
    if certificate.is_regular_homotopy {
        return Ok(());
    }
    let folder = folder.to_string_lossy();
    session.log.error(format_args!("{}: this is no regular homotopy; {CERTIFICATE} lists why", one_line(&folder)));
    Err(Failure::NotWell)
}

/// Keeps the certificate of a film whose scene asks for it.
pub(super) fn certify_as_asked(scene: &Scene, folder: &Path, session: &Session) -> Result<(), Failure> {
    if scene.checks.film.regular_homotopy != Some(true) {
        return Ok(());
    }
    let film = FilmFolder::open(folder).map_err(PipelineError::from)?;
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    let certificate = film::certificate_of(&film, &arrivals, watch).map_err(PipelineError::from)?;
    session.log.finish();
    Ok(film::write_certificate(folder, &certificate).map_err(PipelineError::from)?)
}

fn write_verdict(certificate: &Certificate, out: &mut impl Write) -> io::Result<()> {
    let Certificate { hinges, faces, pinch_points, events, .. } = certificate;
    let intervals = certificate.frames.len().saturating_sub(1);
    writeln!(out, "{hinges} hinges and {faces} faces decided in each of {intervals} intervals between frames")?;
    if certificate.is_regular_homotopy {
        return writeln!(out, "regular homotopy: no hinge folds and no face vanishes at any time");
    }
    if *pinch_points > 0 {
        let points = if *pinch_points == 1 { "point" } else { "points" };
        writeln!(out, "the first frame has {pinch_points} pinch {points}, where it is no immersion")?;
    }
    if events.is_empty() {
        return writeln!(out, "otherwise nothing happens: no hinge folds and no face vanishes at any time");
    }
    let mut busy: Vec<usize> = events.iter().map(|event| event.frames[0]).collect();
    busy.dedup();
    let plural = |count: usize, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
    let [found, among] = [plural(events.len(), "event"), plural(busy.len(), "interval")];
    writeln!(out, "not a regular homotopy: {found} in {among}")?;
    writeln!(out, "{}", in_words(&certificate.counts))?;
    writeln!(out)?;
    write_rims(certificate, out)
}

/// How often each thing happens, in a line.
fn in_words(counts: &RimCounts) -> String {
    let RimCounts { births, moves, joins, parts, deaths, touches, vanishings } = *counts;
    let all = [
        (births, "births"),
        (moves, "moves"),
        (joins, "joins"),
        (parts, "parts"),
        (deaths, "deaths"),
        (touches, "touches"),
        (vanishings, "faces that vanish"),
    ];
    let there = all.into_iter().filter(|(count, _)| *count > 0);
    there.map(|(count, what)| format!("{what}: {count}")).collect::<Vec<_>>().join(", ")
}

/// A line for each rim.
fn write_rims(certificate: &Certificate, out: &mut impl Write) -> io::Result<()> {
    let heading = [
        "rim",
        "first at",
        "last at",
        "events",
        "births",
        "moves",
        "joins",
        "parts",
        "deaths",
        "edges left",
        "first vertices",
        "place",
    ];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    let changing = certificate.rims.iter().filter(|rim| !rim.events.is_empty());
    rows.extend(changing.clone().enumerate().take(SHOWN).map(|(k, rim)| row(certificate, k + 1, rim)));
    write_table(out, &rows, &["first vertices", "place"])?;
    match changing.count().saturating_sub(SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "and {more} more in {CERTIFICATE}"),
    }
}

fn row(certificate: &Certificate, number: usize, rim: &CertifiedRim) -> Vec<String> {
    let event = |index: Option<&usize>| index.and_then(|index| certificate.events.get(*index));
    let at =
        |index| event(index).map_or_else(String::new, |event| format!("{:.4}", event.frames[0] as f64 + event.time[0]));
    let first = event(rim.events.first());
    let vertices = first.map_or_else(String::new, |event| {
        let names: Vec<String> = event.vertices.iter().map(usize::to_string).collect();
        let what = if event.kind == EventKind::Face { "face " } else { "" };
        format!("{what}{}", names.join(" "))
    });
    let place = first.map_or_else(String::new, |event| event.place.map(|x| format!("{x:.4}")).join(" "));
    let RimCounts { births, moves, joins, parts, deaths, .. } = rim.counts;
    let counts = [rim.events.len(), births, moves, joins, parts, deaths, rim.edges_left];
    let mut row = vec![number.to_string(), at(rim.events.first()), at(rim.events.last())];
    row.extend(counts.map(|count| count.to_string()));
    row.extend([vertices, place]);
    row
}

/// Where sheets pass through each other.
fn write_points(points: &CertifiedPoints, out: &mut impl Write) -> io::Result<()> {
    let most = |count: fn(&Sheets) -> usize| {
        let most = points.frames.iter().map(count).max().unwrap_or(0);
        let frame = points.frames.iter().position(|sheets| count(sheets) == most).unwrap_or(0) + 1;
        if most == 0 { "none".to_owned() } else { format!("at most {most}, on frame {frame}") }
    };
    let found = &points.quadruple_points;
    let parity = if found.len().is_multiple_of(2) { "even" } else { "odd" };
    writeln!(out)?;
    writeln!(out, "double curves: {}", most(|sheets| sheets.double_curves))?;
    writeln!(out, "triple points: {}", most(|sheets| sheets.triple_points))?;
    writeln!(out, "quadruple points: {}, an {parity} number", found.len())?;
    if found.is_empty() {
        return Ok(());
    }
    let mut rows = vec![["at", "place"].map(str::to_owned).to_vec()];
    rows.extend(found.iter().take(SHOWN).map(|point| {
        let at = format!("{:.6}", point.frames[0] as f64 + point.time);
        vec![at, point.place.map(|x| format!("{x:.4}")).join(" ")]
    }));
    write_table(out, &rows, &["place"])?;
    match found.len().saturating_sub(SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "and {more} more in {CERTIFICATE}"),
    }
}
