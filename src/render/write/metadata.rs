//! What a picture file says of itself.

use crate::render::Camera;

/// Where a picture comes from. Empty texts and zeros are left out of files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// Name of the scene.
    pub scene: String,
    /// Counted from 1.
    pub frame: usize,
    /// In the units of the scene.
    pub time: f64,
    /// Frames a second.
    pub frame_rate: f64,
    /// What is written on it, or else is worth saying.
    pub comment: String,
    /// Where it was seen from.
    pub camera: Option<Camera>,
}

impl Metadata {
    /// Name and version of this program.
    pub const SOFTWARE: &str = concat!("immerse ", env!("CARGO_PKG_VERSION"));

    /// Keywords and values for files that carry text.
    pub(in crate::render) fn texts(&self) -> Vec<(&'static str, String)> {
        let mut texts = vec![("Software", Self::SOFTWARE.to_owned())];
        if !self.scene.is_empty() {
            texts.push(("Scene", self.scene.clone()));
        }
        if self.frame > 0 {
            texts.push(("Frame", self.frame.to_string()));
            texts.push(("Time", self.time.to_string()));
        }
        if !self.comment.is_empty() {
            texts.push(("Comment", self.comment.clone()));
        }
        texts
    }
}
