//! `gallery`: one picture of each scene.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::diagnostics::say;
use super::failure::{Failure, PipelineError};
use super::pipeline;
use super::progress::Bar;
use super::set_up::count_classes;
use crate::scene::Scene;

/// The scene of which there is a picture in all looks, `looks.png`.
const SHOWN_IN_ALL_LOOKS: &str = "flat_torus";

/// Makes `<out>/<scene>.png` of each scene, and gives those that were skipped because their input is not there. Films
/// are kept in `work`, and gone on with.
pub(super) fn gallery(
    scenes: &[PathBuf],
    out: &Path,
    work: &Path,
    progress: &mut Bar,
    answers: &mut impl Write,
) -> Result<(), Failure> {
    let all = if scenes.is_empty() { shipped_scenes()? } else { scenes.to_vec() };
    fs::create_dir_all(out).map_err(|source| Failure::Folder { path: out.to_owned(), source })?;
    let mut missing = 0;
    for path in &all {
        let poster = Scene::read(path).map_err(PipelineError::from).and_then(|mut scene| {
            count_classes(&mut scene)?;
            let poster = out.join(&scene.name).with_extension("png");
            let film = work.join(&scene.name);
            pipeline::poster(&scene, &film, &poster, progress)?;
            if scene.name == SHOWN_IN_ALL_LOOKS {
                pipeline::look_sheet(&scene, &film, &out.join("looks.png"), progress)?;
            }
            Ok(poster)
        });
        progress.clear();
        match poster {
            Ok(poster) => writeln!(answers, "{}", poster.display())?,
            // Some scenes want a mesh that is not shipped.
            Err(error) if scenes.is_empty() && error.is_fault_of_input() => {
                missing += 1;
                say(format_args!("{}: skipped; {}", path.display(), first_line(&error)));
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(writeln!(answers, "{}: {} pictures made, {missing} scenes skipped", out.display(), all.len() - missing)?)
}

/// `scenes/*.toml`, in order.
fn shipped_scenes() -> Result<Vec<PathBuf>, Failure> {
    let folder = Path::new("scenes");
    let failed = |source| Failure::Folder { path: folder.to_owned(), source };
    let mut scenes = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            scenes.push(path);
        }
    }
    scenes.sort();
    Ok(scenes)
}

fn first_line(error: &PipelineError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}
