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

    /// As [`Scene::complain`], of a message that ends with what to do, after its last semicolon.
    pub fn complain_of(&self, key: &str, message: &str) -> SceneError {
        let (reason, remedy) = message.rsplit_once("; ").unwrap_or((message, "correct it"));
        self.complain(key, reason, remedy)
    }

    /// The error of a later stage that knows its remedy, at a dotted key.
    pub fn complain_about(&self, key: &str, error: &impl Advice) -> SceneError {
        self.complain(key, error.reason(), error.remedy())
    }
}
