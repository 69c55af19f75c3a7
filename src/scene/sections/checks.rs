//! `[checks]`

use super::spin::binary_digits;
use crate::scene::data::{ChecksSection, FilmChecksSection};
use crate::scene::keys::Table;

pub(super) fn checks(table: &mut Table) -> ChecksSection {
    ChecksSection {
        max_l2_length_error: table
            .key("max_l2_length_error", "Bound on the root mean square relative length error; 0.01 is one percent.")
            .at_least(0.0)
            .optional(0.01),
        max_rims: table.key("max_rims", "Bound on the number of rims.").optional(0),
        max_pinch_points: table.key("max_pinch_points", "Bound on the number of pinch points.").optional(0),
        class: table
            .key::<String>("class", "The class that every frame must have, one digit 0 or 1 per generator.")
            .optional("01".into())
            .map(|class| binary_digits(table, "class", class)),
        max_curvature_error: table
            .key(
                "max_curvature_error",
                "Bound on the distance of every curvature from the target of a flow, in radians.",
            )
            .at_least(0.0)
            .optional(1e-10),
        max_mean_distance: table
            .key(
                "max_mean_distance",
                "Bound on the mean distance to the mesh's own positions, relative to their diameter.",
            )
            .at_least(0.0)
            .optional(0.001),
        max_pin_distance: table
            .key("max_pin_distance", "Bound on the distance of pinned vertices from where they belong.")
            .at_least(0.0)
            .optional(1e-9),
        rms_bending_error: table
            .key(
                "rms_bending_error",
                "Bound on the root mean square distance of bending angles from their targets, in degrees.",
            )
            .at_least(0.0)
            .optional(1.0),
        max_bending_error: table
            .key("max_bending_error", "Bound on the largest distance of a bending angle from its target, in degrees.")
            .at_least(0.0)
            .optional(5.0),
        film: table.table("film", "Bounds on all frames.", film_checks),
    }
}

fn film_checks(table: &mut Table) -> FilmChecksSection {
    FilmChecksSection {
        max_l2_length_error: table
            .key("max_l2_length_error", "Bound on the length error of every frame.")
            .at_least(0.0)
            .optional(0.01),
        median_l2_length_error: table
            .key("median_l2_length_error", "Bound on the length error of the median frame.")
            .at_least(0.0)
            .optional(0.01),
        max_rims: table.key("max_rims", "Bound on the number of rims of every frame.").optional(0),
        max_unconverged: table
            .key(
                "max_unconverged",
                "Bound on the number of frames that ran into the limit of steps before they settled.",
            )
            .optional(0),
        max_jump: table
            .key(
                "max_jump",
                "Bound on the largest move of a vertex between frames, in units of the median of these largest moves.",
            )
            .above(0.0)
            .optional(10.0),
        regular_homotopy: table
            .key(
                "regular_homotopy",
                "Whether the film must be a regular homotopy: no hinge folds and no face vanishes, on a frame or between two, as `immerse certify` decides.",
            )
            .optional(true),
    }
}
