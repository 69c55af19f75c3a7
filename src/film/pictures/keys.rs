//! What a picture is made of, as a key. Pictures with the same key are the same, to the last bit.

use super::shots::Shots;
use crate::{
    digest::{Digest, Key},
    evolve::FrameReport,
    film::disk::{DiskError, FilmFolder},
};

/// Counts the ways in which pictures have been made. Whoever changes how they look raises it, so that no film mixes pictures
/// of two ways; a test compares small pictures with what they were.
pub const RENDERER: u32 = 2;

/// What is on disk of the frames that a picture shows.
#[derive(Clone, Debug)]
pub(super) struct Contents {
    /// Checksum of the state of the frame, and its report.
    pub here: (Key, FrameReport),
    /// Checksum of the state of the frame before it, where pictures look back.
    pub before: Option<Key>,
    /// Checksum of the state of the frame after it, where pictures look ahead.
    pub next: Option<Key>,
}

impl Shots<'_> {
    /// Of all that pictures of different frames have in common.
    ///
    /// # Errors
    /// [`DiskError`] if fields are shown and the first frame, which they are measured against, is not there.
    pub fn key_of_film(&self, film: &FilmFolder) -> Result<Key, DiskError> {
        let plan = self.plan();
        // With the ranges of what is shown, and with the words of the scene for what is found frame by frame.
        let digest = Digest::of("pictures")
            .count(RENDERER as usize)
            .key(film.manifest().mesh_sha256)
            .shown(&plan.scene.look)
            .shown(&plan.scene.camera)
            .shown(&plan.lights);
        let digest = self.add_to(digest);
        let formulas = plan.hide.is_some() || plan.scene.look.pattern.is_some();
        let digest = if formulas { digest.shown(&plan.scene.parameters) } else { digest };
        let digest = self.subject().add_to(digest);
        let digest = if self.subject().has_fields() { digest.key(film.contents(1)?.0) } else { digest };
        Ok(digest.finish())
    }

    /// Of the picture of a frame of that film, without layers.
    pub fn key(&self, film: Key, Contents { here: (state, report), before, next }: &Contents) -> Key {
        let mut digest = Digest::of("picture").key(film).key(*state).shown(&self.metadata(report));
        if self.plan().scene.camera.shutter > 0.0 {
            digest = digest.shown(next).shown(&self.cameras(report.frame));
        }
        if self.plan().looks_around() {
            digest = digest.shown(before).shown(next);
        }
        digest.finish()
    }

    /// With layers, which say where everything goes until the next frame.
    pub fn key_of_layers(&self, picture: Key, Contents { here: (_, report), next, .. }: &Contents) -> Key {
        let digest = Digest::of("layers").key(picture).shown(next).shown(&self.cameras(report.frame));
        digest.shown(&self.plan().scene.output.fields).finish()
    }
}
