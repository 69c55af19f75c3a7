//! `[mesh]` as a validated surface.

use crate::mesh::{MeshError, Surface, read_welded};
use crate::scene::{MeshSection, Scene, SceneError};

impl Scene {
    /// The surface of the scene: read from its file, with the seams welded as the scene says, or generated.
    ///
    /// # Errors
    /// [`SceneError`] for a file that cannot be read or is no oriented surface, and for parameters that no surface has. It
    /// points at the line that names the file, with the file's own numbers in its reason, or at the parameter.
    pub fn surface(&self) -> Result<Surface, SceneError> {
        let surface = match &self.mesh {
            MeshSection::File(path) => read_welded(&self.resolve(path), self.weld),
            MeshSection::Shape(shape) => shape.surface(),
        };
        surface.map_err(|error| self.complain_about(&key(&error), &error))
    }
}

/// The key that is at fault.
fn key(error: &MeshError) -> String {
    match error {
        MeshError::Shape(shape) => format!("mesh.{}", shape.parameter),
        error if error.is_of_file() => "mesh.file".to_owned(),
        _ => "mesh".to_owned(),
    }
}
