//! Lines on standard error, and one below them that changes.

use std::io::{self, IsTerminal, Write};
use std::time::Instant;

use clap::ValueEnum;

use super::record::{Facts, Record};
use crate::cli::diagnostics::one_line;

/// How things are said on standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum LogFormat {
    /// Sentences, for people
    #[default]
    Text,
    /// One JSON object a line, for programs
    Json,
}

/// Writes lines to standard error, each in one piece. If even that is gone there is nobody to tell.
#[derive(Debug)]
pub(super) struct Voice {
    pub format: LogFormat,
    is_terminal: bool,
    began: Instant,
    /// Characters of the line that changes.
    shown: usize,
}

/// Characters in a line where a terminal does not say how many it has.
const COLUMNS: usize = 80;

impl Voice {
    pub fn new(format: LogFormat) -> Voice {
        Voice { format, is_terminal: io::stderr().is_terminal(), began: Instant::now(), shown: 0 }
    }

    /// Whether there may be a line that changes.
    pub fn can_change_lines(&self) -> bool {
        self.is_terminal && self.format == LogFormat::Text
    }

    pub fn can_be_colored(&self) -> bool {
        self.is_terminal && std::env::var_os("NO_COLOR").is_none()
    }

    /// A message on one line, which begins with a word for people or is of this kind.
    pub fn message(&mut self, event: &str, beginning: &str, text: &str) {
        match self.format {
            LogFormat::Text => self.say(&format!("{beginning}{}", one_line(text))),
            LogFormat::Json => self.record(event, Facts::of_text(text)),
        }
    }

    /// A line of JSON, where that is asked for.
    pub fn record(&mut self, event: &str, facts: Facts) {
        if self.format == LogFormat::Text {
            return;
        }
        // Milliseconds are fine enough.
        let seconds = self.began.elapsed().as_millis() as f64 / 1e3;
        if let Ok(line) = serde_json::to_string(&Record { event, seconds, facts }) {
            self.say(&line);
        }
    }

    /// A line that stays, or several.
    pub fn say(&mut self, text: &str) {
        let erased = self.erasing();
        write(&format!("{erased}{text}\n"));
    }

    /// A line in place of the one that changes; on terminals only.
    pub fn show(&mut self, text: &str) {
        let columns = terminal_size::terminal_size_of(io::stderr()).map_or(COLUMNS, |(width, _)| width.0.into());
        // A terminal that is full to its last column would go on in the next line.
        let text: String = text.chars().take(columns.saturating_sub(1)).collect();
        let length = text.chars().count();
        let rest = " ".repeat(self.shown.saturating_sub(length));
        let back = "\u{8}".repeat(rest.len());
        write(&format!("\r{text}{rest}{back}"));
        self.shown = length;
    }

    /// No line that changes any more.
    pub fn erase(&mut self) {
        let erased = self.erasing();
        if !erased.is_empty() {
            write(&erased);
        }
    }

    /// What takes the line away that changes.
    fn erasing(&mut self) -> String {
        match std::mem::take(&mut self.shown) {
            0 => String::new(),
            shown => format!("\r{}\r", " ".repeat(shown)),
        }
    }
}

fn write(text: &str) {
    let mut stderr = io::stderr().lock();
    let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
}
