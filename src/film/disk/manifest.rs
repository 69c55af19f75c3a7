//! What a folder says that it holds: of which film, of which mesh, and what must hold of it.

use std::collections::BTreeMap;

use crate::digest::Key;
use crate::evolve::ALGORITHM;
use crate::mesh::{MOST_FACES, Mesh};
use crate::scene::{ChecksSection, Scene};
use crate::timeline::Clock;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// What a film is of.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSpec {
    /// Name of the scene, for messages.
    pub scene: String,
    /// [`Scene::section_keys`].
    pub sections: BTreeMap<String, Key>,
    /// [`Simulation::frame_keys`](crate::Simulation::frame_keys), one per frame: frames with the same key are the same.
    pub keys: Vec<Key>,
    /// What must hold on its last frame.
    pub checks: ChecksSection,
    /// The text of the scene, which is kept with the film; empty if it was made in code.
    pub text: String,
}

impl FilmSpec {
    /// The film of a scene, whose frames have these keys.
    pub fn of(scene: &Scene, keys: Vec<Key>) -> FilmSpec {
        FilmSpec::of_sections(scene, scene.section_keys(), keys)
    }

    /// The same, with sections whose files need not be read again.
    pub(super) fn of_sections(scene: &Scene, sections: BTreeMap<String, Key>, keys: Vec<Key>) -> FilmSpec {
        let (scene, checks, text) = (scene.name.clone(), scene.checks.clone(), scene.source.text().to_owned());
        FilmSpec { scene, sections, keys, checks, text }
    }
}

/// How large the mesh is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshCounts {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of faces.
    pub faces: usize,
    /// Sum of the genera of the components.
    pub genus: usize,
    /// Number of boundary loops.
    pub boundaries: usize,
}

impl MeshCounts {
    /// Counts a mesh.
    pub fn of(mesh: &Mesh) -> MeshCounts {
        MeshCounts {
            vertices: mesh.vertex_count(),
            edges: mesh.edge_count(),
            faces: mesh.face_count(),
            genus: mesh.genus(),
            boundaries: mesh.boundary_loops().len(),
        }
    }
}

/// `manifest.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of all files in the folder.
    pub format: u32,
    /// Name of the scene.
    pub scene: String,
    /// Version of the program and [`ALGORITHM`], by which the keys were found.
    pub program: String,
    /// [`FilmSpec::sections`].
    pub sections: BTreeMap<String, Key>,
    /// How many frames the film will have.
    #[serde(deserialize_with = "possible_frame_count")]
    pub frame_count: usize,
    /// Counts of the mesh.
    #[serde(deserialize_with = "possible_counts")]
    pub mesh: MeshCounts,
    /// SHA-256 of `mesh.npz`.
    pub mesh_sha256: Key,
    /// What must hold on the last frame.
    pub checks: ChecksSection,
    /// [`FilmSpec::keys`].
    pub keys: Vec<Key>,
}

impl Manifest {
    /// Of a film on a mesh with this checksum.
    pub(super) fn of(spec: &FilmSpec, mesh: MeshCounts, mesh_sha256: Key) -> Manifest {
        Manifest {
            format: FORMAT,
            scene: spec.scene.clone(),
            program: program(),
            sections: spec.sections.clone(),
            frame_count: spec.keys.len(),
            mesh,
            mesh_sha256,
            checks: spec.checks.clone(),
            keys: spec.keys.clone(),
        }
    }

    /// The keys of the film of a scene, if this is the same film already and nobody has to find them.
    pub(super) fn keys_for(&self, sections: &BTreeMap<String, Key>) -> Option<&[Key]> {
        (self.program == program() && self.sections == *sections).then_some(&*self.keys)
    }

    /// Whether this is the film of a scene as it is now, whatever it is called, what it checks and how it looks.
    pub fn is_of(&self, scene: &Scene) -> bool {
        self.keys_for(&scene.section_keys()).is_some()
    }

    /// What has changed since, in words: names of sections, or the way in which frames are computed.
    pub(super) fn changes_to(&self, other: &Manifest) -> Vec<String> {
        let differs = |name: &&String| self.sections.get(*name) != other.sections.get(*name);
        let sections = other.sections.keys().filter(differs).map(|name| format!("[{name}]"));
        let program = (self.program != other.program).then(|| "the program".to_owned());
        sections.chain(program).collect()
    }
}

/// What finds the keys of frames.
fn program() -> String {
    format!("immerse {}, algorithm {ALGORITHM}", env!("CARGO_PKG_VERSION"))
}

/// A number of frames that a film can have: whoever wrote another one, memory is asked for by it.
fn possible_frame_count<'de, D: Deserializer<'de>>(deserializer: D) -> Result<usize, D::Error> {
    let frames = usize::deserialize(deserializer)?;
    if (1..=Clock::MOST_FRAMES).contains(&frames) {
        return Ok(frames);
    }
    Err(D::Error::custom(format!("it says that there are {frames} frames, and a film has 1 to {}", Clock::MOST_FRAMES)))
}

/// Counts that a mesh can have.
fn possible_counts<'de, D: Deserializer<'de>>(deserializer: D) -> Result<MeshCounts, D::Error> {
    let counts = MeshCounts::deserialize(deserializer)?;
    let corners = 3 * counts.faces.min(MOST_FACES);
    if counts.faces > MOST_FACES || counts.vertices > corners || counts.edges > corners {
        let MeshCounts { vertices, edges, faces, .. } = counts;
        let reason = format!("it says that there are {vertices} vertices, {edges} edges and {faces} faces");
        return Err(D::Error::custom(reason));
    }
    Ok(counts)
}

/// Version of all files in the folder. Raised when their meaning changes.
pub(super) const FORMAT: u32 = 2;
