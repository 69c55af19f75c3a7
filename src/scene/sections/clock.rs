//! `[clock]`

use crate::evolve::Fold;
use crate::scene::data::ClockSection;
use crate::scene::keys::Table;
use crate::timeline::Clock;

const MAX_FRAMES: f64 = Clock::MOST_FRAMES as f64;

pub(super) fn clock(table: &mut Table) -> ClockSection {
    let default = ClockSection::default();
    let clock = ClockSection {
        frames: table
            .key("frames", "Number of frames; 1 is a static scene. With class = \"all\" there is one for each class if this is left out.")
            .at_least(1.0)
            .at_most(MAX_FRAMES)
            .or(default.frames),
        a_frame_for_each_class: !table.has("frames"),
        start: table.key("start", "Time of the first frame.").or(default.start),
        end: table.key("end", "Time of the last frame or, in a film that loops, of the one after it.").or(default.end),
        looping: table.key("loop", "Whether the first frame comes after the last one again.").or(default.looping),
        both_ways: table
            .key("both_ways", "Whether the film begins in its middle, on the halfway model of [start]: one way down from there is played backwards, then the other, so that a sphere or a torus turns inside out.")
            .or(default.both_ways),
        fold: table.choice_or("fold", "What happens when something would fold on the way from one frame to the next, on which vertices move on straight lines: \"allow\", or \"refuse\": the frame is made again, nearer to the one before or in smaller parts, and if something folds all the same the film ends with an error.", &[("allow", Fold::Allow), ("refuse", Fold::Refuse)], default.fold),
        steps_per_frame: table
            .key("steps_per_frame", "Steps between the frames of a film of the relaxation; left out, frames of a scene that changes with time relax until they have settled.")
            .at_least(1.0)
            .optional(2),
        tolerance: table
            .key("tolerance", "A frame of a film has settled when its faces turn by less than this a step, in degrees, on average.")
            .above(0.0)
            .at_most(180.0)
            .or(default.tolerance),
        max_steps: table.key("max_steps", "A frame of a film is done after this many steps even if it has not settled; then it counts as unconverged.").at_least(1.0).or(default.max_steps),
        accuracy: table
            .key("accuracy", "A frame is done as soon as its L2 length error is at most this and it has no rims; left out, when it has settled.")
            .above(0.0)
            .optional(0.005),
        max_strain: table
            .key("max_strain", "No edge changes its length by more than this share at once; a frame that brings more is reached in parts.")
            .above(0.0)
            .or(default.max_strain),
    };
    if clock.end <= clock.start {
        let reason = format!("the clock ends at {}, not after its start at {}", clock.end, clock.start);
        table.complain("end", reason, "make `end` greater than `start`");
    }
    if clock.both_ways && (clock.looping || clock.steps_per_frame.is_some()) {
        let reason = "`both_ways` asks for two ways down from the middle, which neither loop nor have steps per frame";
        table.complain("both_ways", reason, "remove `loop` and `steps_per_frame`");
    }
    clock
}
