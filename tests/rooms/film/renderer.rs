//! The number of the renderer goes up when pictures change, so that no film mixes pictures of two ways.

use immerse::Scene;
use immerse::digest::Key;
use immerse::evolve::Unobserved;
use immerse::film::{FilmFolder, FilmMesh, FilmSpec, RENDERER, make_pictures};
use immerse::render::LookName;
use std::fs;
use std::path::Path;

/// [`RENDERER`], and a key of small pictures in all looks with it.
const KNOWN: (u32, &str) = (2, "169e21a6d59ff50393cde03711937dfdf5c1b6d37614159f3b7bb999ffdf033c");

#[test]
fn pictures_are_those_of_this_renderer() {
    let mut bytes = Vec::new();
    for (look, _) in LookName::ALL {
        let text = format!(
            "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 8\n[start]\nfrom = 'mesh'\n[look]\npreset = '{look}'\n\
             [[look.text]]\ntext = 'frame {{frame}}'\n[output]\nsize = [120, 90]\nsamples = 4\nformat = ['png', 'exr']\n\
             [polish]\nenabled = false\n"
        );
        let scene = Scene::parse(&text, "test", Path::new(".")).unwrap_or_else(|error| panic!("{text}: {error}"));
        let folder = tempfile::tempdir().expect("a folder");
        let mut simulation = scene.simulation().expect("a simulation");
        let spec = FilmSpec::of(&scene, simulation.frame_keys().expect("keys"));
        let surface = FilmMesh::of(simulation.mesh().clone());
        let (film, _) = FilmFolder::open_or_create(folder.path(), &spec, &surface).expect("a film");
        film.write_frame(&simulation.next_frame(&mut Unobserved).expect("a frame")).expect("written");
        make_pictures(&scene, folder.path(), &[1], &mut |_| {}).unwrap_or_else(|error| panic!("{look}: {error}"));
        for name in ["000001.png", "000001.exr"] {
            bytes.extend(fs::read(folder.path().join(name)).expect("a picture"));
        }
    }
    let found = Key::of_bytes(&bytes).to_string();
    assert_eq!(
        (RENDERER, found.as_str()),
        KNOWN,
        "Pictures have changed. If they are to, raise RENDERER in src/film/pictures/keys.rs and write what was found here."
    );
}
