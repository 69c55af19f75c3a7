//! `[[phase]]` and `bending_stiffness` as a schedule, and a schedule as text.

use std::fmt::{self, Write};

use crate::evolve::{Phase, Schedule};
use crate::frames::Method;
use crate::scene::{PhaseSection, Scene, SceneError, StartFrom};

impl Scene {
    /// The phases of the scene. Without any of its own they are the default ones, which its `[[phase]]` may change.
    ///
    /// # Errors
    /// At the phase that is at fault.
    pub fn schedule(&self) -> Result<Schedule, SceneError> {
        let defaults = match self.start.from {
            StartFrom::Random(_) | StartFrom::Spectral => Schedule::default(),
            StartFrom::Mesh
            | StartFrom::Mirror
            | StartFrom::Halfway(_)
            | StartFrom::FigureEight
            | StartFrom::File(_) => Schedule::of_last_phase(),
        };
        let schedule = if self.phases.is_empty() { defaults } else { self.changed(defaults.phases())? };
        let Some(stiffness) = self.relaxation.bending_stiffness else { return Ok(schedule) };
        let phases = schedule.phases();
        let is_of_last = |(k, section): (usize, &PhaseSection)| match &section.like {
            None => k + 1 == self.phases.len(),
            Some(like) => like.index.is_none_or(|index| index == phases.len()),
        };
        let says_epsilon = |k: usize| self.source.locate(&format!("phase[{k}].epsilon")).is_some();
        let is_said_twice = (0..).zip(&self.phases).any(|(k, section)| is_of_last((k, section)) && says_epsilon(k));
        if is_said_twice && phases.last().is_some_and(|last| last.stiffness[1] != stiffness) {
            return Err(self.complain(
                "bending.bending_stiffness",
                "`bending_stiffness` and `epsilon` of the last [[phase]] both say how stiff bending is in the end",
                "remove one of them",
            ));
        }
        Ok(schedule.with_bending_stiffness(stiffness))
    }

    /// What the sections make of the default phases.
    fn changed(&self, defaults: &[Phase]) -> Result<Schedule, SceneError> {
        let sections = &self.phases;
        let index = |section: &PhaseSection| section.like.as_ref().and_then(|like| like.index);
        let count = defaults.len();
        let mut all_like = sections.iter().enumerate().filter(|(_, s)| s.like.is_some() && index(s).is_none());
        if let Some((k, _)) = all_like.nth(1) {
            return Err(self.complain(
                &format!("phase[{k}].like"),
                "all default phases are changed twice",
                "write both changes into one [[phase]], or give one an `index`",
            ));
        }
        let has_index = sections.iter().any(|section| index(section).is_some());
        let mut phases = if has_index { defaults.to_vec() } else { Vec::new() };
        // Which section each phase comes from last.
        let mut sources = vec![None; phases.len()];
        let mut seen = vec![false; count];
        // What is said of all holds first, and what is said of one in place of it.
        let mut order: Vec<usize> = (0..sections.len()).collect();
        order.sort_by_key(|&k| (has_index && index(&sections[k]).is_some(), k));
        for k in order {
            let section = &sections[k];
            match (&section.like, index(section)) {
                (None, _) if has_index => {
                    return Err(self.complain(
                        &format!("phase[{k}]"),
                        "this [[phase]] is a new one, and others change default phases by `index`, so its place is not \
                         known",
                        "give it an `index`, or give none",
                    ));
                }
                (None, _) => {
                    phases.push(section.phase);
                    sources.push(Some(k));
                }
                (Some(_), None) if has_index => phases.iter_mut().for_each(|phase| *phase = section.over(phase)),
                (Some(_), None) => {
                    phases.extend(defaults.iter().map(|phase| section.over(phase)));
                    sources.resize(phases.len(), Some(k));
                }
                (Some(_), Some(index)) => {
                    let key = format!("phase[{k}].index");
                    let (Some(phase), Some(seen)) = (phases.get_mut(index - 1), seen.get_mut(index - 1)) else {
                        return Err(self.no_such_phase(&key, index, count));
                    };
                    if std::mem::replace(seen, true) {
                        let reason = format!("default phase {index} is changed twice");
                        return Err(self.complain(&key, reason, "write both changes into one [[phase]]"));
                    }
                    *phase = section.over(phase);
                    sources[index - 1] = Some(k);
                }
            }
        }
        if let Some(p) = phases.iter().position(|phase| phase.min_steps > phase.max_steps) {
            let (least, most) = (phases[p].min_steps, phases[p].max_steps);
            let reason =
                format!("`min_steps` of default phase {} is then {least}, more than its `max_steps`, {most}", p + 1);
            return Err(self.complain(&format!("phase[{}]", sources[p].unwrap_or(0)), reason, "change both"));
        }
        Schedule::new(phases).map_err(|error| {
            let source = error.phase.checked_sub(1).and_then(|p| sources.get(p).copied().flatten()).unwrap_or(0);
            self.complain_about(&format!("phase[{source}].{}", error.name), &error)
        })
    }

    fn no_such_phase(&self, key: &str, index: usize, count: usize) -> SceneError {
        let there_are = match count {
            1 => "frames that start from a shape have but one".to_owned(),
            _ => format!("there are {count}"),
        };
        let reason = format!("there is no default phase {index}: {there_are}");
        self.complain(key, reason, format!("write `index` from 1 to {count}"))
    }
}

/// Phases as they are written in a scene of so many faces.
pub fn phases_as_text(phases: &[Phase], faces: usize) -> String {
    let mut text = String::new();
    for (k, phase) in phases.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "\n# phase {} of {}", k + 1, phases.len());
        let _ = write_phase(&mut text, phase, faces);
    }
    text
}

fn write_phase(text: &mut String, phase: &Phase, faces: usize) -> fmt::Result {
    let method = match phase.method {
        Method::Implicit => "implicit",
        Method::Gradient => "gradient",
        Method::Newton => "newton",
    };
    writeln!(text, "[[phase]]")?;
    writeln!(text, "method = {method:?}")?;
    writeln!(text, "epsilon = {:?}", phase.stiffness)?;
    writeln!(text, "dt = {:?}", phase.dt.in_face_areas(faces))?;
    if let Some(turn) = phase.turn_radians {
        writeln!(text, "turn = {:?}", degrees(turn))?;
    }
    writeln!(text, "feedback = {:?}", phase.feedback)?;
    writeln!(text, "periods = {:?}", phase.periods)?;
    writeln!(text, "crease = {:?}", phase.crease)?;
    writeln!(text, "accelerate = {}", phase.accelerate)?;
    writeln!(text, "tolerance = {:?}", degrees(phase.tolerance_radians))?;
    writeln!(text, "min_steps = {}", phase.min_steps)?;
    writeln!(text, "max_steps = {}", phase.max_steps)?;
    writeln!(text, "untangle_steps = {}", phase.untangle_steps)
}

/// The shortest number of degrees that is this many radians to the last bit.
pub(crate) fn degrees(radians: f64) -> f64 {
    let exact = radians.to_degrees();
    let rounded = |digits: usize| format!("{exact:.digits$e}").parse::<f64>().ok();
    (0..17).filter_map(rounded).find(|degrees| degrees.to_radians() == radians).unwrap_or(exact)
}
