//! All pictures of a film.

use std::path::Path;

use super::{
    Arrivals, MovieError, Plan,
    animation::{Animation, Reeling, begin},
    gif::Palette,
    in_order::in_order,
    quantities::Spreads,
    reel::{Reel, States},
    sheet::{Sheet, evenly},
    shots::Shots,
    subject::Subject,
};
use crate::{
    render::{Extent, LookName, Metadata, Output, Picture, Png},
    scene::{AnimationFormat, Framed, LookSection, Scene},
};

/// What happens while pictures are made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A stage of so many parts begins.
    Begin(&'static str, usize),
    /// So many parts of it are done.
    Done(usize),
    /// Worth saying.
    Note(String),
}

/// Is told what happens, in order.
pub type Watch<'a> = dyn FnMut(Event) + Send + 'a;

/// Bytes that frames in the making may take together.
const MEMORY: usize = 1 << 30;
/// Pixels across of a contact sheet, about.
const SHEET_WIDTH: usize = 1920;
/// Frames on the sheet of a film that stands in a gallery.
const POSTER_FRAMES: usize = 12;
/// Longest side of a still that stands in a gallery.
const POSTER_SIDE: usize = 1200;
/// Frames from which the colours of a GIF are taken, and their longest side.
const PALETTE_FRAMES: usize = 8;
const PALETTE_SIDE: usize = 320;

/// A film that was passed over once.
struct Survey<'a> {
    reel: Reel<'a>,
    subject: Subject,
    extent: Extent,
    spreads: Spreads,
}

/// Makes the pictures that a scene asks for, of computed frames given by number in order, in the folder of its film:
/// `000001.png`, `000001.exr`, `film.gif`, `film.apng`, `film.mp4`, `sheet.png`. Returns how many frames were made.
///
/// # Errors
/// [`MovieError`]; pictures that are finished stay, and none is left unfinished.
pub fn make_pictures(scene: &Scene, folder: &Path, frames: &[usize], watch: &mut Watch) -> Result<usize, MovieError> {
    make_pictures_of_arrivals(scene, folder, frames, &Arrivals::over(), watch)
}

