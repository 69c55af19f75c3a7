//! What is to be said of a film before anything else, from those who judge it.

use serde::Serialize;

/// What a film is worth, in words.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Findings {
    /// What is wrong, a sentence each: what does not hold, what did not converge, and why that may be.
    pub faults: Vec<String>,
    /// What the scene asks for, and whether it holds.
    pub checks: Vec<Finding>,
    /// The command that makes the film again.
    pub command: String,
}

/// One thing that the scene asks for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Finding {
    /// Its key in the scene.
    pub name: String,
    /// What is asked for.
    pub limit: String,
    /// What was measured.
    pub value: String,
    /// Whether that is what is asked for.
    pub holds: bool,
}
