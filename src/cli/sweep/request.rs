//! What is asked of a sweep.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::combinations::{Run, combinations, count};
use crate::cli::failure::Failure;
use crate::cli::set_up::{folder_of, read_scene};
use crate::scene::Scene;

/// What is asked for, as it was typed.
pub(in crate::cli) struct Request<'a> {
    pub scene: &'a Path,
    pub mesh: Option<&'a Path>,
    pub set: &'a [String],
    pub out: Option<&'a Path>,
    pub restart: bool,
}

/// More runs are a mistake.
const MOST_RUNS: usize = 10_000;

impl Request<'_> {
    /// All runs and the scene of each, so that nothing begins if one of them has a mistake.
    pub fn runs(&self) -> Result<(Vec<Run>, Vec<Scene>), Failure> {
        let count = count(self.set);
        if count > MOST_RUNS {
            return Err(Failure::Sweep(count));
        }
        let runs = combinations(self.set);
        let scene = |run: &Run| read_scene(self.scene, self.mesh, &run.settings);
        let scenes = runs.iter().map(scene).collect::<Result<Vec<_>, _>>()?;
        Ok((runs, scenes))
    }

    /// Whether there is more than one run.
    pub fn is_sweep(&self) -> bool {
        count(self.set) > 1
    }

    /// The folder of the sweep, beside the one that the film of the scene has.
    pub fn folder(&self, scene: &Scene) -> Result<PathBuf, Failure> {
        if let Some(folder) = self.out {
            return Ok(folder.to_owned());
        }
        let mut name = folder_of(scene, self.scene, Path::new("renders"))?.into_os_string();
        name.push(".sweep");
        Ok(name.into())
    }

    /// How a scene with these settings is named on a command line.
    pub fn scene_of(&self, settings: &[String]) -> Vec<OsString> {
        let mut words = vec![self.scene.into()];
        settings.iter().for_each(|setting| words.extend(["--set".into(), setting.into()]));
        self.mesh.iter().for_each(|mesh| words.extend(["--mesh".into(), mesh.into()]));
        words
    }
}
