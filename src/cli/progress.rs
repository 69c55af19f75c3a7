//! How far a run is, on standard error.

use std::time::Duration;

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Is told of the stages of a run, and how far each is.
pub trait Stages: Send {
    /// A stage begins: its name, and how many parts it has if that is known.
    fn begin(&mut self, stage: &str, parts: Option<usize>);

    /// So many parts are done; the length error where there is one.
    fn advance(&mut self, done: usize, length_error: Option<f64>);

    /// Says something that stays on the screen, such as that a phase did not converge.
    fn note(&mut self, text: &str);
}

/// A bar with stage, error and the time left. It draws itself only on a terminal.
pub(super) struct Bar {
    bar: ProgressBar,
    /// It and those that stand with it.
    bars: MultiProgress,
    quiet: bool,
}

impl Bar {
    pub fn new(quiet: bool) -> Bar {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bars = MultiProgress::with_draw_target(target);
        Bar { bar: bars.add(ProgressBar::no_length()), bars, quiet }
    }

    /// A second one below it, for what happens at the same time.
    pub fn below(&self) -> Bar {
        Bar { bar: self.bars.add(ProgressBar::no_length()), bars: self.bars.clone(), quiet: self.quiet }
    }

    /// Makes room for results on the same terminal.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Stages for Bar {
    fn begin(&mut self, stage: &str, parts: Option<usize>) {
        let template = match parts {
            Some(_) => "{prefix:>12} {bar:30} {pos}/{len} {msg} ({eta} left)",
            None => "{prefix:>12} {spinner} {pos} {msg} ({elapsed})",
        };
        self.bar.reset();
        match parts {
            Some(parts) => self.bar.set_length(parts as u64),
            None => self.bar.unset_length(),
        }
        self.bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        self.bar.set_prefix(stage.to_owned());
        self.bar.set_message("");
        self.bar.enable_steady_tick(Duration::from_millis(200));
    }

    fn advance(&mut self, done: usize, length_error: Option<f64>) {
        self.bar.set_position(done as u64);
        if let Some(error) = length_error {
            self.bar.set_message(format!("error {}", super::results::percent(error)));
        }
    }

    fn note(&mut self, text: &str) {
        if !self.quiet {
            self.bars.suspend(|| super::diagnostics::say(text));
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.clear();
    }
}
