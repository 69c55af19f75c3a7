//! Stills and moving pictures of the frames of a film.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::passes::{Arrivals, Event, Survey, Watch, metadata, survey};
use super::plan::Plan;
use super::sheet::{Sheet, evenly};
use super::sheets::{SHEET_WIDTH, contact_sheet, key_of_sheet, scaled};
use super::shoot::{Shown, keys_of, shoot};
use crate::digest::{Digest, Key};
use crate::film::animation::{Animation, Palette, Reeling, begin, file_name};
use crate::film::error::FilmError;
use crate::film::ledger::Ledger;
use crate::render::{Output, Picture};
use crate::scene::{AnimationFormat, Scene};

/// Frames from which the colours of a GIF are taken, and their longest side.
const PALETTE_FRAMES: usize = 8;
const PALETTE_SIDE: usize = 320;

/// What was done about the pictures of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pictured {
    /// Frames whose pictures were made now.
    pub made: usize,
    /// Frames all of whose pictures were there.
    pub kept: usize,
}

/// Makes the pictures that a scene asks for, of computed frames given by number in order, in the folder of its film:
/// `000001.png`, `000001.exr`, `film.gif`, `film.apng`, `film.mp4`, `sheet.png`. Those that are there, whole, and made of the
/// same frames with the same camera and look are kept.
///
/// # Errors
/// [`FilmError`]; pictures that are finished stay, and none is left unfinished.
pub fn make_pictures(scene: &Scene, folder: &Path, frames: &[usize], watch: &mut Watch) -> Result<Pictured, FilmError> {
    make_pictures_of_arrivals(scene, folder, frames, &Arrivals::over(), watch)
}

