//! Exports a film.

use std::fs;
use std::path::Path;

use super::camera::{CameraPath, Pose, of_lights};
use super::colors::Colors;
use super::layout::{Layout, Mark, file_of_frame};
use super::spool::Spools;
use super::subject::Subject;
use crate::digest::{Digest, Key};
use crate::evolve::Frame;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::ledger::Ledger;
use crate::film::pictures::{Arrivals, Event, Plan, Views, Watch, at_a_time, in_order};
use crate::scene::{ExportFormat, Scene};
use crate::whole_file;

/// Counts the ways in which films have been exported, so that no folder mixes two.
pub const EXPORTER: u32 = 1;

/// What was done about an export.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exported {
    /// Files that were written.
    pub made: usize,
    /// Files that were there.
    pub kept: usize,
    /// Files of frames that the film does not have any more, which were removed.
    pub removed: Vec<String>,
}

/// Exports frames of a film, given by number in order, into a folder: a file of each, or one of all. Files that are there,
/// whole, and made of the same frames are kept, unless it is to begin anew.
///
/// # Errors
/// [`FilmError::NoSuchFrame`] if a frame is not there; files that are finished stay, and none is left unfinished.
pub fn export(
    folder: &Path,
    format: ExportFormat,
    frames: &[usize],
    to: &Path,
    restart: bool,
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Exported, FilmError> {
    let film = FilmFolder::open(folder)?;
    let scene = scene_of(&film, watch)?;
    let frames = thinned(frames, format, watch);
    let plan = Plan::of(&scene)?;
    let views = Views::of(&plan, folder, &frames, arrivals, watch)?;
    let key = key_of_all(&film, format, &plan, &views);
    let subject = subject(&film, &plan, views, &frames, format)?;
    whole_file::create_folder(to).map_err(|error| FilmError::write(to, error))?;
    let ledger = Ledger::of_exports(to)?;
    let work = Work { film: &film, subject: &subject, layout: &*format.layout(&subject), to, ledger: &ledger, restart };
    let mut exported = work.write(key, &frames, arrivals, watch)?;
    exported.removed = work.clear(&film)?;
    ledger.close()?;
    Ok(exported)
}

/// The scene of the film, as far as exports want it: camera, lights and colours.
fn scene_of(film: &FilmFolder, watch: &mut Watch) -> Result<Scene, FilmError> {
    let mut scene = match film.scene()? {
        Some(scene) => scene,
        None => {
            let reason = "no scene that can be read is kept with the film, so that camera, lights and colours are the usual ones";
            watch(Event::Note(format!("{}: {reason}; run the scene again to have its own", film.folder().display())));
            Scene { name: film.manifest().scene.clone(), ..Scene::default() }
        }
    };
    scene.clock.frames = film.manifest().frame_count;
    scene.output.crop = None;
    scene.output.animation.clear();
    // What only pictures have, and files beside the scene.
    let look = &mut scene.look;
    (look.matcap, look.hide, look.pattern, look.cut, look.explode) = (None, None, None, None, 0.0);
    look.hide_faces.clear();
    Ok(scene)
}

/// No more frames than a file of the format has.
fn thinned(frames: &[usize], format: ExportFormat, watch: &mut Watch) -> Vec<usize> {
    let Some(most) = format.most_frames().filter(|&most| frames.len() > most) else { return frames.to_vec() };
    let (count, name) = (frames.len(), format.name());
    watch(Event::Note(format!("{name} has {most} of the {count} frames, evenly spread; choose others with --frames")));
    (0..most).map(|k| frames[k * (count - 1) / (most - 1)]).collect()
}

fn subject(
    film: &FilmFolder,
    plan: &Plan,
    views: Views,
    frames: &[usize],
    format: ExportFormat,
) -> Result<Subject, FilmError> {
    let camera = CameraPath {
        poses: views.cameras.iter().map(Pose::of).collect(),
        lights: of_lights(&views.lights),
        sky: 0.5 * (views.look.sky + views.look.ground),
        up: views.up,
    };
    let colors = Colors::of_look(&views.look, views.field);
    Subject::of(film, &plan.scene.name, frames, plan.scene.output.frame_rate, camera, colors, format.wants())
}

/// Of all that an export is made of beside the frames.
fn key_of_all(film: &FilmFolder, format: ExportFormat, plan: &Plan, views: &Views) -> Key {
    Digest::of("export")
        .count(EXPORTER as usize)
        .text(env!("CARGO_PKG_VERSION"))
        .text(format.name())
        .text(&plan.scene.name)
        .shown(&plan.scene.output.frame_rate)
        .key(film.manifest().mesh_sha256)
        .key(views.key)
        .finish()
}

/// An export under way.
struct Work<'a> {
    film: &'a FilmFolder,
    subject: &'a Subject,
    layout: &'a dyn Layout,
    to: &'a Path,
    ledger: &'a Ledger,
    restart: bool,
}