/// As [`make_pictures`], of frames that are still being computed: each is passed over, and pictures of it are made, as
/// soon as it is there and the camera and all that holds for the whole film are known.
///
/// # Errors
/// As [`make_pictures`], and [`MovieError::NoSuchFrame`] if no more frames come.
pub fn make_pictures_of_arrivals(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<usize, MovieError> {
    let plan = Plan::of(scene)?;
    let mut survey = survey(&plan, folder, frames, arrivals, watch)?;
    if plan.png.is_some() || plan.output.has_layers() || !scene.output.animation.is_empty() {
        film(&plan, &mut survey, folder, frames, watch)?;
    }
    if scene.output.sheet > 0 {
        let chosen = evenly(frames, scene.output.sheet, plan.clock.is_looping());
        let sheet = Sheet::of(chosen.len(), plan.size(), SHEET_WIDTH);
        let film = contact_sheet(&plan, &mut survey, &chosen, sheet, watch)?;
        film.write_png(&folder.join("sheet.png"), plan.png.unwrap_or_default(), &metadata(&plan, &survey))?;
    }
    Ok(frames.len())
}

/// Makes one small file that shows a film as a whole: its only frame, or a contact sheet.
///
/// # Errors
/// As [`make_pictures`].
pub fn make_poster(scene: &Scene, folder: &Path, path: &Path, watch: &mut Watch) -> Result<(), MovieError> {
    let plan = Plan::of(scene)?;
    let frames: Vec<usize> = (1..=scene.clock.frames).collect();
    let arrivals = Arrivals::over();
    let mut survey = survey(&plan, folder, &frames, &arrivals, watch)?;
    let count = if scene.output.sheet > 0 { scene.output.sheet } else { POSTER_FRAMES };
    let chosen = evenly(&frames, count, plan.clock.is_looping());
    let still = scaled(plan.size(), POSTER_SIDE);
    let sheet =
        if chosen.len() == 1 { Sheet::of(1, still, 0) } else { Sheet::of(chosen.len(), plan.size(), SHEET_WIDTH) };
    let film = contact_sheet(&plan, &mut survey, &chosen, sheet, watch)?;
    let png = Png { small: true, ..Png::default() };
    Ok(film.write_png(path, png, &metadata(&plan, &survey))?)
}

/// Makes one small file that shows the last frame of a film in all the looks that have a name.
///
/// # Errors
/// As [`make_pictures`].
pub fn make_look_sheet(scene: &Scene, folder: &Path, path: &Path, watch: &mut Watch) -> Result<(), MovieError> {
    let last = [scene.clock.frames];
    let mut whole: Option<(Picture, Sheet)> = None;
    for (index, (_, preset)) in LookName::ALL.into_iter().enumerate() {
        let scene = Scene { look: LookSection { preset, ..LookSection::default() }, ..scene.clone() };
        let plan = Plan::of(&scene)?;
        let arrivals = Arrivals::over();
        let mut survey = survey(&plan, folder, &last, &arrivals, watch)?;
        let (film, sheet) = whole.get_or_insert_with(|| {
            let sheet = Sheet::of(LookName::ALL.len(), plan.size(), SHEET_WIDTH);
            let [width, height] = sheet.size();
            (Picture::blank(width, height, plan.look.background[0]), sheet)
        });
        let picture = contact_sheet(&plan, &mut survey, &last, Sheet::of(1, sheet.tile, 0), watch)?;
        film.paste(&picture, sheet.place(index));
    }
    let png = Png { small: true, ..Png::default() };
    let metadata = Metadata { scene: scene.name.clone(), ..Metadata::default() };
    whole.map_or(Ok(()), |(film, _)| Ok(film.write_png(path, png, &metadata)?))
}

/// Passes over all frames, or the first one if nothing depends on the others, and makes sure that the wanted ones are
/// there if it comes by them.
fn survey<'a>(
    plan: &Plan,
    folder: &Path,
    frames: &[usize],
    arrivals: &'a Arrivals,
    watch: &mut Watch,
) -> Result<Survey<'a>, MovieError> {
    let reel = Reel::open(folder, arrivals)?;
    let subject = Subject::of(plan, reel.cache())?;
    let depends_on_all = plan.scene.camera.framed == Framed::Film || subject.spreads_matter(plan);
    let count = if depends_on_all { reel.cache().manifest().frame_count } else { 1 };
    watch(Event::Begin("camera", count));
    let at_a_time = at_a_time(reel.frame_bytes());
    let (ready, extent, spreads) = reel.pass(plan, &subject, count, at_a_time, |frame| watch(Event::Done(frame)))?;
    match frames.iter().find(|&&frame| ready < count && frame > ready) {
        Some(&frame) => Err(MovieError::NoSuchFrame { folder: folder.to_owned(), frame }),
        None => Ok(Survey { reel, subject, extent, spreads }),
    }
}

/// Stills and moving pictures.
fn film(
    plan: &Plan,
    survey: &mut Survey,
    folder: &Path,
    frames: &[usize],
    watch: &mut Watch,
) -> Result<(), MovieError> {
    let output = &plan.scene.output;
    let [_, _, width, height] = plan.output.window();
    let scene_hash = survey.subject.scene_hash();
    let reeling = Reeling { width, height, frames: frames.len(), rate: output.frame_rate, scene_hash };
    plan.notes().into_iter().for_each(|note| watch(Event::Note(note)));
    let palette = match output.animation.contains(&AnimationFormat::Gif) {
        true => palette(plan, survey, frames, watch)?,
        false => Palette::default(),
    };
    let mut animations: Vec<Box<dyn Animation>> =
        output.animation.iter().map(|&format| begin(format, folder, reeling, &palette)).collect::<Result<_, _>>()?;
    let moving = !animations.is_empty();

    watch(Event::Begin("render", frames.len()));
    let mut done = 0;
    let finish = |picture: &Picture, frame: &Frame| -> Result<Option<Vec<u8>>, MovieError> {
        let name = folder.join(format!("{:06}", frame.number));
        if let Some(png) = plan.png {
            picture.write_png(&name.with_extension("png"), png, &frame.metadata)?;
        }
        if plan.output.has_layers() {
            picture.write_exr(&name.with_extension("exr"), &frame.metadata)?;
        }
        Ok(moving.then(|| picture.srgb_bytes()))
    };
    shoot(plan, survey, frames, &plan.output, finish, |frame, skipped, pixels| {
        if skipped > 0 {
            watch(Event::Note(format!("frame {frame}: {skipped} triangles have no area and are not drawn")));
        }
        if let Some(pixels) = pixels {
            animations.iter_mut().try_for_each(|animation| animation.push(&pixels))?;
        }
        done += 1;
        watch(Event::Done(done));
        Ok(())
    })?;
    animations.into_iter().try_for_each(|animation| animation.finish())
}

