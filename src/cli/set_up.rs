//! From a scene to a simulation, with what is worth saying of it.

use std::path::{Component, Path, PathBuf};

use glam::DVec3;

use super::failure::{Failure, PipelineError};
use crate::digest::Key;
use crate::evolve::{EvolveError, Simulation};
use crate::film::FilmMesh;
use crate::mesh::shapes::Shape;
use crate::scene::{MeshSection, Scene, clock_of};

/// A simulation, and what was known of its surface before.
pub(super) struct SetUp {
    pub simulation: Simulation,
    /// What x, y and z of each vertex mean in the scene, |V|: positions or coordinates of the mesh, if it has any.
    pub places: Option<Vec<DVec3>>,
    /// What had to be repaired in the mesh, and what else is worth saying.
    pub notes: Vec<String>,
}

impl SetUp {
    /// What is kept of the surface beside the frames of its film.
    pub fn film_mesh(&self, scene: &Scene) -> FilmMesh {
        let lattice = match scene.mesh {
            MeshSection::Shape(Shape::FlatTorus { a, b, .. }) => Some([a, b]),
            _ => None,
        };
        FilmMesh {
            mesh: self.simulation.mesh().clone(),
            places: self.places.clone(),
            pins: self.simulation.pinned().to_vec(),
            lattice,
        }
    }

    /// Of a scene; what is at fault is shown where the scene names it.
    pub fn of(scene: &Scene) -> Result<SetUp, PipelineError> {
        let surface = scene.surface()?;
        let places = surface.places().map(<[DVec3]>::to_vec);
        let mut notes = surface.repairs.clone();
        let simulation = scene.simulation_of(surface)?;
        let of_metric = simulation.metric_program().notes();
        notes.extend(of_metric.into_iter().map(|(change, note)| format!("metric.change[{change}]: {note}")));
        Ok(SetUp { simulation, places, notes })
    }
}

/// The folder of a film among those of others, which is called as the scene is. `path` is the scene's file.
pub(super) fn folder_of(scene: &Scene, path: &Path, films: &Path) -> Result<PathBuf, Failure> {
    let mut parts = Path::new(&scene.name).components();
    match (parts.next(), parts.next()) {
        (Some(Component::Normal(_)), None) => Ok(films.join(&scene.name)),
        _ => Err(Failure::Name { path: path.to_owned() }),
    }
}

/// The scene in a file, with keys that were set beside it, with the mesh of the command line if there is one, and with as many
/// frames as it has.
pub(super) fn read_scene(path: &Path, mesh: Option<&Path>, settings: &[String]) -> Result<Scene, PipelineError> {
    let mut scene = Scene::read_with(path, settings)?;
    if let Some(mesh) = mesh {
        // Paths of a scene start in its folder, those of a command line where it is typed.
        scene.mesh = MeshSection::File(std::path::absolute(mesh).unwrap_or_else(|_| mesh.to_owned()));
    }
    count_classes(&mut scene)?;
    Ok(scene)
}

/// Counts the classes of a scene that has a frame for each of them, so that everybody knows how many frames there are.
fn count_classes(scene: &mut Scene) -> Result<(), PipelineError> {
    if scene.clock.a_frame_for_each_class {
        scene.clock = clock_of(scene, &scene.surface()?.mesh)?;
    }
    Ok(())
}

/// An error of a running simulation, shown where the scene names what is at fault, if it does.
pub(super) fn at_fault(scene: &Scene, error: EvolveError) -> PipelineError {
    match scene.fault(&error) {
        Some(mistake) => mistake.into(),
        None => error.into(),
    }
}

/// The keys of all frames. Finds what a simulation would end with half way: times at which there is no metric, no place for
/// a pin, or no way from one frame to the next.
pub(super) fn frame_keys(scene: &Scene, simulation: &mut Simulation) -> Result<Vec<Key>, PipelineError> {
    simulation.frame_keys().map_err(|error| at_fault(scene, error))
}

/// Warnings about pins that no surface with these lengths can keep.
pub(super) fn contradictions(scene: &Scene, simulation: &Simulation) -> Result<Vec<String>, PipelineError> {
    simulation.pin_contradictions().map_err(|error| at_fault(scene, error))
}
