//! `files`: several files of one mesh, as keyframes.

/// `files = "pose*.obj"` or a list, and `times`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct FilesSection {
    /// Paths, and patterns of the names of files with `*` and `?`, relative to the scene.
    pub files: Vec<String>,
    /// One for each file, increasing; left out, evenly over the clock.
    pub times: Option<Vec<f64>>,
}