/// The states of frames as keys, each with that of the first frame of the film, which fields are measured against.
type States = Vec<(usize, Key, Mark)>;

impl Work<'_> {
    fn write(&self, key: Key, frames: &[usize], arrivals: &Arrivals, watch: &mut Watch) -> Result<Exported, FilmError> {
        let missing = |frame| FilmError::NoSuchFrame { folder: self.film.folder().to_owned(), frame };
        let contents = |frame| self.film.contents(frame).map_err(|_| missing(frame));
        let first = contents(1)?.0;
        let mut states = States::new();
        for (place, &number) in frames.iter().enumerate() {
            let (state, report) = contents(number)?;
            let camera = self.subject.camera.poses.get(place).map(|pose| pose.world_from_eye);
            let of_frame = Digest::of("frame").key(key).key(first).key(state).shown(&camera).finish();
            states.push((number, of_frame, Mark { number, time: report.time }));
        }
        let of_all = states.iter().fold(Digest::of("frames").key(key), |digest, state| digest.key(state.1)).finish();
        watch(Event::Begin("export", frames.len()));
        let is_fresh = |file: &str, key| !self.restart && self.ledger.is_fresh(file, key);
        let marks: Vec<Mark> = states.iter().map(|state| state.2).collect();
        let mut exported = Exported::default();
        let mut spools = Spools::new(self.to);
        // One file of each frame: only those that are missing or stale. One of all: all frames, or nothing.
        let ending = self.layout.ending();
        let whole: Vec<&str> = self.layout.end(&marks, &[]).into_iter().map(|(name, _)| name).collect();
        let has_all = whole.iter().all(|name| is_fresh(name, of_all));
        let wanted: States = match ending {
            Some(ending) => {
                states.iter().filter(|state| !is_fresh(&file_of_frame(state.0, ending), state.1)).copied().collect()
            }
            None if has_all => Vec::new(),
            None => states,
        };
        if ending.is_some() {
            exported.kept += frames.len() - wanted.len();
        }
        let mut done = frames.len() - wanted.len();
        watch(Event::Done(done));
        in_order(
            wanted.len(),
            at_a_time(self.bytes_of_frame()),
            |wave| wave.map(|k| Ok((k, self.film.read_frame(wanted[k].0)?))).collect::<Result<Vec<_>, FilmError>>(),
            |wave: &Vec<(usize, Frame)>, k| {
                if arrivals.is_stopped() {
                    return Err(FilmError::Stopped);
                }
                let frame = &wave[k - wave[0].0].1;
                let pieces = self.layout.frame(&self.subject.moment(frame)?);
                Ok((k, pieces.map_err(|reason| FilmError::write(self.to, reason))?))
            },
            |(k, pieces)| {
                let (number, key, _) = wanted[k];
                if let Some(ending) = ending {
                    let (name, bytes) = (file_of_frame(number, ending), pieces.concat());
                    let path = self.to.join(&name);
                    whole_file::write(&path, &bytes).map_err(|error| FilmError::write(&path, error))?;
                    self.ledger.enter(&name, key, key)?;
                    exported.made += 1;
                } else {
                    spools.push(&pieces).map_err(|error| FilmError::write(self.to, error))?;
                }
                done += 1;
                watch(Event::Done(done));
                Ok(())
            },
        )?;
        if has_all {
            exported.kept += whole.len();
            return Ok(exported);
        }
        for (name, parts) in self.layout.end(&marks, spools.lengths()) {
            let path = self.to.join(name);
            spools.write(&path, &parts).map_err(|error| FilmError::write(&path, error))?;
            self.ledger.enter(name, of_all, of_all)?;
            exported.made += 1;
        }
        Ok(exported)
    }

    /// Bytes of a frame while it is written, about.
    fn bytes_of_frame(&self) -> usize {
        400 * self.subject.vertices + 800 * self.subject.triangles.len()
    }

    /// Removes files of frames that the film does not have, if they were exported from here.
    fn clear(&self, film: &FilmFolder) -> Result<Vec<String>, FilmError> {
        let Some(ending) = self.layout.ending() else { return Ok(Vec::new()) };
        let number = |name: &str| -> Option<usize> {
            name.strip_prefix("film.")?.strip_suffix(ending)?.strip_suffix('.')?.parse().ok()
        };
        let beyond = |name: &String| number(name).is_some_and(|number| number > film.manifest().frame_count);
        let old: Vec<String> = self.ledger.files().into_iter().filter(beyond).collect();
        for name in &old {
            let path = self.to.join(name);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(FilmError::write(&path, error));
                }
                _ => {}
            }
        }
        Ok(old)
    }
}