/// A frame of which a picture is made.
struct Frame {
    number: usize,
    metadata: Metadata,
}

/// Takes pictures of frames in parallel; `finish` makes of each what is kept, and `take` gets that in order, with the
/// number of the frame and how many triangles were left out.
fn shoot<T: Send>(
    plan: &Plan,
    Survey { reel, subject, extent, spreads }: &mut Survey,
    frames: &[usize],
    output: &Output,
    finish: impl Fn(&Picture, &Frame) -> Result<T, MovieError> + Sync,
    mut take: impl FnMut(usize, usize, T) -> Result<(), MovieError> + Send,
) -> Result<(), MovieError> {
    let shots = Shots::new(plan, subject, extent, spreads, *output)?;
    let after = |frame: usize| if plan.looks_ahead() { plan.after(frame) } else { None };
    let at_a_time = at_a_time(picture_bytes(plan, output) + reel.frame_bytes());
    let load = |wave: std::ops::Range<usize>| {
        let here = &frames[wave];
        let mut wanted: Vec<usize> =
            here.iter().copied().chain(here.iter().filter_map(|&frame| after(frame))).collect();
        wanted.sort_unstable();
        wanted.dedup();
        reel.load(&wanted)
    };
    let make = |states: &States, index: usize| {
        let number = frames[index];
        let state = &states[&number];
        let next = after(number).and_then(|next| states.get(&next));
        let picture = shots.take(state, next.map(AsRef::as_ref))?;
        let frame = Frame { number, metadata: shots.metadata(state) };
        Ok((number, picture.skipped_triangles(), finish(&picture, &frame)?))
    };
    in_order(frames.len(), at_a_time, load, make, |(frame, skipped, kept)| take(frame, skipped, kept))
}

/// Small pictures of some frames on one.
fn contact_sheet(
    plan: &Plan,
    survey: &mut Survey,
    frames: &[usize],
    sheet: Sheet,
    watch: &mut Watch,
) -> Result<Picture, MovieError> {
    watch(Event::Begin("sheet", frames.len()));
    let [width, height] = sheet.size();
    let mut whole = Picture::blank(width, height, plan.look.background[0]);
    let mut done = 0;
    let output = Output::new(sheet.tile[0], sheet.tile[1], plan.output.samples())?;
    shoot(
        plan,
        survey,
        frames,
        &output,
        |picture, _| Ok(picture.clone()),
        |_, _, picture| {
            whole.paste(&picture, sheet.place(done));
            done += 1;
            watch(Event::Done(done));
            Ok(())
        },
    )?;
    Ok(whole)
}

/// The colours of a GIF, from small pictures of some frames.
fn palette(plan: &Plan, survey: &mut Survey, frames: &[usize], watch: &mut Watch) -> Result<Palette, MovieError> {
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

/// What a file that shows the whole film says of itself.
fn metadata(plan: &Plan, survey: &Survey) -> Metadata {
    Metadata { scene: plan.scene.name.clone(), scene_hash: survey.subject.scene_hash(), ..Metadata::default() }
}

/// A size of the same shape with this longest side, or less if it was smaller.
fn scaled([width, height]: [usize; 2], longest: usize) -> [usize; 2] {
    let share = (longest as f64 / width.max(height) as f64).min(1.0);
    [width, height].map(|side| ((side as f64 * share).round() as usize).max(1))
}

/// How many things of so many bytes are made at a time: enough to keep all threads busy, and no more than memory has
/// room for.
fn at_a_time(bytes: usize) -> usize {
    (MEMORY / bytes.max(1)).clamp(1, 2 * rayon::current_num_threads())
}

/// Bytes that a picture in the making takes, about, with what becomes of it.
fn picture_bytes(plan: &Plan, output: &Output) -> usize {
    let beauty = 60;
    let layers = if plan.output.has_layers() { 150 + 12 * plan.scene.output.fields.len() } else { 0 };
    let shutter = if plan.scene.camera.shutter > 0.0 { 20 } else { 0 };
    output.width() * output.height() * (beauty + layers + shutter)
}
