#![doc = include_str!("../docs/guide.md")]

pub mod advice;
pub mod digest;
mod npy;
pub mod text;
pub mod tuning;
mod whole_file;

pub mod algebra;
pub mod timeline;

pub mod mesh;

pub mod metric;
pub mod spin;

pub mod frames;
pub mod immersion;
pub mod polish;

pub mod homotopy;

pub mod evolve;
pub mod render;

pub mod scene;

pub mod film;

pub mod cli;

pub use evolve::{ImmersedSurface, Immersion, Program, Simulation};
pub use mesh::Mesh;
pub use metric::Metric;
pub use scene::Scene;
pub use spin::Class;
