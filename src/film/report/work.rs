//! Makes the page of a film.

use std::io;
use std::path::Path;

use glam::DVec3;
use serde_json::{Value as Json, json};

use super::facts::{curves, generators, histogram, origin, unconverged};
use super::findings::Findings;
use super::measure::{Measured, Small, Subject};
use super::pack::{CURVE_STEPS, Grid, Packed, Shown, pack};
use super::page::{page, parts};
use super::records::Records;
use super::{facts, look};
use crate::digest::{Digest, Key};
use crate::evolve::Frame;
use crate::film::certificate::kept_certificate;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::kept_scene::scene_to_show;
use crate::film::ledger::Ledger;
use crate::film::pictures::{Arrivals, Event, Plan, RENDERER, Views, Watch, at_a_time, in_order};
use crate::immersion::FieldName;
use crate::render::{FieldSpread, Output};
use crate::whole_file;

/// The page of a film, in its folder.
pub const REPORT: &str = "report.html";

/// Counts the ways in which pages have been made, beside their markup, style and scripts.
pub const REPORTER: u32 = 1;

/// Whether a page was made or was there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reported {
    /// It was made now.
    Made,
    /// It was there, whole, and of the same film.
    Kept,
}

/// Writes `report.html` into the folder of a film, of the frames that are there up to the first one that is not. A page that is
/// there, whole, and made of the same is kept.
///
/// # Errors
/// [`FilmError::NoSuchFrame`] if the first frame is not there; no page is left unfinished.
pub fn report(
    folder: &Path,
    findings: &Findings,
    restart: bool,
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Reported, FilmError> {
    let film = FilmFolder::open(folder)?;
    let ledger = Ledger::of_page(folder)?;
    let shows = film.all_contents()?;
    let events = kept_certificate(&film).map(|certificate| certificate.events_before_frames());
    let events = events.as_deref();
    let key = key_of(&film, shows, findings, events)?;
    if !restart && ledger.is_fresh(REPORT, key) {
        return Ok(Reported::Kept);
    }
    let text = made(&film, shows, findings, events, arrivals, watch)?;
    let path = folder.join(REPORT);
    whole_file::write(&path, text.as_bytes()).map_err(|error| FilmError::write(&path, error))?;
    ledger.enter(REPORT, key, shows)?;
    ledger.close()?;
    Ok(Reported::Made)
}

/// Of all that a page is made of.
fn key_of(film: &FilmFolder, shows: Key, findings: &Findings, events: Option<&[usize]>) -> Result<Key, FilmError> {
    let digest = Digest::of("report")
        .count(REPORTER as usize)
        .count(RENDERER as usize)
        .text(env!("CARGO_PKG_VERSION"))
        .shown(film.manifest())
        .key(shows)
        .text(&film.scene_text()?.unwrap_or_default())
        .shown(findings)
        .shown(&events);
    Ok(parts().fold(digest, Digest::text).finish())
}

/// The frames of a film, measured.
struct Survey {
    records: Records,
    small: Vec<Small>,
    spreads: Vec<FieldSpread>,
    lengths: Vec<usize>,
    low: DVec3,
    high: DVec3,
}

impl Survey {
    fn push(&mut self, Measured { record, small }: Measured) -> io::Result<()> {
        for (spread, values) in self.spreads.iter_mut().zip(&record.fields) {
            spread.add(values);
        }
        self.lengths = record.fields.iter().map(Vec::len).collect();
        for point in record.positions.iter().chain(record.crossings.iter().flatten()) {
            (self.low, self.high) = (self.low.min(*point), self.high.max(*point));
        }
        self.records.push(&record)?;
        self.small.push(small);
        Ok(())
    }
}

/// The middle of two shares of the sky, on both sides.
fn between(before: &[Vec<u8>; 2], after: &[Vec<u8>; 2]) -> [Vec<u8>; 2] {
    [0, 1].map(|side| before[side].iter().zip(&after[side]).map(|(a, b)| a.midpoint(*b)).collect())
}

fn made(
    film: &FilmFolder,
    shows: Key,
    findings: &Findings,
    events: Option<&[usize]>,
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<String, FilmError> {
    let count = film.manifest().frame_count;
    let mut frames = Vec::new();
    while frames.len() < count && film.state(frames.len() + 1)?.is_some() {
        frames.push(frames.len() + 1);
    }
    if frames.is_empty() {
        return Err(FilmError::NoSuchFrame { folder: film.folder().to_owned(), frame: 1 });
    }
    let scene = scene_to_show(film, watch)?;
    let plan = Plan::of(&scene)?;
    let views = Views::of(&plan, film.folder(), &frames, arrivals, watch)?;
    let subject = Subject::of(film)?;
    let mut survey = measured(film, &subject, &views, &frames, arrivals, watch)?;
    let grid = Grid::around(survey.low, survey.high);
    let wanted = shown_fields(&views, &survey.spreads);
    let diagonal = (survey.high - survey.low).length();
    let Survey { records, small, spreads, lengths, .. } = &mut survey;
    let packed = pack(&subject, records, small, lengths, &grid, &wanted);
    let packed = packed.map_err(|error| FilmError::write(film.folder(), error))?;
    let text = film.scene_text()?.unwrap_or_default();
    let facts = json!({
        "origin": origin(film, shows, REPORTER),
        "findings": findings,
        "frames": packed.frames.iter().map(|&place| frames[place]).collect::<Vec<_>>(),
        "measured": frames.len(),
        "rate": scene.output.frame_rate,
        "loop": scene.clock.looping,
        "size": scene.output.size,
        "grid": { "origin": grid.origin.to_array(), "step": grid.step, "curveSteps": CURVE_STEPS },
        "diagonal": facts::six_digits(diagonal),
        "camera": look::camera(&views, &packed.frames),
        "lights": look::lights(&views),
        "look": look::look(&views.look),
        "field": views.field.map(FieldName::name),
        "fields": fields(&packed, spreads),
        "left": wanted.iter().filter(|shown| !packed.fields.iter().any(|kept| kept.name == shown.name))
            .map(|shown| shown.name.name()).collect::<Vec<_>>(),
        "maps": packed.fields.iter().map(|shown| look::map(shown.map)).map(|(name, map)| (name.to_owned(), map))
            .collect::<serde_json::Map<_, _>>(),
        "curves": curves(small, events),
        "histogram": histogram(),
        "generators": generators(&subject, small),
        "unconverged": unconverged(small),
        "text": text,
    });
    Ok(page(&film.manifest().scene, &facts, &packed.streams))
}

/// Measures frames, some at a time.
fn measured(
    film: &FilmFolder,
    subject: &Subject,
    views: &Views,
    frames: &[usize],
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Survey, FilmError> {
    let failed = |error| FilmError::write(film.folder(), error);
    let output = Output::new(64, 64, 1)?; // of which nothing is drawn
    let mut survey = Survey {
        records: Records::new(film.folder()).map_err(failed)?,
        small: Vec::new(),
        spreads: vec![FieldSpread::default(); FieldName::ALL.len()],
        lengths: Vec::new(),
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };
    watch(Event::Begin("report", frames.len()));
    // Rays cost more than all else, and shade changes little from frame to frame.
    let has_sky = |k: usize| k.is_multiple_of(2) || k + 1 == frames.len();
    let (mut waiting, mut sky): (Option<Measured>, [Vec<u8>; 2]) = (None, Default::default());
    let (vertices, faces) = (subject.mesh.vertex_count(), subject.triangles.len());
    in_order(
        frames.len(),
        at_a_time(1000 * vertices + 1000 * faces),
        |wave| wave.map(|k| Ok((k, film.read_frame(frames[k])?))).collect::<Result<Vec<_>, FilmError>>(),
        |wave: &Vec<(usize, Frame)>, k| {
            if arrivals.is_stopped() {
                return Err(FilmError::Stopped);
            }
            subject.measure(&wave[k - wave[0].0].1, views, &output, has_sky(k))
        },
        |measured| {
            // One without a sky has what is between those before and after it, and waits for that.
            let mut ready = Vec::new();
            match waiting.take() {
                Some(Measured { mut record, small }) => {
                    record.sky = between(&sky, &measured.record.sky);
                    ready.extend([Measured { record, small }, measured]);
                }
                None if measured.record.sky[0].is_empty() => waiting = Some(measured),
                None => ready.push(measured),
            }
            for measured in ready {
                sky.clone_from(&measured.record.sky);
                survey.push(measured).map_err(failed)?;
            }
            watch(Event::Done(survey.small.len()));
            Ok(())
        },
    )?;
    Ok(survey)
}

/// Fields in the order in which they get room: that of the pictures first, and none that is 0 all over the film.
fn shown_fields(views: &Views, spreads: &[FieldSpread]) -> Vec<Shown> {
    use FieldName::{
        BendingAngle, ConformalFactor, EnergyDensity, GaussianCurvature, Generators, LengthError, MeanCurvature,
    };
    let mut order =
        vec![LengthError, Generators, GaussianCurvature, MeanCurvature, ConformalFactor, BendingAngle, EnergyDensity];
    order.sort_by_key(|&name| views.field != Some(name));
    let shown = |name: FieldName| {
        let place = FieldName::ALL.iter().position(|(_, field)| *field == name)?;
        let is_zero = spreads[place].extremes().is_none_or(|extremes| extremes == [0.0; 2]);
        let (map, range) = look::colors_of(name, &views.look, views.field, &spreads[place]);
        (!is_zero || views.field == Some(name)).then_some(Shown { name, place, map, range })
    };
    order.into_iter().filter_map(shown).collect()
}

fn fields(packed: &Packed, spreads: &[FieldSpread]) -> Json {
    let field = |shown: &Shown| look::field(shown.name, (shown.map, shown.range), &spreads[shown.place]);
    packed.fields.iter().map(field).collect()
}
