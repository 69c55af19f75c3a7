//! Universal Scene Description as text: one stage with the surface, the curves on it, the camera and the lights.
//!
//! Every attribute that changes has a sample for each frame, and time codes are the numbers of frames.

mod pieces;
mod stage;
mod text;

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};

pub(super) struct Usd<'a>(pub &'a Subject);

impl Layout for Usd<'_> {
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        Ok(pieces::of_frame(self.0, moment))
    }

    fn end(&self, frames: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        vec![("film.usda", stage::parts(self.0, frames))]
    }
}
