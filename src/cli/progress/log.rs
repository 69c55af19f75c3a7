//! Everything that is said on standard error goes through here: messages, and how far a run is.

use std::fmt::Display;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::estimate::Pace;
use super::record::Facts;
use super::standing::{Frames, Kept, Pictures, Standing};
use super::voice::{LogFormat, Voice};
use crate::cli::diagnostics::{explain, one_line};
use crate::evolve::{FrameReport, Progress};
use crate::film::Event;
use crate::polish::PolishStep;
use crate::scene::SceneErrors;

/// Says what happens. Those who hold a clone say it to the same.
#[derive(Clone, Debug)]
pub(in crate::cli) struct Log(Arc<Mutex<State>>);

#[derive(Debug)]
struct State {
    /// Says messages alone.
    is_quiet: bool,
    voice: Voice,
    standing: Standing,
    /// When the next line about progress is due.
    due: Instant,
    /// What was said last of how far the run is, where that stays.
    said: Option<String>,
}

/// From the beginning to the first line where lines stay, from one to the next, and the same on a terminal.
const FIRST: Duration = Duration::from_secs(1);
const EVERY: Duration = Duration::from_secs(5);
const ON_TERMINAL: Duration = Duration::from_millis(100);

/// Mistakes that are shown. Nobody reads more.
const SHOWN: usize = 20;

impl Log {
    pub fn new(format: LogFormat, is_quiet: bool) -> Log {
        let voice = Voice::new(format);
        let due = Instant::now() + if voice.can_change_lines() { ON_TERMINAL } else { FIRST };
        Log(Arc::new(Mutex::new(State { is_quiet, voice, standing: Standing::default(), due, said: None })))
    }

    /// Something worth knowing.
    pub fn note(&self, text: impl Display) {
        self.state().voice.message("note", "", &text.to_string());
    }

    /// Something that may be wrong.
    pub fn warning(&self, text: impl Display) {
        self.state().voice.message("warning", "warning: ", &text.to_string());
    }

    /// Something that is wrong.
    pub fn error(&self, text: impl Display) {
        self.state().voice.message("error", "error: ", &text.to_string());
    }

    /// The mistakes of a scene, each with its line and a caret.
    pub fn mistakes(&self, errors: &SceneErrors) {
        let mistakes = match errors {
            SceneErrors::Unreadable { .. } => return self.error(errors),
            SceneErrors::Mistakes(mistakes) => mistakes,
        };
        let mut state = self.state();
        for mistake in mistakes.iter().take(SHOWN) {
            let voice = &mut state.voice;
            match voice.format {
                LogFormat::Json => voice.record("error", Facts::of_mistake(mistake)),
                LogFormat::Text => voice.say(&explain(mistake, voice.can_be_colored())),
            }
            if mistake.more > 0 && mistakes.len() <= SHOWN {
                state.voice.message("error", "", &format!("and {} more like the last one", mistake.more));
            }
        }
        let count: usize = mistakes.iter().map(|mistake| 1 + mistake.more).sum();
        if mistakes.len() > SHOWN {
            state.voice.message("error", "", &format!("and {} more", count - SHOWN));
        }
        if count > 1 {
            state.voice.message("error", "", &format!("{count} mistakes"));
        }
    }

    /// What follows is of this scene.
    pub fn of_scene(&self, name: &str) {
        self.state().standing = Standing { scene: Some(one_line(name).into_owned()), ..Standing::default() };
    }

    /// A simulation is set up.
    pub fn setting_up(&self) {
        self.state().standing.setting_up = true;
        self.tick();
    }

    /// A simulation begins, of a film of which the first frames are there.
    pub fn begin_film(&self, kept: usize, of: usize) {
        let mut pace = Pace::default();
        pace.begin();
        self.state().standing.frames = Some(Frames { of, done: kept, now: None, polish: None, pace });
        self.tick();
    }

    /// A step was taken.
    pub fn step(&self, step: &Progress) {
        if let Some(frames) = &mut self.state().standing.frames {
            frames.now = Some(*step);
        }
        self.tick();
    }

    /// A step of polish was taken.
    pub fn polish_step(&self, step: &PolishStep) {
        if let Some(frames) = &mut self.state().standing.frames {
            frames.polish = Some(*step);
        }
        self.tick();
    }

    /// A frame is done and on disk.
    pub fn frame_done(&self, report: &FrameReport) {
        let state = &mut *self.state();
        if let Some(frames) = &mut state.standing.frames {
            // The first one is relaxed from nothing, the others follow.
            frames.pace.done(report.frame > 1);
            (frames.done, frames.now, frames.polish) = (report.frame, None, None);
        }
        if !state.is_quiet {
            state.voice.record("frame", Facts::of_frame(&state.standing, report));
        }
    }

    /// Something happened to pictures.
    pub fn pictures(&self, event: Event) {
        let mut guard = self.state();
        let state = &mut *guard;
        match event {
            Event::Begin(stage, of) => {
                let mut pace = Pace::default();
                pace.begin();
                state.standing.count_pictures(Pictures { stage, of, done: 0, pace });
            }
            Event::Done(done) => {
                let Some(mut pictures) = state.standing.pictures.take() else { return };
                pictures.pace.done(true);
                let is_of_frame = pictures.are_of_frames();
                state.standing.count_pictures(Pictures { done, ..pictures });
                if is_of_frame && !state.is_quiet {
                    state.voice.record("picture", Facts::of(&state.standing));
                }
            }
            Event::Note(text) => state.voice.message("note", "", &text),
        }
        drop(guard);
        self.tick();
    }

    /// Says how far the run is when that is due.
    pub fn tick(&self) {
        let mut state = self.state();
        let now = Instant::now();
        if state.is_quiet || now < state.due {
            return;
        }
        state.due = now + if state.voice.can_change_lines() { ON_TERMINAL } else { EVERY };
        state.say_standing();
    }

    /// Work is over: what is on the screen that changes goes, and where lines stay the last one follows.
    pub fn finish(&self) {
        let mut state = self.state();
        state.voice.erase();
        if state.said.is_some() {
            state.say_standing();
        }
        state.standing.setting_up = false;
        state.due = Instant::now() + EVERY;
    }

    /// The program ends with this code.
    pub fn end(&self, code: u8) {
        let state = &mut *self.state();
        state.voice.erase();
        state.voice.record("end", Facts::of_end(&state.standing, code));
    }

    /// What stays if the run ends now.
    pub fn kept(&self) -> Kept {
        self.state().standing.kept()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn say_standing(&mut self) {
        let Some(line) = self.standing.line() else { return };
        if self.voice.can_change_lines() {
            self.voice.show(&line);
        } else if self.said.as_ref() != Some(&line) {
            match self.voice.format {
                LogFormat::Text => self.voice.say(&line),
                LogFormat::Json => self.voice.record("progress", Facts::of(&self.standing)),
            }
            self.said = Some(line);
        }
    }
}
