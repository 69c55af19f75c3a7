//! Why the folder of a film cannot be read or written.

use super::manifest::FORMAT;
use crate::advice::Advice;
use crate::evolve::UnfitFrame;
use std::io;
use std::path::{Path, PathBuf};

/// A file or folder of a film that is not as it must be.
#[derive(Debug, thiserror::Error)]
pub enum DiskError {
    /// The system refused.
    #[error("{}: cannot be {action} ({source}); {}", path.display(), self.remedy())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// "read", "written", …
        action: &'static str,
        /// What the system said.
        source: io::Error,
    },
    /// A file where the folder of a film belongs.
    #[error("{}: it is a file, and a film is a folder; {}", path.display(), self.remedy())]
    NotAFolder {
        /// The file.
        path: PathBuf,
        /// Which folder that may be.
        folder: String,
    },
    /// There is no manifest.
    #[error("{}: there is no film here; {}", path.display(), self.remedy())]
    NotAFilm {
        /// The folder.
        path: PathBuf,
    },
    /// The folder is another scene's.
    #[error("{}: this folder holds the film of {found}, and nothing was overwritten; {}", path.display(), self.remedy())]
    OtherScene {
        /// The folder.
        path: PathBuf,
        /// What it holds, in words.
        found: String,
    },
    /// The folder holds no film of the scene as it is now.
    #[error("{}: this folder does not hold the film of the scene as it is now; {}", path.display(), self.remedy())]
    Changed {
        /// The folder.
        path: PathBuf,
    },
    /// Another version of the program wrote it.
    #[error("{}: it has format {found}, this program reads format {FORMAT}; {}", path.display(), self.remedy())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: u64,
    },
    /// It is not there.
    #[error("{}: there is no such frame; {}", path.display(), self.remedy())]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// It is of the film as it was before the scene or the program changed.
    #[error("{}: this frame is of the film as it was before the scene changed; {}", path.display(), self.remedy())]
    Stale {
        /// The file.
        path: PathBuf,
    },
    /// It is not what was written.
    #[error("{}: it is damaged ({reason}); {}", path.display(), self.remedy())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How that was seen.
        reason: String,
        /// How to get it back.
        remedy: &'static str,
    },
    /// Another process writes there.
    #[error("{}: another process is at work in this folder ({holder}); {}", path.display(), self.remedy())]
    Busy {
        /// The folder.
        path: PathBuf,
        /// Who that is.
        holder: String,
    },
    /// A link where the program writes.
    #[error("{}: this link leads out of the folder of the film, and nothing was written; {}", path.display(), self.remedy())]
    LeadsOut {
        /// The link.
        path: PathBuf,
    },
    /// A frame that is not fit to be kept.
    #[error("frame {frame} was not written: {reason}")]
    Unfit {
        /// The frame.
        frame: usize,
        /// Why it is not.
        reason: UnfitFrame,
    },
}

/// How a damaged file is mended: everything can be made again from the scene, and what is whole is kept.
pub(super) const SIMULATE_AGAIN: &str = "run `immerse simulate` again, which makes it anew and keeps the rest";

impl Advice for DiskError {
    fn remedy(&self) -> String {
        match self {
            DiskError::Io { .. } => "check the path, permissions and free space".into(),
            DiskError::NotAFolder { folder, .. } => format!("name that, {folder}"),
            DiskError::NotAFilm { .. } => "simulate one first, or name the folder that holds manifest.json".into(),
            DiskError::OtherScene { .. } => {
                "name another folder with --out, or pass --restart to begin anew there".into()
            }
            DiskError::Changed { .. } => "run `immerse simulate` first, with the same scene and --set".into(),
            DiskError::Version { .. } => "use the program that wrote it, or pass --restart to begin anew".into(),
            DiskError::Missing { .. } => "simulate it first".into(),
            DiskError::Stale { .. } => "run `immerse simulate` again, which computes it anew".into(),
            DiskError::Damaged { remedy, .. } => (*remedy).to_owned(),
            DiskError::Busy { .. } => "try again when it is done, or name another folder with --out".into(),
            DiskError::LeadsOut { .. } => {
                "name the folder where the film is to be with --out, or remove the link".into()
            }
            DiskError::Unfit { reason, .. } => reason.remedy(),
        }
    }
}

impl DiskError {
    /// A file that is not what was written, and can be made again.
    pub(super) fn damaged(path: &Path, reason: impl Into<String>) -> DiskError {
        DiskError::Damaged { path: path.to_owned(), reason: reason.into(), remedy: SIMULATE_AGAIN }
    }

    /// Whether another input would help, rather than another machine or another try.
    pub fn is_fault_of_input(&self) -> bool {
        !matches!(self, DiskError::Io { .. } | DiskError::Unfit { .. } | DiskError::Busy { .. })
    }

    /// A scene's film is in renders/<name>, unless somebody said else, and files of a film are in its folder.
    pub(super) fn not_a_folder(path: &Path) -> DiskError {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let is_scene = path.extension().is_some_and(|ending| ending == "toml");
        let parents = path.ancestors().skip(1);
        let film = parents.take(2).find(|parent| parent.join("manifest.json").is_file());
        let folder = match film {
            Some(folder) if folder.as_os_str().is_empty() => "which is . here".to_owned(),
            Some(folder) => format!("which is {}", folder.display()),
            None if is_scene => format!("such as renders/{stem}, or what --out was"),
            None => "such as renders/NAME".to_owned(),
        };
        DiskError::NotAFolder { path: path.to_owned(), folder }
    }

    /// A file that could not be read or written.
    pub(crate) fn io(path: impl Into<PathBuf>, action: &'static str) -> impl FnOnce(io::Error) -> DiskError {
        let path = path.into();
        move |source| DiskError::Io { path, action, source }
    }
}