/// As [`make_pictures`], of frames that are still being computed: each is passed over, and pictures of it are made, as
/// soon as it is there and the camera and all that holds for the whole film are known.
///
/// # Errors
/// As [`make_pictures`], and [`FilmError::NoSuchFrame`] if no more frames come.
pub fn make_pictures_of_arrivals(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Pictured, FilmError> {
    make(scene, folder, frames, arrivals, Ledger::open, watch)
}

/// As [`make_pictures_of_arrivals`], beside others who make pictures of other frames in the same folder. Only stills are made,
/// and what is known of them is kept apart until the next one who is alone in the folder makes pictures.
///
/// # Errors
/// As [`make_pictures`].
pub fn make_stills_beside_others(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Pictured, FilmError> {
    let Some(&first) = frames.first() else { return Ok(Pictured::default()) };
    let mut scene = scene.clone();
    scene.output.animation.clear();
    scene.output.sheet = 0;
    make(&scene, folder, frames, arrivals, |folder| Ledger::open_part(folder, first), watch)
}

fn make(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    arrivals: &Arrivals,
    ledger: impl FnOnce(&Path) -> Result<Ledger, FilmError>,
    watch: &mut Watch,
) -> Result<Pictured, FilmError> {
    let plan = Plan::of(scene)?;
    let mut survey = survey(&plan, folder, frames, arrivals, watch)?;
    // A film that begins anew has forgotten its pictures by the time of its first frame, and not before.
    let ledger = ledger(folder)?;
    let mut pictured = Pictured { made: 0, kept: frames.len() };
    if plan.png.is_some() || plan.output.has_layers() || !scene.output.animation.is_empty() {
        pictured = film(&plan, &mut survey, folder, frames, &ledger, watch)?;
    }
    if scene.output.sheet > 0 {
        let chosen = evenly(frames, scene.output.sheet, plan.clock.is_looping());
        let sheet = Sheet::of(chosen.len(), plan.size(), SHEET_WIDTH);
        let key = key_of_sheet(&plan, &survey, &chosen, sheet, plan.png.unwrap_or_default())?;
        if ledger.fresh(SHEET, key).is_none() {
            let film = contact_sheet(&plan, &mut survey, &chosen, sheet, watch)?;
            film.write_png(&folder.join(SHEET), plan.png.unwrap_or_default(), &metadata(&plan))?;
            ledger.enter(SHEET, key, survey.reel.film().all_contents()?)?;
        }
    }
    ledger.close()?;
    Ok(pictured)
}

/// The contact sheet of a film.
pub(in crate::film) const SHEET: &str = "sheet.png";

/// Stills and moving pictures.
fn film(
    plan: &Plan,
    survey: &mut Survey,
    folder: &Path,
    frames: &[usize],
    ledger: &Ledger,
    watch: &mut Watch,
) -> Result<Pictured, FilmError> {
    let output = &plan.scene.output;
    let [_, _, width, height] = plan.output.window();
    let reeling = Reeling { width, height, frames: frames.len(), rate: output.frame_rate };
    plan.notes().into_iter().for_each(|note| watch(Event::Note(note)));
    let mut formats = output.animation.clone();
    if !formats.is_empty() && survey.reel.has(frames) {
        let keys = keys_of(plan, survey, frames, &plan.output)?;
        formats.retain(|&format| ledger.fresh(file_name(format), key_of_animation(format, reeling, &keys)).is_none());
    }
    let palette = match formats.contains(&AnimationFormat::Gif) {
        true => palette(plan, survey, frames, watch)?,
        false => Palette::default(),
    };
    let mut animations: Vec<Box<dyn Animation>> =
        formats.iter().map(|&format| begin(format, folder, reeling, &palette)).collect::<Result<_, _>>()?;
    let moving = !animations.is_empty();

    watch(Event::Begin("render", frames.len()));
    let mut done = 0;
    let made = AtomicUsize::new(0);
    let stills = Stills { plan, folder, ledger, moving };
    let finish = |picture: &Picture, shown: &Shown| {
        made.fetch_add(1, Ordering::Relaxed);
        stills.write(picture, shown)
    };
    shoot(
        plan,
        survey,
        frames,
        &plan.output,
        |shown| stills.kept(shown),
        finish,
        |frame, skipped, pixels| {
            if let Some(skipped @ 1..) = skipped {
                watch(Event::Note(format!("frame {frame}: {skipped} triangles have no area and are not drawn")));
            }
            if let Some(pixels) = pixels {
                animations.iter_mut().try_for_each(|animation| animation.push(&pixels))?;
            }
            done += 1;
            watch(Event::Done(done));
            Ok(())
        },
    )?;
    animations.into_iter().try_for_each(|animation| animation.finish())?;
    if moving {
        let (keys, shows) = (keys_of(plan, survey, frames, &plan.output)?, survey.reel.film().all_contents()?);
        let enter = |&format: &AnimationFormat| {
            ledger.enter(file_name(format), key_of_animation(format, reeling, &keys), shows)
        };
        formats.iter().try_for_each(enter)?;
    }
    let made = made.into_inner();
    Ok(Pictured { made, kept: frames.len() - made })
}

fn key_of_animation(format: AnimationFormat, reeling: Reeling, pictures: &[Key]) -> Key {
    let digest = Digest::of("animation").shown(&format).shown(&reeling);
    pictures.iter().fold(digest, |digest, &key| digest.key(key)).finish()
}

/// The stills of a film.
struct Stills<'a> {
    plan: &'a Plan<'a>,
    folder: &'a Path,
    ledger: &'a Ledger,
    /// Whether their pixels are wanted for moving pictures.
    moving: bool,
}

impl Stills<'_> {
    /// What moving pictures want of a frame (nothing, if none are made), if all its stills are there.
    fn kept(&self, shown: &Shown) -> Option<Option<Vec<u8>>> {
        let Stills { plan, ledger, moving, .. } = self;
        let [png, exr] = self.names(shown);
        let png_bytes = match plan.png {
            Some(_) => Some(ledger.fresh(&png, self.key_of_png(shown))?),
            None => None,
        };
        if plan.output.has_layers() {
            ledger.fresh(&exr, key_of_exr(shown))?;
        }
        match png_bytes {
            _ if !moving => (png_bytes.is_some() || plan.output.has_layers()).then_some(None),
            // Those of 16 bits are not dithered.
            Some(bytes) if plan.png.is_some_and(|png| !png.sixteen_bits) => {
                let image = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png).ok()?;
                Some(Some(image.into_rgb8().into_raw()))
            }
            _ => None,
        }
    }

    /// Writes the stills of a frame, and gives what moving pictures want of it.
    fn write(&self, picture: &Picture, shown: &Shown) -> Result<Option<Vec<u8>>, FilmError> {
        let Stills { plan, folder, ledger, moving } = self;
        let [png, exr] = self.names(shown);
        if let Some(style) = plan.png
            && ledger.fresh(&png, self.key_of_png(shown)).is_none()
        {
            picture.write_png(&folder.join(&png), style, &shown.metadata)?;
            ledger.enter(&png, self.key_of_png(shown), shown.state)?;
        }
        if plan.output.has_layers() && ledger.fresh(&exr, key_of_exr(shown)).is_none() {
            picture.write_exr(&folder.join(&exr), &shown.metadata)?;
            ledger.enter(&exr, key_of_exr(shown), shown.state)?;
        }
        Ok(moving.then(|| picture.srgb_bytes()))
    }

    fn names(&self, shown: &Shown) -> [String; 2] {
        ["png", "exr"].map(|ending| format!("{:06}.{ending}", shown.number))
    }

    fn key_of_png(&self, shown: &Shown) -> Key {
        Digest::of("png").shown(&self.plan.png).key(shown.key).finish()
    }
}

fn key_of_exr(shown: &Shown) -> Key {
    Digest::of("exr").key(shown.key_of_layers).finish()
}

/// The colours of a GIF, from small pictures of some frames.
fn palette(plan: &Plan, survey: &mut Survey, frames: &[usize], watch: &mut Watch) -> Result<Palette, FilmError> {
    let chosen = evenly(frames, PALETTE_FRAMES, plan.clock.is_looping());
    watch(Event::Begin("colours", chosen.len()));
    let [width, height] = scaled(plan.size(), PALETTE_SIDE);
    let output = Output::new(width, height, plan.output.samples())?;
    let background = Picture::blank(1, 1, plan.look.background[0]).srgb_bytes();
    let mut pixels = Vec::new();
    let mut done = 0;
    shoot(
        plan,
        survey,
        &chosen,
        &output,
        |_| None,
        |picture, _| Ok(picture.srgb_bytes()),
        |_, _, bytes| {
            pixels.extend(bytes);
            done += 1;
            watch(Event::Done(done));
            Ok(())
        },
    )?;
    Ok(Palette::of(&pixels, [background[0], background[1], background[2]]))
}
