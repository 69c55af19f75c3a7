//! What an engine is given.

/// Job files, and how they are started.
pub(super) struct Written {
    /// Names and texts of files.
    pub files: Vec<(String, String)>,
    /// The command that starts the job, with the folder of the files in the place of `{}`.
    pub start: String,
}
