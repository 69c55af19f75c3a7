//! How far a run is, in words.

use std::time::Duration;

use super::estimate::{Pace, in_words};
use crate::cli::results::percent;
use crate::evolve::Progress;
use crate::polish::PolishStep;

/// How far a run is.
#[derive(Debug, Default)]
pub(super) struct Standing {
    /// Of which scene, where there are several.
    pub scene: Option<String>,
    pub frames: Option<Frames>,
    pub pictures: Option<Pictures>,
    /// Pictures of frames that are made, of so many, whatever is done afterwards.
    pub rendered: Option<[usize; 2]>,
    /// What is done before there are frames.
    pub setting_up: bool,
}

/// The frames of a film.
#[derive(Debug)]
pub(super) struct Frames {
    pub of: usize,
    pub done: usize,
    /// The last step of the one that is being made.
    pub now: Option<Progress>,
    /// The last step of its polish.
    pub polish: Option<PolishStep>,
    pub pace: Pace,
}

/// Pictures, or what is done for them.
#[derive(Debug)]
pub(super) struct Pictures {
    pub stage: &'static str,
    pub of: usize,
    pub done: usize,
    pub pace: Pace,
}

impl Pictures {
    /// Whether they are the pictures of the film, and not a look over its frames, its colours or a sheet.
    pub fn are_of_frames(&self) -> bool {
        self.stage == RENDER
    }
}

/// The stage in which the pictures of frames are made.
const RENDER: &str = "render";

/// What stays when a run is interrupted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::cli) struct Kept {
    /// So many frames of so many.
    pub frames: Option<[usize; 2]>,
    /// So many pictures of so many.
    pub pictures: Option<[usize; 2]>,
}

impl Standing {
    pub fn kept(&self) -> Kept {
        Kept { frames: self.frames.as_ref().map(|frames| [frames.done, frames.of]), pictures: self.rendered }
    }

    /// So many of the pictures, or what is done for them, are done.
    pub fn count_pictures(&mut self, pictures: Pictures) {
        if pictures.are_of_frames() {
            self.rendered = Some([pictures.done, pictures.of]);
        }
        self.pictures = Some(pictures);
    }

    /// The frame that is being made, from 1.
    pub fn frame(&self) -> Option<usize> {
        self.frames.as_ref().filter(|frames| frames.done < frames.of).map(|frames| frames.done + 1)
    }

    /// How long all that is known of will take.
    pub fn left(&self) -> Option<Duration> {
        let of_frames = self.frames.as_ref().filter(|frames| frames.done < frames.of);
        let of_pictures = self.pictures.as_ref().filter(|pictures| pictures.are_of_frames());
        let of_frames = of_frames.map(|frames| frames.pace.left(frames.of - frames.done));
        let of_pictures = of_pictures.map(|pictures| pictures.pace.left(pictures.of - pictures.done));
        [of_frames, of_pictures].into_iter().flatten().max().flatten()
    }

    /// One line; nothing if nothing is under way.
    pub fn line(&self) -> Option<String> {
        let is_making_frames = self.frames.as_ref().is_some_and(|frames| frames.done < frames.of);
        let mut parts = Vec::new();
        match &self.frames {
            None if self.setting_up => parts.push("setting up".to_owned()),
            None => {}
            Some(frames) if is_making_frames => parts.push(words_for(frames)),
            Some(frames) => parts.push(format!("all {} frames done", frames.of)),
        }
        match &self.pictures {
            Some(pictures) if pictures.are_of_frames() => {
                parts.push(format!("pictures {} of {}", pictures.done, pictures.of));
            }
            // Meanwhile the frames say how far that is.
            Some(Pictures { stage: "camera", .. }) if is_making_frames => {}
            Some(Pictures { stage: "camera", of, done, .. }) => {
                parts.push(format!("looking for the camera, frame {done} of {of}"));
            }
            Some(Pictures { stage: "report", of, done, .. }) => parts.push(format!("report, frame {done} of {of}")),
            Some(Pictures { stage, of, done, .. }) => parts.push(format!("{stage}, picture {done} of {of}")),
            None => {}
        }
        if parts.is_empty() {
            return None;
        }
        parts.extend(self.left().map(in_words));
        let scene = self.scene.as_ref().map_or_else(String::new, |scene| format!("{scene}: "));
        Some(scene + &parts.join(", "))
    }
}

/// What the simulation is about, `relaxing` or `settling`.
pub(super) fn doing(step: &Progress) -> &'static str {
    if step.phase < step.phases { "relaxing" } else { "settling" }
}

fn words_for(frames: &Frames) -> String {
    let mut text = format!("frame {} of {}", frames.done + 1, frames.of);
    if let Some(step) = &frames.polish {
        return text + &format!(", polishing, error {}", percent(step.l2_length_error));
    }
    let Some(step) = &frames.now else { return text };
    text += ", ";
    text += doing(step);
    let mut where_in = Vec::new();
    if step.components > 1 {
        where_in.push(format!("component {} of {}", step.component + 1, step.components));
    }
    if step.phase < step.phases && step.phases > 1 {
        where_in.push(format!("phase {} of {}", step.phase + 1, step.phases));
    }
    if !where_in.is_empty() {
        text += &format!(" ({})", where_in.join(", "));
    }
    let rims = if step.rims == 1 { "rim" } else { "rims" };
    text + &format!(", error {}, {} {rims}", percent(step.l2_length_error), step.rims)
}
