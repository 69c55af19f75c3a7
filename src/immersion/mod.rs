//! Frames to positions and back, and what the result is worth.

mod alignment;
mod bending;
mod crossings;
mod deform;
mod edge_vectors;
mod measure;
mod periods;
mod pins;
mod poisson;
mod polar;
mod spin_of_immersion;
mod starting_shape;

pub use alignment::RigidMotion;
pub use bending::{BendingPart, NoAngle, TargetBending};
pub use deform::{noise_along_normals, noise_displacement};
pub use edge_vectors::edge_vectors;
pub use measure::{
    ConformalFactor, FieldError, FieldInput, FieldName, FieldValues, Fields, LengthError, bending_angles,
    class_of_positions, enclosed_volume, gaussian_curvatures, is_convex, is_figure_8, l2_length_error, largest_dent,
    length_error, length_errors, mean_curvatures, mean_turn, pinch_points, rims,
};
pub use periods::Periods;
pub use pins::{PinError, PinGroup, Pins};
pub use poisson::Poisson;
pub use polar::{frames_of_edge_vectors, frames_of_positions};
pub use spin_of_immersion::{rimless_frames, spin_of_immersion};
pub use starting_shape::{LostVertex, Noise, mirrored, moved};
