//! Generated surfaces, one file per family. Closed surfaces are oriented outward, flat ones toward +z.

mod cylinder;
mod disk;
mod editable;
mod flat_torus;
mod grid;
mod hyperbolic_disk;
mod implicit;
mod isosurface;
mod limits;
mod named_polyhedra;
mod polyhedron;
mod remesh;
mod solid;
mod sphere;
mod torus;

use glam::DVec3;

use super::{Mesh, MeshError, Surface};

pub use cylinder::{annulus, cylinder};
pub use disk::disk;
pub use flat_torus::flat_torus;
pub use hyperbolic_disk::hyperbolic_disk;
pub use implicit::implicit;
pub use polyhedron::polyhedron;
pub use sphere::{sphere, uv_sphere};
pub use torus::torus;

/// A surface known by its positions.
fn embedded(positions: Vec<DVec3>, faces: &[[u32; 3]]) -> Result<Surface, MeshError> {
    let mesh = Mesh::from_faces(positions.len(), faces)?;
    Ok(Surface { mesh, positions: Some(positions), coordinates: None, edge_lengths: None, repairs: Vec::new() })
}
