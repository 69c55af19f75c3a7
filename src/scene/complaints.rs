//! Complaints of later stages, shown where the file says what is at fault.

use super::data::Scene;
use super::error::SceneError;
use crate::advice::Advice;

impl Scene {
    /// The error of a later stage about what the file says at a dotted key, such as `mesh.radius` or
    /// `phase[0].dt`; where the file leaves the key out, at the table it would stand in.
    pub fn complain(&self, key: &str, reason: impl Into<String>, remedy: impl Into<String>) -> SceneError {
        self.source.complain(key, reason.into(), remedy.into())
    }

    /// The error of a later stage that knows its remedy, at a dotted key.
    pub fn complain_about(&self, key: &str, error: &impl Advice) -> SceneError {
        self.complain(key, error.reason(), error.remedy())
    }
}
