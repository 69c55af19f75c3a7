//! The text of a scene file, or what the file is instead.

use std::io;
use std::path::Path;

use crate::scene::foreign::{folder_that_is_no_scene, foreign_content, foreign_ending};
use crate::text::decode;
use crate::whole_file::{self, ReadError};

/// Far more than any scene needs, and little enough to be read in a moment; what is longer is not a scene.
pub(super) const MOST_BYTES: u64 = 4 << 20;

/// The text of a file, else reason and remedy.
pub(in crate::scene) fn read_text(path: &Path) -> Result<String, (String, String)> {
    let unreadable = |reason: String, remedy: &str| Err((reason, remedy.to_owned()));
    if path.is_dir() {
        return Err(folder_that_is_no_scene(path));
    }
    // Of what ends otherwise the content does not matter, and may be large.
    let bytes = match (whole_file::read(path, MOST_BYTES), foreign_ending(path)) {
        (Ok(_) | Err(ReadError::TooLarge { .. }), Some(what)) => return Err(what),
        (Ok(bytes), None) => bytes,
        (Err(ReadError::Io(error)), _) if error.kind() == io::ErrorKind::NotFound => {
            return unreadable(
                "there is no such file".into(),
                "check the path; `immerse new NAME` writes a scene to start from",
            );
        }
        (Err(ReadError::Io(error)), _) => {
            return unreadable(format!("it cannot be read ({error})"), "name a scene file that you may read");
        }
        (Err(error @ ReadError::NoFile(_)), _) => {
            let remedy = "name a scene file; what comes out of a pipe can be saved as one";
            return unreadable(format!("it cannot be read: {error}"), remedy);
        }
        (Err(error @ ReadError::TooLarge { .. }), None) => {
            return unreadable(
                error.to_string(),
                "name a scene file, which is a short text; long lists belong into the files that it names",
            );
        }
    };
    if let Some(what) = foreign_content(path, &bytes) {
        return Err(what);
    }
    let text = decode(&bytes);
    match text.first_broken_line {
        Some(line) => unreadable(format!("line {line} is not UTF-8 text"), "save the file as UTF-8"),
        None => Ok(text.text.into()),
    }
}
