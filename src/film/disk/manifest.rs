//! What a folder says that it holds: of which film, of which mesh, and what must hold of it.

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
    /// Two films with the same fingerprint have the same frames.
    pub fingerprint: u32,
    /// How many frames it will have.
    pub frame_count: usize,
    /// What must hold on its last frame.
    pub checks: ChecksSection,
}

impl FilmSpec {
    /// The film of a scene.
    pub fn of(scene: &Scene) -> FilmSpec {
        FilmSpec {
            scene: scene.name.clone(),
            fingerprint: scene.simulation_fingerprint(),
            frame_count: scene.clock.frames,
            checks: scene.checks.clone(),
        }
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
    /// [`FilmSpec::fingerprint`].
    pub fingerprint: u32,
    /// How many frames the film will have.
    #[serde(deserialize_with = "possible_frame_count")]
    pub frame_count: usize,
    /// Counts of the mesh.
    #[serde(deserialize_with = "possible_counts")]
    pub mesh: MeshCounts,
    /// Checksum of `mesh.npz`.
    pub mesh_crc32: u32,
    /// What must hold on the last frame.
    pub checks: ChecksSection,
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
pub(super) const FORMAT: u32 = 1;
