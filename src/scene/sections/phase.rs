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
        "\"default\": in all default phases, what else stands here is changed.",
        &[("default", ())],
    );
    let index = table
        .key("index", "The default phase, counted from 1, that is changed by what else stands here; all others stay.")
        .at_least(1.0)
        .optional(5);
    let given = PhaseSection::KEYS.into_iter().filter(|key| table.has(key)).collect();
    let like = (like.is_some() || index.is_some()).then_some(LikeDefault { index, given });
    let method = table.choice_or(
        "method",
        "How a step is taken: \"implicit\" allows the longest steps; \"gradient\" is Algorithm 5 of the paper as printed, \"newton\" its Algorithm 6.",
        &[("implicit", Method::Implicit), ("gradient", Method::Gradient), ("newton", Method::Newton)],
        default.method,
    );
    let phase = Phase {
        method,
        stiffness: table
            .key("epsilon", "Weights of the energy (Eq. 20 of the paper): of length, bending, rotation about the normal, and torsion.")
            .at_least(0.0)
            .or(default.stiffness),
        dt: TimeStep::FaceAreas(
            table.key("dt", "Length of a step, in units of the mean area of a face.").above(0.0).or(default.dt.in_face_areas(1)),
        ),
        turn_radians: table
            .key(
                "turn",
                "Steps after the first are as long as it takes for faces to turn by this many degrees a step, on average; left out, all have `dt`.",
            )
            .above(0.0)
            .at_most(90.0)
            .optional(1.0)
            .map(f64::to_radians),
        feedback: table
            .key("feedback", "How far face frames move toward those of the surface after each step (Algorithm 8): 0 not at all, 1 all the way.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.feedback),
        periods: table
            .key("periods", "How far face frames move, after each step, to where the surface closes up around its handles: 0 not at all, 1 all the way.")
            .at_least(0.0)
            .at_most(1.0)
            .or(default.periods),
        crease: table
            .key("crease", "Stiffness of the springs that hold creases open before they fold over; 0 lets them.")
            .at_least(0.0)
            .or(default.crease),
        accelerate: table
            .key("accelerate", "Whether steps are combined with earlier ones once they shrink.")
            .or(default.accelerate),
        tolerance_radians: table
            .key("tolerance", "The phase ends when faces turn by less than this a step, in degrees, on average.")
            .above(0.0)
            .at_most(180.0)
            .or(degrees(default.tolerance_radians))
            .to_radians(),
        min_steps: table.key("min_steps", "The phase has at least this many steps.").or(default.min_steps),
        max_steps: table
            .key("max_steps", "The phase ends after this many steps even if faces still turn by more.")
            .at_least(1.0)
            .or(default.max_steps),
        untangle_steps: table
            .key("untangle_steps", "As long as there are rims, the phase goes on for up to this many steps more.")
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
