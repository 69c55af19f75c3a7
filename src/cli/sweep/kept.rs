//! What is kept of a sweep beside its films: which runs it has, and how long each took until now.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::combinations::Run;
use crate::cli::failure::PipelineError;
use crate::film::DiskError;
use crate::whole_file;

/// Where it is in the folder of a sweep.
const KEPT: &str = ".immerse/sweep.json";

/// The runs of a sweep, for those who look at it later and for one that goes on with it.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct Kept {
    /// The name of the scene.
    pub scene: String,
    /// The command that makes it.
    pub command: String,
    /// In order.
    pub runs: Vec<KeptRun>,
}

/// One of its runs.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct KeptRun {
    #[serde(flatten)]
    pub run: Run,
    /// Of all the times that it was gone on with.
    pub seconds: f64,
}

impl Kept {
    /// What is kept in a folder, if it is the folder of a sweep.
    pub fn of(folder: &Path) -> Option<Kept> {
        let bytes = fs::read(path_in(folder)).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// Of a sweep that begins, or is gone on with: then it knows how long its runs took.
    pub fn begin(folder: &Path, scene: &str, command: String, runs: &[Run], anew: bool) -> Result<Kept, PipelineError> {
        let earlier = if anew { None } else { Kept::of(folder) }.unwrap_or_default();
        let seconds = |run: &Run| earlier.runs.iter().find(|kept| kept.run == *run).map_or(0.0, |kept| kept.seconds);
        let runs = runs.iter().map(|run| KeptRun { run: run.clone(), seconds: seconds(run) }).collect();
        let kept = Kept { scene: scene.to_owned(), command, runs };
        kept.write(folder)?;
        Ok(kept)
    }

    /// A run took so many seconds more.
    pub fn add(&mut self, folder: &Path, index: usize, seconds: f64) -> Result<(), PipelineError> {
        if let Some(run) = self.runs.get_mut(index) {
            run.seconds += seconds;
        }
        self.write(folder)
    }

    fn write(&self, folder: &Path) -> Result<(), PipelineError> {
        let path = path_in(folder);
        let inner = path.parent().unwrap_or(folder);
        whole_file::create_folder(inner).map_err(DiskError::io(inner, "written"))?;
        let text = serde_json::to_vec_pretty(self).unwrap_or_default();
        Ok(whole_file::write_unless_same(&path, &text).map_err(DiskError::io(&path, "written"))?)
    }
}

fn path_in(folder: &Path) -> PathBuf {
    folder.join(KEPT)
}
