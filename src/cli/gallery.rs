//! `gallery`: one picture of each scene.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::diagnostics::one_line;
use super::failure::{Failure, PipelineError};
use super::pipeline;
use super::process::Session;
use super::set_up::{folder_of, read_scene};
use super::sweep::{POSTER, Request, sweep};
use crate::whole_file;

/// The scene of which there is a picture in all looks, `looks.png`.
const SHOWN_IN_ALL_LOOKS: &str = "flat_torus";
/// The scenes that are shown in all classes of their surface, by a sweep.
const SHOWN_IN_ALL_CLASSES: [&str; 2] = ["class_gallery", "class_gallery_3"];

/// Makes `<out>/<scene>.png` of each scene, and gives those that were skipped because their input is not there. Films
/// are kept in `work`, and gone on with.
pub(super) fn gallery(
    scenes: &[PathBuf],
    out: &Path,
    work: &Path,
    restart: bool,
    settings: &[String],
    session: &Session,
    answers: &mut impl Write,
) -> Result<(), Failure> {
    let all = if scenes.is_empty() { shipped_scenes()? } else { scenes.to_vec() };
    session.hold(out)?;
    let mut missing = 0;
    for path in &all {
        session.go_on()?;
        match show(path, out, work, restart, settings, session) {
            Ok(poster) => writeln!(answers, "{}", one_line(&poster.display().to_string()))?,
            // Some scenes want a mesh that is not shipped.
            Err(Failure::Pipeline(error)) if scenes.is_empty() && error.is_fault_of_input() => {
                missing += 1;
                session.log.note(format_args!("{}: skipped; {}", path.display(), first_line(&error)));
            }
            Err(error) => return Err(error),
        }
    }
    Ok(writeln!(answers, "{}: {} pictures made, {missing} scenes skipped", out.display(), all.len() - missing)?)
}

/// Makes the picture of a scene. Returns its path.
fn show(
    path: &Path,
    out: &Path,
    work: &Path,
    restart: bool,
    settings: &[String],
    session: &Session,
) -> Result<PathBuf, Failure> {
    let scene = read_scene(path, None, settings)?;
    let film = folder_of(&scene, path, work)?;
    let mut poster = out.join(&scene.name).into_os_string();
    poster.push(".png");
    let poster = PathBuf::from(poster);
    session.log.of_scene(&scene.name);
    if SHOWN_IN_ALL_CLASSES.contains(&scene.name.as_str()) {
        let all = work.join(format!("{}.sweep", scene.name));
        let set = [settings, &["spin.class=all".to_owned()]].concat();
        show_sweep(&Request { scene: path, mesh: None, set: &set, out: Some(&all), restart }, &all, &poster, session)?;
        return Ok(poster);
    }
    session.hold(&film)?;
    let made = pipeline::poster(&scene, &film, restart, &poster, session).and_then(|()| match scene.name.as_str() {
        SHOWN_IN_ALL_LOOKS => pipeline::look_sheet(&scene, &film, &out.join("looks.png"), session),
        _ => Ok(()),
    });
    session.log.finish();
    session.let_go(&film);
    made?;
    Ok(poster)
}

/// Makes the films of a sweep in a folder, and their poster a picture of the gallery.
fn show_sweep(request: &Request, folder: &Path, poster: &Path, session: &Session) -> Result<(), Failure> {
    let swept = sweep(request, session, &mut io::sink());
    session.let_go(folder);
    swept?;
    let failed = |source| Failure::Folder { path: poster.to_owned(), source };
    let picture = fs::read(folder.join(POSTER)).map_err(failed)?;
    whole_file::write_unless_same(poster, &picture).map_err(failed)
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
