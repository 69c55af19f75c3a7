//! What a scene asks of its pictures.

use super::labels::labels;
use crate::{
    evolve::FrameReport,
    film::{animation::gif_note, error::FilmError},
    render::{Lights, Look, Output, Png, View},
    scene::{AnimationFormat, Scene, build},
    timeline::{Clock, Formula},
};

/// What a scene asks of its pictures, validated before anything is computed.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    pub(in crate::film) scene: &'a Scene,
    /// Without the cut, which depends on what the camera frames.
    pub(super) look: Look,
    pub(super) lights: Lights,
    pub(super) view: View,
    pub(super) output: Output,
    pub(super) clock: Clock,
    /// How PNG stills are written, if any.
    pub(super) png: Option<Png>,
    /// Hides faces of the mesh where it is positive.
    pub(super) hide: Option<Formula>,
}

impl<'a> Plan<'a> {
    /// Validates what can be without the surface.
    ///
    /// # Errors
    /// [`FilmError::Scene`], [`FilmError::Render`], [`FilmError::WithoutMp4`]
    pub fn of(scene: &'a Scene) -> Result<Plan<'a>, FilmError> {
        let output = build::output(scene)?;
        let view = build::view(scene)?;
        if cfg!(not(feature = "mp4")) && scene.output.animation.contains(&AnimationFormat::Mp4) {
            return Err(FilmError::WithoutMp4);
        }
        labels(scene, &FrameReport::default(), 0)?;
        Ok(Plan {
            scene,
            look: build::look(scene)?,
            lights: build::lights(scene)?,
            view,
            output,
            clock: scene.times(&scene.clock)?,
            png: scene.output.png.then_some(Png { sixteen_bits: scene.output.depth == 16, small: false }),
            hide: hide(scene)?,
        })
    }

    /// Width and height of its pictures in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.output.width(), self.output.height()]
    }

    /// Where pictures cannot be all that is asked.
    pub fn notes(&self) -> Vec<String> {
        let output = &self.scene.output;
        let frames = self.scene.clock.frames;
        let of_gif = output.animation.contains(&AnimationFormat::Gif).then(|| gif_note(output.frame_rate, frames));
        of_gif.flatten().into_iter().collect()
    }

    /// Whether a picture takes the frame after its own.
    pub(super) fn looks_ahead(&self) -> bool {
        self.scene.camera.shutter > 0.0 || self.output.has_layers() || self.looks_around()
    }

    /// Whether what a picture shows depends on the frames on both sides of its own.
    pub(super) fn looks_around(&self) -> bool {
        self.scene.look.events || self.scene.look.rim_loops > 0.0
    }

    /// The frame before this one, where a picture takes it.
    pub(super) fn before(&self, frame: usize) -> Option<usize> {
        if self.looks_around() { frame.checked_sub(1).filter(|before| *before > 0) } else { None }
    }

    /// The frame after this one, counted from 1; the first after the last one of a film that loops.
    pub(super) fn after(&self, frame: usize) -> Option<usize> {
        if frame < self.scene.clock.frames {
            Some(frame + 1)
        } else {
            (self.clock.is_looping() && self.scene.clock.frames > 1).then_some(1)
        }
    }
}

fn hide(scene: &Scene) -> Result<Option<Formula>, FilmError> {
    let Some(text) = &scene.look.hide else { return Ok(None) };
    let parameters = scene.parameters().map_err(FilmError::from)?;
    Ok(Some(scene.formula("look.hide", text, &["x", "y", "z"], &parameters)?))
}
