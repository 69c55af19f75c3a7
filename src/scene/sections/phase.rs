//! `[[phase]]`

use crate::evolve::{Phase, TimeStep};
use crate::frames::Method;
use crate::scene::build::degrees;
use crate::scene::data::{LikeDefault, PhaseSection};
use crate::scene::keys::Table;

pub(super) fn phase(table: &mut Table) -> PhaseSection {
    let default = Phase::default();
    let like = table.choice(
        "like",
        "\"default\": all default phases, with what else stands here changed in each.",
        &[("default", ())],
    );
    let index = table
        .key("index", "The default phase, counted from 1, that is changed by what else stands here; all others stay.")
        .at_least(1.0)
        .optional(5);
    let given = PhaseSection::KEYS.into_iter().filter(|key| table.has(key)).collect();
    let like = (like.is_some() || index.is_some()).then_some(LikeDefault { index, given });
    let method = table.choice(
        "method",
        "The step: implicit with the norm's basis frozen, Alg. 5 as printed, or Alg. 6.",
        &[("implicit", Method::Implicit), ("gradient", Method::Gradient), ("newton", Method::Newton)],
    );
    let phase = Phase {
        method: method.unwrap_or(default.method),
        stiffness: table
            .key("epsilon", "(length, bending, normal rotation, torsion) weights, Eq. 20.")
            .at_least(0.0)
            .or(default.stiffness),
        dt: TimeStep::FaceAreas(
            table.key("dt", "Time step in units of the mean face area.").above(0.0).or(default.dt.in_face_areas(1)),
        ),
        turn_radians: table
            .key(
                "turn",
                "Steps after the first are as long as it takes for frames to turn by this many degrees a step.",
            )
            .above(0.0)
            .at_most(90.0)
            .optional(1.0)
            .map(f64::to_radians),
        feedback: table
            .key("feedback", "How far frames move toward those of the integrated surface after each step, Alg. 8.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.feedback),
        periods: table
            .key("periods", "How far frames move toward those of edge vectors without periods after each step.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.periods),
        crease: table
            .key("crease", "Stiffness of creases that are about to fold over.")
            .at_least(0.0)
            .or(default.crease),
        accelerate: table
            .key("accelerate", "Whether steps are combined with earlier ones once they shrink.")
            .or(default.accelerate),
        tolerance_radians: table
            .key("tolerance", "The stage ends when the mean turn of a frame per step is below this, in degrees.")
            .above(0.0)
            .at_most(180.0)
            .or(degrees(default.tolerance_radians))
            .to_radians(),
        min_steps: table.key("min_steps", "The least number of steps.").or(default.min_steps),
        max_steps: table
            .key("max_steps", "After this many steps the stage is said not to have converged.")
            .at_least(1.0)
            .or(default.max_steps),
        untangle_steps: table
            .key("untangle_steps", "So many more steps are taken as long as there are rims.")
            .or(default.untangle_steps),
        solver_tolerance: default.solver_tolerance,
    };
    if phase.stiffness.iter().all(|&weight| weight == 0.0) {
        table.complain("epsilon", "all weights are 0, so that nothing is minimized", "make the first one 1");
    }
    // Those of default phases are known later.
    if like.is_none() && phase.min_steps > phase.max_steps {
        let (least, most) = (phase.min_steps, phase.max_steps);
        let reason = format!("`min_steps` is {least}, more than `max_steps`, which is {most}");
        table.complain("min_steps", reason, format!("write at most {most}, or raise `max_steps`"));
    }
    PhaseSection { phase, like }
}
