//! Generated surfaces, one file per family. Closed surfaces are oriented outward, flat ones toward +z.

mod cylinder;
mod disk;
mod editable;
mod error;
mod flat_torus;
mod generate;
mod grid;
mod halfway;
mod hyperbolic_disk;
mod implicit;
pub mod limits;
mod octasphere;
mod polyhedra;
mod shape;
mod sphere;
mod torus;

pub use cylinder::{annulus, cylinder};
pub use disk::disk;
pub use error::{ShapeError, ShapeFault};
pub use flat_torus::flat_torus;
pub use halfway::{FigureEight, Halfway, halfway};
pub use hyperbolic_disk::hyperbolic_disk;
pub use implicit::implicit;
pub use octasphere::octasphere;
pub use polyhedra::{names as polyhedron_names, polyhedron};
pub use shape::{Body, Grid, Operation, PolyhedronSource, Shape, Solid};
pub use sphere::{sphere, uv_sphere};
pub use torus::torus;
