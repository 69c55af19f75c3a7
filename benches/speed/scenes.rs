//! The surfaces that are timed.

use std::{error::Error, path::Path};

use immerse::mesh::shapes::Shape;
use immerse::scene::{MeshSection, Scene};

/// Names of spheres with their number of parts per edge of the icosahedron: 20 n² faces.
pub const SPHERES: [(&str, usize); 4] =
    [("sphere-6k", 17), ("sphere-29k", 38), ("sphere-200k", 100), ("sphere-1M", 224)];

/// `torus-00` to `torus-11`: 6000 equilateral triangles of side 0.05 (Fig. 14 of the paper); the spheres; `hare`: about
/// 29 thousand irregular triangles; or the path of a mesh. All from random frames with seed 0.
pub fn scene(name: &str) -> Result<Scene, Box<dyn Error>> {
    if name == "hare" {
        let mut scene = Scene::parse(include_str!("../../scenes/hare.toml"), name, "".as_ref())?;
        if let MeshSection::Shape(Shape::Implicit { edge_length, .. }) = &mut scene.mesh {
            *edge_length = 0.0197;
        }
        return Ok(scene);
    }
    let text = if let Some(class) = name.strip_prefix("torus-") {
        format!(
            "[mesh]\nshape = 'flat_torus'\na = [3, 0]\nb = [0, 2.165063509461097]\ncolumns = 60\nrows = 50\n[spin]\nclass = '{class}'"
        )
    } else if let Some((_, subdivisions)) = SPHERES.iter().find(|(sphere, _)| *sphere == name) {
        format!("[mesh]\nshape = 'sphere'\nsubdivisions = {subdivisions}")
    } else if Path::new(name).extension().is_some() {
        format!("[mesh]\nfile = {:?}", std::path::absolute(name)?)
    } else {
        return Err(
            format!("there is no surface `{name}`; write one of torus-00, sphere-6k, hare or a mesh file").into()
        );
    };
    Ok(Scene::parse(&text, name, "".as_ref())?)
}
