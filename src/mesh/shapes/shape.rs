//! The `[mesh]` section of a scene as a validated surface.

use std::path::Path;

use super::shapes;
use super::{MeshError, Surface, read, read_welded};
use crate::scene::{MeshSection, Scene, Shape};

/// The surface of a scene, its seams welded as it says.
///
/// # Errors
/// As [`from_scene`].
pub fn of_scene(scene: &Scene) -> Result<Surface, MeshError> {
    match &scene.mesh {
        MeshSection::File(path) => read_welded(&scene.folder.join(path), scene.weld),
        section => from_scene(section, &scene.folder),
    }
}

/// Reads or generates a surface, its seams welded as is usual for the format of the file. Relative paths start in `folder`, that of the scene file.
///
/// # Errors
/// What [`read`] and the functions of [`shapes`] refuse.
pub fn from_scene(section: &MeshSection, folder: &Path) -> Result<Surface, MeshError> {
    let shape = match section {
        MeshSection::File(path) => return read(&folder.join(path)),
        MeshSection::Shape(shape) => shape,
    };
    match *shape {
        Shape::Sphere { radius, subdivisions } => shapes::sphere(radius, subdivisions),
        Shape::UvSphere { radius, meridians, parallels } => shapes::uv_sphere(radius, meridians, parallels),
        Shape::FlatTorus { a, b, columns, rows, grid } => shapes::flat_torus(a, b, columns, rows, grid),
        Shape::Torus { major_radius, minor_radius, columns, rows } => {
            shapes::torus(major_radius, minor_radius, columns, rows)
        }
        Shape::Cylinder { radius, height, columns, rows } => shapes::cylinder(radius, height, columns, rows),
        Shape::Annulus { inner_radius, outer_radius, columns, rows } => {
            shapes::annulus(inner_radius, outer_radius, columns, rows)
        }
        Shape::Disk { radius, rings } => shapes::disk(radius, rings),
        Shape::HyperbolicDisk { curvature, radius, faces } => shapes::hyperbolic_disk(curvature, radius, faces),
        Shape::Polyhedron { ref source, subdivisions } => shapes::polyhedron(source, subdivisions),
        Shape::Implicit { ref solid, edge_length } => shapes::implicit(solid, edge_length),
    }
}
