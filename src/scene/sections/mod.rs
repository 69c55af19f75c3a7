//! The sections of a scene, one function each: its keys, what they may be, and their defaults.

use super::build::degrees;
use super::data::*;
use super::look_section::look;
use super::metric_section::metric;
use super::motion_sections::{bending, binary_digits, clock, pin, spin, start};
use super::picture_sections::{camera, light, output};
use super::shapes::mesh;
use super::table::Table;
use crate::evolve::{Phase, TimeStep};
use crate::frames::Method;

/// All sections. Name, folder and source are filled in by the caller.
pub(super) fn root(table: &mut Table) -> Scene {
    let (mesh, weld) = table.table("mesh", "The surface: a file or a generated shape.", mesh);
    let mut bending_stiffness = None;
    let mut scene = Scene {
        mesh,
        weld,
        parameters: table.map("parameters", "Numbers by name, for formulas; each may use those before it and `t`."),
        metric: table.table(
            "metric",
            "Its edge lengths; left out, those of the shape or of the mesh's positions.",
            metric,
        ),
        spin: table.table("spin", "Its regular homotopy class.", spin),
        start: table.table("start", "Where the frames start; left out, random = 0.", start),
        phases: table.tables("phase", PHASES, phase),
        bending: table
            .optional_table("bending", "How the surface bends, and target bending angles.", bending)
            .and_then(|(angles, stiffness)| {
                bending_stiffness = stiffness;
                angles
            }),
        pins: table.tables("pin", "Vertices held in place or led along.", pin),
        clock: table.table("clock", "Frames and their times.", clock),
        camera: table.table("camera", "The view; what is left out frames the surface by itself.", camera),
        lights: table.tables("light", "A directional light; without any, the studio's three.", light),
        look: table.table("look", "Colours and lines.", look),
        output: table.table("output", "Picture size and format.", output),
        checks: table.table("checks", "What must hold, else the run fails.", checks),
        ..Scene::default()
    };
    scene.relaxation = RelaxationSection { bending_stiffness };
    scene.clock.a_frame_for_each_class &= scene.spin == SpinSection::All;
    scene
}

const PHASES: &str = "A stage of the relaxation. Without any there are five: epsilon = [1, 1, 1, 1] with dt = faces / 28, \
     [1, 0.1, 1, 0.1] with dt = 100 (rims resolve here), [1, 0.01, 1, 0.1] and [1, 0.001, 1, 0.1] with dt = 30, and \
     [1, 0.0001, 1, 0.1] with dt = 10; frames that start from a shape go through the last one only, and so do frames \
     that follow in a film. `immerse check SCENE --phases` prints those of a scene. A [[phase]] with `index` or `like` \
     changes default ones; others replace them. `bending_stiffness` under [bending] is epsilon[1] of the last.";

fn phase(table: &mut Table) -> PhaseSection {
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

fn checks(table: &mut Table) -> ChecksSection {
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
    }
}
