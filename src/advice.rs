//! Errors that say what to do.

use std::fmt::Display;

/// An error that knows its remedy. As a text it is the reason, a semicolon and the remedy.
pub trait Advice: Display {
    /// What to do about it.
    fn remedy(&self) -> String;

    /// What is wrong, without the remedy.
    fn reason(&self) -> String {
        let text = self.to_string();
        match text.strip_suffix(&self.remedy()).and_then(|rest| rest.strip_suffix("; ")) {
            Some(reason) => reason.to_owned(),
            None => text,
        }
    }
}
