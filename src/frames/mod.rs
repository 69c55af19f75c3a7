//! The quaternion field: energy, gradient, assembly and steps.

mod connection_laplacian;
mod energy;
mod shell;
mod start;
mod step;
mod system;

pub use connection_laplacian::ConnectionLaplacian;
pub use energy::{Gradient, Stiffness, crease_energy, crease_gradient, energy, gradient, hinge_energies, strains};
pub use shell::{Hinge, Shell};
pub use start::{random_frames, spectral_frames};
pub use step::{Method, StepOptions, Stepper};
