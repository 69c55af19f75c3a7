//! Progress in words.

use std::time::Duration;

use super::estimate::{Pace, in_words};
use super::standing::{Frames, Kept, Pictures, Standing};
use crate::evolve::Progress;

#[test]
fn words_for_times() {
    for (seconds, words) in [
        (3, "a few seconds left"),
        (37, "about 40 s left"),
        (100, "about 2 min left"),
        (5399, "about 90 min left"),
        (11_100, "about 3 h 05 min left"),
    ] {
        assert_eq!(in_words(Duration::from_secs(seconds)), words);
    }
}

#[test]
fn the_first_part_may_be_like_no_other() {
    let mut pace = Pace::default();
    assert_eq!(pace.left(10), None);
    pace.begin();
    pace.done(false);
    assert_eq!(pace.left(10), None);
    std::thread::sleep(Duration::from_millis(20));
    pace.done(true);
    let left = pace.left(10).expect("a part is known");
    assert!(left > Duration::from_millis(150) && left < Duration::from_secs(5), "{left:?}");
}

fn step(phase: usize) -> Progress {
    Progress {
        frame: 12,
        component: 0,
        components: 1,
        phase,
        phases: 5,
        restarts: 0,
        step: 3,
        max_steps: 100,
        turn: 0.1,
        tolerance: 0.01,
        settled: false,
        l2_length_error: 0.0031,
        rims: 4,
        inner_iterations: 7,
    }
}

#[test]
fn words() {
    let mut standing = Standing { setting_up: true, ..Standing::default() };
    assert_eq!(standing.line().as_deref(), Some("setting up"));
    let mut frames = Frames { of: 120, done: 11, now: Some(step(5)), polish: None, pace: Pace::default() };
    standing.frames = Some(frames);
    assert_eq!(standing.line().as_deref(), Some("frame 12 of 120, settling, error 0.31 %, 4 rims"));
    frames = Frames {
        of: 120,
        done: 0,
        now: Some(Progress { components: 2, ..step(1) }),
        polish: None,
        pace: Pace::default(),
    };
    let words = "frame 1 of 120, relaxing (component 1 of 2, phase 2 of 5), error 0.31 %, 4 rims";
    standing.frames = Some(frames);
    assert_eq!(standing.line().as_deref(), Some(words));
    standing.count_pictures(Pictures { stage: "camera", of: 120, done: 11, pace: Pace::default() });
    assert_eq!(standing.line().as_deref(), Some(words));
    frames = Frames { of: 120, done: 120, now: None, polish: None, pace: Pace::default() };
    standing.frames = Some(frames);
    standing.count_pictures(Pictures { stage: "render", of: 120, done: 4, pace: Pace::default() });
    assert_eq!(standing.line().as_deref(), Some("all 120 frames done, pictures 4 of 120"));
    assert_eq!(standing.kept(), Kept { frames: Some([120, 120]), pictures: Some([4, 120]) });
}
