//! From a shape and its parameters to its surface.

use super::shape::Shape;
use super::{cylinder, disk, flat_torus, halfway, hyperbolic_disk, implicit, octasphere, polyhedra, sphere, torus};
use crate::mesh::{MeshError, Surface};

impl Shape {
    /// Generates the surface.
    ///
    /// # Errors
    /// [`MeshError::Shape`] for parameters that no surface has, and for explicit polygons whatever
    /// [`crate::mesh::repair`] refuses.
    pub fn surface(&self) -> Result<Surface, MeshError> {
        match *self {
            Shape::Sphere { radius, subdivisions } => sphere::sphere(radius, subdivisions),
            Shape::UvSphere { radius, meridians, parallels } => sphere::uv_sphere(radius, meridians, parallels),
            Shape::Octasphere { radius, subdivisions, sides } => octasphere::octasphere(radius, subdivisions, sides),
            Shape::Halfway { lobes, subdivisions } => halfway::halfway(lobes, subdivisions),
            Shape::FlatTorus { a, b, columns, rows, grid } => flat_torus::flat_torus(a, b, columns, rows, grid),
            Shape::Torus { major_radius, minor_radius, columns, rows } => {
                torus::torus(major_radius, minor_radius, columns, rows)
            }
            Shape::Cylinder { radius, height, columns, rows } => cylinder::cylinder(radius, height, columns, rows),
            Shape::Annulus { inner_radius, outer_radius, columns, rows } => {
                cylinder::annulus(inner_radius, outer_radius, columns, rows)
            }
            Shape::Disk { radius, rings } => disk::disk(radius, rings),
            Shape::HyperbolicDisk { curvature, radius, faces } => {
                hyperbolic_disk::hyperbolic_disk(curvature, radius, faces)
            }
            Shape::Polyhedron { ref source, subdivisions } => polyhedra::polyhedron(source, subdivisions),
            Shape::Implicit { ref solid, edge_length } => implicit::implicit(solid, edge_length),
        }
    }
}
