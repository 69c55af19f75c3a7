//! What identifies what a scene asks of a simulation: a key of every section that decides it, with the files it names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::data::{BendingFrom, ChangeKind, FilesSection, LengthSource, Scene, StartFrom};
use crate::digest::{Digest, Key};
use crate::whole_file;

impl Scene {
    /// A path of the scene, seen from the working folder.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        self.folder.join(path)
    }

    /// A key of each section that decides positions, by its name: of what it says and of the bytes of the files it names.
    /// Comments, camera, lights, look, output and checks do not count. A file that cannot be read counts as empty; the
    /// section that wants it says so. Where all keys are as they were, so are the frames; where one is not, frames may be
    /// the same all the same, see [`Simulation::frame_keys`](crate::Simulation::frame_keys).
    pub fn section_keys(&self) -> BTreeMap<String, Key> {
        let cones = self.metric.changes.iter().filter_map(|change| match &change.kind {
            ChangeKind::Ricci(ricci) => ricci.csv.as_ref(),
            ChangeKind::Conformal { .. } => None,
        });
        let keys = self.metric.keys.iter().map(|key| &key.lengths);
        let lengths = std::iter::once(&self.metric.lengths).chain(keys).filter_map(|source| match source {
            LengthSource::Csv(path) | LengthSource::File(path) => Some(path),
            _ => None,
        });
        // A pattern that cannot be looked up counts as no files; the section that wants it says so.
        let several = |section: Option<&FilesSection>| {
            section.and_then(|section| self.sequence(section).ok()).unwrap_or_default()
        };
        let poses = several(self.metric.files.as_ref());
        let bent = several(self.bending.as_ref().and_then(|bending| match &bending.from {
            Some(BendingFrom::Files(section)) => Some(section),
            _ => None,
        }));
        let start = if let StartFrom::File(path) = &self.start.from { Some(path) } else { None };
        let bending = self.bending.as_ref().and_then(|bending| match &bending.from {
            Some(BendingFrom::File(path)) => Some(path),
            _ => None,
        });
        let sections = [
            ("mesh", self.with_files(Digest::of("mesh").shown(&self.mesh).shown(&self.weld), self.mesh.file())),
            ("parameters", Digest::of("parameters").shown(&self.parameters)),
            ("metric", self.with_files(Digest::of("metric").shown(&self.metric), lengths.chain(cones).chain(&poses))),
            ("spin", Digest::of("spin").shown(&self.spin)),
            ("start", self.with_files(Digest::of("start").shown(&self.start), start)),
            ("phase", Digest::of("phase").shown(&self.phases)),
            (
                "bending",
                self.with_files(
                    Digest::of("bending").shown(&self.bending).shown(&self.relaxation),
                    bending.into_iter().chain(&bent),
                ),
            ),
            ("pin", Digest::of("pin").shown(&self.pins)),
            ("clock", Digest::of("clock").shown(&self.clock)),
            ("polish", Digest::of("polish").shown(&self.polish)),
        ];
        sections.into_iter().map(|(name, digest)| (name.to_owned(), digest.finish())).collect()
    }

    fn with_files<'a>(&self, digest: Digest, files: impl IntoIterator<Item = &'a PathBuf>) -> Digest {
        let of_file =
            |path: &PathBuf| Key::of_bytes(&whole_file::read(&self.resolve(path), u64::MAX).unwrap_or_default());
        files.into_iter().map(of_file).fold(digest, Digest::key)
    }
}
