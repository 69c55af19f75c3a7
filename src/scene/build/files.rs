//! `files` as keyframes: which files, what they say, and when.

use std::path::{Path, PathBuf};

use super::clock::clock_of;
use crate::mesh::{MOST_KEYFRAMES, Mesh, MeshError};
use crate::scene::{FilesSection, Scene, SceneError};
use crate::timeline::Clock;

impl Scene {
    /// The times of the keyframes in the files that a section names, and what `read` finds in these. A file has one, or as many as it
    /// has frames. In a film that loops, without times of their own, the first one comes again at the end.
    pub(super) fn keyframes_of_files<T: Clone>(
        &self,
        section: &str,
        files: &FilesSection,
        mesh: &Mesh,
        read: impl Fn(&Path) -> Result<Vec<T>, MeshError>,
    ) -> Result<(Vec<f64>, Vec<T>), SceneError> {
        let key = format!("{section}.files");
        let found = self.sequence(files).map_err(|(reason, remedy)| self.complain(&key, reason, remedy))?;
        let paths: Vec<PathBuf> = found.iter().map(|path| self.resolve(path)).collect();
        let mut values = Vec::new();
        for path in &paths {
            values.extend(read(path).map_err(|error| self.complain_about(&key, &error))?);
            if values.len() > MOST_KEYFRAMES {
                let reason = format!("there are more than {MOST_KEYFRAMES} keyframes in these files");
                return Err(self.complain(&key, reason, "take fewer of them; what is between is interpolated"));
            }
        }
        let count = values.len();
        let what = if count == paths.len() { "files" } else { "frames of files" };
        let times = match &files.times {
            Some(times) if times.len() != count => {
                let reason = format!("there are {} times for {count} {what}", times.len());
                return Err(self.complain(&format!("{section}.times"), reason, "give one for each of them, or none"));
            }
            Some(times) => times.clone(),
            None => {
                let clock = clock_of(self, mesh)?;
                if clock.frames == 1 && count > 1 {
                    let reason = format!("{count} {what} are spread over the clock, which has one frame");
                    let remedy = format!("write frames = {count} or more under [clock], or `times`");
                    return Err(self.complain(&key, reason, remedy));
                }
                let times = Clock::new(count, [clock.start, clock.end], clock.looping);
                let times = times.map_err(|error| self.complain_about("clock", &error))?;
                if clock.looping && count > 1 {
                    values.extend(values.first().cloned());
                    times.times().chain([clock.end]).collect()
                } else {
                    times.times().collect()
                }
            }
        };
        Ok((times, values))
    }
}
