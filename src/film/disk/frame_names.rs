//! Which files of a folder are those of frames.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::DiskError;

/// The files of frames, records (.json) before states: a frame without a record is not done.
pub(super) fn frame_files(folder: &Path) -> Result<Vec<PathBuf>, DiskError> {
    let frames = folder.join("frames");
    let mut files = Vec::new();
    if frames.is_dir() {
        for entry in fs::read_dir(&frames).map_err(DiskError::io(&frames, "read"))? {
            let path = entry.map_err(DiskError::io(&frames, "read"))?.path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if frame_number(&path).is_some() && matches!(ending, Some("json" | "npz")) {
                files.push(path);
            }
        }
    }
    files.sort_by_key(|path| (path.extension().map(ToOwned::to_owned), path.clone()));
    Ok(files)
}

pub(super) fn frame_number(path: &Path) -> Option<usize> {
    let stem = path.file_stem()?.to_str()?;
    (stem.len() == 6 && stem.bytes().all(|b| b.is_ascii_digit())).then(|| stem.parse().ok()).flatten()
}
