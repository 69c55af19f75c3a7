//! `[[pin]]` and its motion.

use super::selection::selection;
use crate::mesh::Selection;
use crate::scene::data::{MotionSection, PinSection};
use crate::scene::keys::{Table, one_per_time, times};

pub(super) fn pin(table: &mut Table) -> PinSection {
    let pin = PinSection {
        vertices: selection(table),
        positions: table
            .key("positions", "Where they belong, one [x, y, z] for each of `vertices` or `nearest`; left out, where the mesh has them.")
            .or(Vec::new()),
        formula: table
            .key("formula", "Where each goes from there: three formulas of its x, y and z, the time `t` and the parameters.")
            .optional(["x", "y", "z - 0.2 * t"].map(str::to_owned)),
        motion: table.optional_table("motion", "Keyframed rigid motion about their centroid.", motion),
    };
    let positions = pin.positions.len();
    if positions > 0 {
        let selected = match &pin.vertices {
            Selection::Vertices(vertices) => vertices.len(),
            Selection::Nearest(points) => points.len(),
            _ => 0,
        };
        if selected == 0 {
            table.complain(
                "positions",
                "`positions` are in order of a list, and there is none",
                "list `vertices`, or use `formula`",
            );
        } else if positions != selected {
            let reason = format!("there are {positions} positions for {selected} vertices");
            table.complain("positions", reason, "give one [x, y, z] per vertex");
        }
    }
    pin
}

fn motion(table: &mut Table) -> MotionSection {
    let (times, ease) = times(table);
    let still = vec![[0.0; 3]; times.len()];
    let motion = MotionSection {
        translations: table
            .key("translations", "How far they are moved, one [x, y, z] for each time.")
            .or(still.clone()),
        rotations: table
            .key("rotations", "How they are turned, in degrees about x, then y, then z, one for each time.")
            .or(still),
        times,
        ease,
    };
    one_per_time(table, "translations", motion.translations.len(), motion.times.len());
    one_per_time(table, "rotations", motion.rotations.len(), motion.times.len());
    motion
}
