//! From one frame of a film to the next.
//!
//! Where folds are refused, the motion from the frame before is decided as a certificate of the film would. It is the written frames that
//! count, so that nothing is put between them: a frame is made again from the one before, in a film of the relaxation by steps that are half as
//! long, and so ends nearer; in one that follows its metric in parts of half the length, which keep to a sheet of shapes that a long part may leave.

use super::error::{EvolveError, FoldedWay};
use super::frame::Frame;
use super::pace::{Fold, Pace};
use super::progress::Observer;
use super::relax::{Relaxation, split};
use super::simulation::Simulation;
use crate::homotopy::events_between;
use crate::spin::Class;
use std::sync::Arc;
use std::time::Instant;

impl Simulation {
    /// Makes the next frame of the film. The first one of a film that changes with time, or does not and has but one
    /// frame, goes through all phases; the others follow the metric.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it, frames are no longer finite, or the program gives no metric or no place
    /// for its pins at the time of the frame; [`EvolveError::Folds`] where something folds on the way from the frame before and
    /// [`Fold::Refuse`] is asked for. Then it is at the frame before.
    pub fn next_frame(&mut self, observer: &mut dyn Observer) -> Result<Arc<Frame>, EvolveError> {
        let Some(before) = self.previous.clone().filter(|_| self.fold == Fold::Refuse) else {
            return self.make_frame(0, observer);
        };
        let marks: Vec<_> = self.components.iter().map(Relaxation::mark).collect();
        let (metric, curvature_error) = (self.metric.clone(), self.curvature_error);
        let most = self.fold.halvings(self.pace);
        let mut halvings = 0;
        loop {
            let frame = self.make_frame(halvings, observer)?;
            let events = events_between(&self.mesh, &before.positions, &frame.positions);
            let Some(event) = events.first() else { return Ok(frame) };
            (self.frame, self.metric, self.curvature_error) = (before.report.frame, metric.clone(), curvature_error);
            self.previous = Some(before.clone());
            for (relaxation, mark) in self.components.iter_mut().zip(&marks) {
                relaxation.go_back(&self.course, mark)?;
            }
            if halvings == most {
                let (frame, time) = (frame.report.frame, frame.report.time);
                return Err(EvolveError::Folds { frame, time, way: FoldedWay::of(&self.mesh, event), halvings });
            }
            halvings += 1;
        }
    }

    /// Makes the next frame, on a way whose steps or parts are halved so often.
    fn make_frame(&mut self, halvings: usize, observer: &mut dyn Observer) -> Result<Arc<Frame>, EvolveError> {
        let begin = Instant::now();
        let (pace, made, clock) = (self.pace, self.frame, self.clock);
        let time = clock.time(made + 1);
        if let Pace::EachClass = pace {
            self.begin_class(made, time)?;
        }
        let Simulation { components, course, both_ways, .. } = self;
        both_ways
            .iter_mut()
            .try_for_each(|film| film.find(&self.mesh, &self.metric, clock.frames(), time, observer))?;
        for relaxation in components {
            relaxation.begin_frame(made + 1);
            match (pace, made) {
                (Pace::EachClass, _) => relaxation.relax(observer)?,
                (Pace::Settle(settling), 0) => {
                    relaxation.relax(observer)?;
                    relaxation.take_out_dents(&settling, observer)?;
                    if clock.is_looping() {
                        relaxation.run_a_lap(course, &clock, &settling, observer)?;
                    }
                }
                (Pace::Settle(settling), _) => relaxation.follow(course, time, &settling, halvings, observer)?,
                (Pace::BothWays(_), _) => both_ways.iter().for_each(|film| film.show(made + 1, relaxation.state_mut())),
                // The first frame of a film of the relaxation is where it starts.
                (Pace::Steps(_), 0) => {}
                (Pace::Steps(steps), _) => {
                    relaxation.state_mut().move_to(course, time)?;
                    if course.changes() {
                        relaxation.stay_in_last_phase();
                    }
                    relaxation.advance_by_part(steps, 0.5_f64.powi(halvings as i32), observer)?;
                }
            }
            relaxation.state().verify_class()?;
        }
        self.frame += 1;
        self.take_metric(time)?;
        self.frame_since(begin, observer)
    }

    /// Starts over in the class with this number, the last generator being its last binary digit.
    fn begin_class(&mut self, number: usize, time: f64) -> Result<(), EvolveError> {
        let classes = split(&self.components, &Class::of_number(number, self.homology.betti()));
        for (relaxation, class) in self.components.iter_mut().zip(classes) {
            relaxation.state_mut().move_to(&mut self.course, time)?;
            relaxation.begin_class(&self.course, class)?;
        }
        self.previous = None;
        Ok(())
    }

    fn take_metric(&mut self, time: f64) -> Result<(), EvolveError> {
        let asked = self.course.metric(time)?;
        (self.metric, self.curvature_error) = (asked.metric.clone(), asked.curvature_error);
        Ok(())
    }
}
