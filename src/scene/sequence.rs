//! Which files a pattern means, and in which order: numbers in names count as numbers.

use std::cmp::Ordering;
use std::fs;
use std::path::{Path, PathBuf};

use super::data::{FilesSection, Scene};
use crate::mesh::MOST_KEYFRAMES;

/// Why there are no files: reason and remedy.
type NoFiles = (String, String);

impl Scene {
    /// The files that `files` means, in order, relative to the scene. Patterns are looked up in their folders.
    pub(super) fn sequence(&self, section: &FilesSection) -> Result<Vec<PathBuf>, NoFiles> {
        let mut files = Vec::new();
        for text in &section.files {
            let path = Path::new(text);
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            if !name.contains(['*', '?']) {
                if text.contains(['*', '?']) {
                    let reason = format!("`{text}` has * or ? in the name of a folder");
                    return Err((reason, "write patterns of names in one folder only, or a list".into()));
                }
                files.push(path.to_owned());
                continue;
            }
            let folder = path.parent().unwrap_or(Path::new(""));
            let found = self.matching(folder, &name).map_err(|error| {
                let remedy = "check the folder, which is relative to the scene";
                (format!("the folder of `{text}` cannot be read: {error}"), remedy.to_owned())
            })?;
            if found.is_empty() {
                let remedy = "check the folder, which is relative to the scene, and the ending";
                return Err((format!("no file matches `{text}`"), remedy.into()));
            }
            files.extend(found);
        }
        if files.len() > MOST_KEYFRAMES {
            let reason = format!("there are {} files, {MOST_KEYFRAMES} are the limit", files.len());
            return Err((reason, "take fewer of them; what is between is interpolated".into()));
        }
        Ok(files)
    }

    /// Files of a folder whose names match a pattern. Hidden ones match none that does not begin with a point, too.
    fn matching(&self, folder: &Path, pattern: &str) -> std::io::Result<Vec<PathBuf>> {
        let here = self.resolve(folder);
        let here = if here.as_os_str().is_empty() { Path::new(".") } else { &here };
        let mut names = Vec::new();
        for entry in fs::read_dir(here)? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with('.') == pattern.starts_with('.') && matches(pattern, &name) && entry.path().is_file() {
                names.push(name);
            }
        }
        names.sort_by(|a, b| in_order(a, b));
        Ok(names.into_iter().map(|name| folder.join(name)).collect())
    }
}

/// Whether a name is what a pattern says, in which `*` stands for any characters and `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // Where the last star stands, and how far it reaches.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(&c) if c == '?' || c == name[n] => (p, n) = (p + 1, n + 1),
            _ => {
                let Some((at, reach)) = star else { return false };
                star = Some((at, reach + 1));
                (p, n) = (at + 1, reach + 1);
            }
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

/// Pose 2 comes before pose 10. Names that differ in zeros before a number only are in order of characters.
fn in_order(a: &str, b: &str) -> Ordering {
    let by_parts = parts(a).into_iter().map(Some).chain([None]);
    let others = parts(b).into_iter().map(Some).chain([None]);
    by_parts.cmp(others).then_with(|| a.cmp(b))
}

/// Numbers by the count of their digits and these, everything else by characters.
fn parts(name: &str) -> Vec<(usize, String)> {
    let chars: Vec<char> = name.chars().collect();
    let runs = chars.chunk_by(|a, b| a.is_ascii_digit() && b.is_ascii_digit());
    runs.map(|run| {
        let text: String = run.iter().collect();
        if !run[0].is_ascii_digit() {
            return (usize::MAX, text);
        }
        let digits = text.trim_start_matches('0').to_owned();
        (digits.len(), digits)
    })
    .collect()
}
