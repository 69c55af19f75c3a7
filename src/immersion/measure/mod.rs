//! What a realized surface is worth: lengths, angles, curvature, rims, class, and all of them as fields.

mod bending_angles;
mod conformal_factor;
mod convexity;
mod curvature;
mod enclosed_volume;
mod fields;
mod figure_8;
mod frames;
mod length_error;

pub use bending_angles::bending_angles;
pub use conformal_factor::ConformalFactor;
pub use convexity::{is_convex, largest_dent};
pub use curvature::{gaussian_curvatures, mean_curvatures};
pub use enclosed_volume::enclosed_volume;
pub use fields::{FieldError, FieldInput, FieldName, FieldValues, Fields};
pub use figure_8::{class_of_positions, is_figure_8, pinch_points};
pub use frames::{mean_turn, rims};
pub use length_error::{LengthError, l2_length_error, length_error, length_errors};

/// Edges or faces that are worth a task of their own.
const TASK: usize = 1024;
