//! Why there is no array.

/// Why there is no array of numbers, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub reason: String,
    pub remedy: String,
}

impl Fault {
    pub fn new(reason: impl Into<String>, remedy: impl Into<String>) -> Fault {
        Fault { reason: reason.into(), remedy: remedy.into() }
    }
}
