//! `files` as keyframes: which files, and when.

use std::path::PathBuf;

use super::clock::clock_of;
use crate::mesh::Mesh;
use crate::scene::{FilesSection, Scene, SceneError};
use crate::timeline::Clock;

impl Scene {
    /// The times of the files that a section names, and their paths. In a film that loops, without times of their own, the first
    /// one comes again at the end.
    pub(super) fn keyframe_files(
        &self,
        section: &str,
        files: &FilesSection,
        mesh: &Mesh,
    ) -> Result<(Vec<f64>, Vec<PathBuf>), SceneError> {
        let key = format!("{section}.files");
        let found = self.sequence(files).map_err(|(reason, remedy)| self.complain(&key, reason, remedy))?;
        let mut paths: Vec<PathBuf> = found.iter().map(|path| self.resolve(path)).collect();
        let count = paths.len();
        let times = match &files.times {
            Some(times) if times.len() != count => {
                let reason = format!("there are {} times for {count} files", times.len());
                return Err(self.complain(&format!("{section}.times"), reason, "give one for each file, or none"));
            }
            Some(times) => times.clone(),
            None => {
                let clock = clock_of(self, mesh)?;
                if clock.frames == 1 && count > 1 {
                    let reason = format!("{count} files are spread over the clock, which has one frame");
                    let remedy = format!("write frames = {count} or more under [clock], or `times`");
                    return Err(self.complain(&key, reason, remedy));
                }
                let times = Clock::new(count, [clock.start, clock.end], clock.looping);
                let times = times.map_err(|error| self.complain_about("clock", &error))?;
                if clock.looping && count > 1 {
                    paths.extend(paths.first().cloned());
                    times.times().chain([clock.end]).collect()
                } else {
                    times.times().collect()
                }
            }
        };
        Ok((times, paths))
    }
}
