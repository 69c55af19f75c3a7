//! The quaternion field: energy, gradient, assembly and steps.

mod connection_laplacian;
mod energy;
mod random_frames;
mod rim_flips;
mod shell;
mod smooth_patch;
mod spectral_frames;
mod step;
mod system;

pub use connection_laplacian::ConnectionLaplacian;
pub use energy::{Gradient, Stiffness, crease_energy, crease_gradient, energy, gradient, hinge_energies, strains};
pub use random_frames::random_frames;
pub use rim_flips::flip_along_rims;
pub use shell::{Hinge, Shell, ShellError};
pub use smooth_patch::smooth_patch;
pub use spectral_frames::spectral_frames;
pub use step::{Method, StepOptions, Stepper};
