//! The formats of mesh files.

use std::path::Path;
use std::sync::LazyLock;

/// A format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY, ascii or binary.
    Ply,
    /// Object File Format.
    Off,
    /// Stereolithography, ascii or binary: lists of corners, whose vertices have no numbers.
    Stl,
    /// FOLD 1.2, of origami.
    Fold,
    /// An archive of NumPy with an array of faces.
    Npz,
    /// An array of faces.
    Npy,
}

impl FileFormat {
    /// All of them.
    pub const ALL: [FileFormat; 7] = [
        FileFormat::Obj,
        FileFormat::Ply,
        FileFormat::Off,
        FileFormat::Stl,
        FileFormat::Fold,
        FileFormat::Npz,
        FileFormat::Npy,
    ];

    /// What its files end in, in small letters and without the point.
    pub const fn ending(self) -> &'static str {
        match self {
            FileFormat::Obj => "obj",
            FileFormat::Ply => "ply",
            FileFormat::Off => "off",
            FileFormat::Stl => "stl",
            FileFormat::Fold => "fold",
            FileFormat::Npz => "npz",
            FileFormat::Npy => "npy",
        }
    }

    /// The format of a file by its ending, in small or capital letters; `None` if no format has this ending.
    pub fn of(path: &Path) -> Option<FileFormat> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        FileFormat::ALL.into_iter().find(|format| format.ending() == ending)
    }

    /// The number of the first vertex and of the first face in its files.
    pub(super) fn counts_from(self) -> u32 {
        u32::from(self == FileFormat::Obj)
    }

    /// The names of all formats, as in a sentence.
    pub fn names() -> &'static str {
        static NAMES: LazyLock<String> = LazyLock::new(|| listed(|format| format.ending().to_uppercase()));
        &NAMES
    }

    /// The endings of all formats with their points, as in a sentence.
    pub fn endings() -> &'static str {
        static ENDINGS: LazyLock<String> = LazyLock::new(|| listed(|format| format!(".{}", format.ending())));
        &ENDINGS
    }
}

/// The formats, with commas between them and an "or" before the last one.
fn listed(word: impl Fn(FileFormat) -> String) -> String {
    let words = FileFormat::ALL.map(word);
    let [others @ .., last] = &words;
    format!("{} or {last}", others.join(", "))
}
