//! A small picture of the newest frame, for whoever looks in while a film is being made.

use std::path::Path;
use std::time::{Duration, Instant};

use super::failure::PipelineError;
use crate::film::{forget_preview, make_preview};
use crate::scene::Scene;

/// So many times as long as a picture takes there is none after it.
const REST: u32 = 10;

/// The picture of a film that is being computed.
pub(super) struct Preview<'a> {
    scene: &'a Scene,
    folder: &'a Path,
    /// When the last one was done, and how long it took.
    last: Option<(Instant, Duration)>,
}

impl Preview<'_> {
    /// Of a film, if it is wanted; what an earlier run has left goes otherwise.
    pub fn begin<'a>(wanted: bool, scene: &'a Scene, folder: &'a Path) -> Result<Option<Preview<'a>>, PipelineError> {
        if !wanted {
            forget_preview(folder)?;
        }
        Ok(wanted.then_some(Preview { scene, folder, last: None }))
    }

    /// Shows a frame, unless the last picture was just made and there will be another frame: pictures take a tenth of the time
    /// at most.
    pub fn show(&mut self, frame: usize) -> Result<(), PipelineError> {
        let rests = self.last.is_some_and(|(since, cost)| since.elapsed() < cost * REST);
        if frame < self.scene.clock.frames && rests {
            return Ok(());
        }
        let begin = Instant::now();
        make_preview(self.scene, self.folder, frame)?;
        self.last = Some((Instant::now(), begin.elapsed()));
        Ok(())
    }
}
