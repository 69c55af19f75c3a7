//! What is in a folder, and what differs between two.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The bytes of all files by their paths, hidden ones included.
#[derive(PartialEq)]
pub struct Contents(BTreeMap<String, Vec<u8>>);

impl Contents {
    /// Of a folder.
    pub fn of(folder: &Path) -> Contents {
        let mut files = BTreeMap::new();
        gather(folder, "", &mut files);
        Contents(files)
    }

    /// In a sentence each, what of these files is missing or other there.
    pub fn differences(&self, other: &Contents) -> Vec<String> {
        let names = self.0.keys().chain(other.0.keys().filter(|name| !self.0.contains_key(*name)));
        let difference = |name: &String| match (self.0.get(name), other.0.get(name)) {
            (Some(_), None) => Some(format!("{name} is missing")),
            (None, Some(_)) => Some(format!("{name} is too many")),
            (one, two) if one != two => Some(format!("{name} has other bytes")),
            _ => None,
        };
        names.filter_map(difference).collect()
    }

    /// How many files there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }
}

fn gather(folder: &Path, prefix: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        if path.is_dir() {
            gather(&path, &format!("{prefix}{name}/"), files);
        } else {
            files.insert(format!("{prefix}{name}"), fs::read(&path).expect("a file"));
        }
    }
}
