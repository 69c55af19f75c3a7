//! What identifies a simulation: the sections that decide it, and the files they name.

use std::path::{Path, PathBuf};

use super::data::{BendingFrom, ChangeKind, LengthSource, Scene, StartFrom};

impl Scene {
    /// A path of the scene, seen from the working folder.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        self.folder.join(path)
    }

    /// Identifies what is simulated: all sections that decide positions, and the bytes of the files they
    /// name. Comments, camera, lights, look, output and checks do not count. A file that cannot be read
    /// counts as empty; the mesh or metric that wants it says so.
    pub fn simulation_fingerprint(&self) -> u32 {
        let sections = (&self.mesh, &self.parameters, &self.metric, &self.spin, &self.start, &self.phases);
        let relaxation = &self.relaxation;
        let more = (&self.bending, &self.pins, &self.clock);
        let mut hasher = crc32fast::Hasher::new();
        hasher.update(format!("{sections:?}{more:?}{relaxation:?}").as_bytes());
        self.weld.iter().for_each(|weld| hasher.update(format!("{weld:?}").as_bytes()));
        for path in self.files() {
            hasher.update(&std::fs::read(self.resolve(path)).unwrap_or_default());
        }
        hasher.finalize()
    }

    /// The files that the scene names.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        let keys = self.metric.keys.iter().map(|key| &key.lengths);
        let lengths = std::iter::once(&self.metric.lengths).chain(keys).filter_map(|source| match source {
            LengthSource::Csv(path) | LengthSource::File(path) => Some(path),
            _ => None,
        });
        let cones = self.metric.changes.iter().filter_map(|change| match &change.kind {
            ChangeKind::Ricci(ricci) => ricci.csv.as_ref(),
            ChangeKind::Conformal { .. } => None,
        });
        let start = if let StartFrom::File(path) = &self.start.from { Some(path) } else { None };
        let bending = self.bending.as_ref().and_then(|bending| match &bending.from {
            Some(BendingFrom::File(path)) => Some(path),
            _ => None,
        });
        self.mesh.file().into_iter().chain(lengths).chain(cones).chain(start).chain(bending)
    }
}
