//! Numbers of a program that no step could be taken with are refused before any is.

use immerse::evolve::{Phase, Schedule, Settling, TimeStep};

fn refused(change: impl FnOnce(&mut Phase)) -> String {
    let mut phases = Schedule::default().phases().to_vec();
    change(&mut phases[1]);
    Schedule::new(phases).expect_err("refused").to_string()
}

#[test]
fn a_phase_has_numbers_that_steps_can_be_taken_with() {
    let share = "of phase 2 is 1.5; give a number from 0 to 1";
    // It gave frames that are no numbers, and the advice to lower dt.
    assert_eq!(refused(|phase| phase.feedback = 1.5), format!("`feedback` {share}"));
    assert_eq!(refused(|phase| phase.periods = 1.5), format!("`periods` {share}"));
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(|phase| phase.feedback = bad).starts_with("`feedback`"));
        assert!(refused(|phase| phase.stiffness[1] = bad).starts_with("`epsilon`"));
        assert!(refused(|phase| phase.dt = TimeStep::FaceAreas(bad)).starts_with("`dt`"));
        assert!(refused(|phase| phase.dt = TimeStep::ShareOfSurface(bad)).starts_with("`dt`"));
        assert!(refused(|phase| phase.turn_radians = Some(bad)).starts_with("`turn`"));
        assert!(refused(|phase| phase.crease = bad).starts_with("`crease`"));
        assert!(refused(|phase| phase.tolerance_radians = bad).starts_with("`tolerance`"));
        assert!(refused(|phase| phase.solver_tolerance = bad).starts_with("`solver_tolerance`"));
    }
    assert!(refused(|phase| phase.stiffness = [0.0; 4]).starts_with("`epsilon`"));
    assert!(refused(|phase| (phase.min_steps, phase.max_steps) = (5, 4)).starts_with("`max_steps`"));
    assert!(refused(|phase| (phase.min_steps, phase.max_steps) = (0, 0)).starts_with("`max_steps`"));
    assert!(Schedule::new(Vec::new()).is_err());
    let everything = Phase { feedback: 1.0, periods: 0.0, crease: 0.0, ..Phase::default() };
    assert!(Schedule::new(vec![everything; 3]).is_ok());
    assert!(Schedule::new(Schedule::default().phases().to_vec()).is_ok());
}

#[test]
fn a_frame_settles_within_numbers_above_zero() {
    assert!(Settling::new(1e-4, 100, 0.05).is_ok());
    for (tolerance, steps, strain) in [(0.0, 1, 1.0), (f64::NAN, 1, 1.0), (1.0, 0, 1.0), (1.0, 1, 0.0), (1.0, 1, -1.0)]
    {
        assert!(Settling::new(tolerance, steps, strain).is_err(), "{tolerance} {steps} {strain}");
    }
}
