//! What a folder says that it holds: of which film, of which mesh, and what must hold of it.

use std::collections::BTreeMap;

use crate::digest::Key;
use crate::evolve::ALGORITHM;
use crate::mesh::Mesh;
use crate::scene::{ChecksSection, Scene};
use serde::{Deserialize, Serialize};

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
}

impl FilmSpec {
    /// The film of a scene, whose frames have these keys.
    pub fn of(scene: &Scene, keys: Vec<Key>) -> FilmSpec {
        FilmSpec { scene: scene.name.clone(), sections: scene.section_keys(), keys, checks: scene.checks.clone() }
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
    pub frame_count: usize,
    /// Counts of the mesh.
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

/// Version of all files in the folder. Raised when their meaning changes.
pub(super) const FORMAT: u32 = 2;
