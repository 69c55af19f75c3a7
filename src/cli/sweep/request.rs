//! What is asked of a sweep.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::combinations::{Run, combinations, count};
use crate::cli::failure::{Failure, PipelineError};
use crate::cli::set_up::{folder_of, read_scene};
use crate::cli::shell::line;
use crate::scene::{Scene, split_setting};
use crate::spin::Class;

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
        let set = self.spelled_out()?;
        let count = count(&set);
        if count > MOST_RUNS {
            return Err(Failure::Sweep(count));
        }
        let runs = combinations(&set);
        let scene = |run: &Run| read_scene(self.scene, self.mesh, &run.settings);
        let scenes = runs.iter().map(scene).collect::<Result<Vec<_>, _>>()?;
        Ok((runs, scenes))
    }

    /// Whether there is more than one run.
    pub fn is_sweep(&self) -> bool {
        count(self.set) > 1 || self.set.iter().any(|text| asks_for_all(text))
    }

    /// What was typed, with `spin.class=all` as the digits of all classes of the surface.
    fn spelled_out(&self) -> Result<Vec<String>, Failure> {
        let mut set = self.set.to_vec();
        let Some(place) = set.iter().position(|text| asks_for_all(text)) else { return Ok(set) };
        let Some(first) = combinations(&set).into_iter().next() else { return Ok(set) };
        let scene = read_scene(self.scene, self.mesh, &first.settings)?;
        let generators = scene.surface().map_err(PipelineError::from)?.mesh.betti();
        let count = u32::try_from(generators).ok().and_then(|digits| 1_usize.checked_shl(digits)).unwrap_or(usize::MAX);
        if count > MOST_RUNS {
            return Err(Failure::Sweep(count));
        }
        let classes: Vec<String> = (0..count).map(|number| Class::of_number(number, generators).to_string()).collect();
        set[place] = format!("spin.class={}", classes.join(","));
        Ok(set)
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

    /// The command that asks for it, for a shell, beside a scene file of this name.
    pub fn command(&self, scene: &str) -> String {
        let mut words = vec!["immerse".to_owned(), "sweep".to_owned(), format!("{scene}.toml")];
        self.set.iter().for_each(|setting| words.extend(["--set".to_owned(), setting.clone()]));
        let name = self.mesh.and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        name.into_iter().for_each(|name| words.extend(["--mesh".to_owned(), name]));
        line(&words)
    }

    /// How a scene with these settings is named on a command line.
    pub fn scene_of(&self, settings: &[String]) -> Vec<OsString> {
        let mut words = vec![self.scene.into()];
        settings.iter().for_each(|setting| words.extend(["--set".into(), setting.into()]));
        self.mesh.iter().for_each(|mesh| words.extend(["--mesh".into(), mesh.into()]));
        words
    }
}

/// Whether a setting stands for all classes.
fn asks_for_all(setting: &str) -> bool {
    split_setting(setting) == Some(("spin.class", "all"))
}
