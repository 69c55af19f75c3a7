//! From faces as found in files to a [`Mesh`]: orients, compacts, and says what it did.

use super::faults::{Faults, Orientable, orient};
use super::limits::check_size;
use super::{Mesh, MeshError, VertexId};

/// A mesh and what had to be changed to get it.
#[derive(Clone, Debug)]
pub struct Repaired {
    /// The oriented mesh. Faces keep their order.
    pub mesh: Mesh,
    /// Per vertex of the mesh: its number in the input. Increasing.
    pub input_vertices: Vec<usize>,
    /// Per vertex of the input: its number in the mesh, or `None` where no face names it.
    pub vertex_map: Vec<Option<VertexId>>,
    /// One sentence per kind of change, for a report. Empty if the input was a valid mesh.
    pub repairs: Vec<String>,
}

/// Makes a [`Mesh`] of vertex triples: drops vertices that belong to no face, and orients each
/// component consistently, keeping the orientation that most of its faces have (of the first face, if
/// they are equally many).
///
/// # Errors
/// [`MeshError`] for what cannot be repaired: no faces, vertices out of range, degenerate or duplicate
/// faces (same corners in any order), non-manifold edges or vertices, components that cannot be oriented. One fault
/// is an error of its own kind, several are [`MeshError::Several`]. Numbers in errors are those of the input.
pub fn repair(vertex_count: usize, faces: &[[u32; 3]]) -> Result<Repaired, MeshError> {
    check_size(vertex_count, faces.len())?;
    let first: Vec<u32> = (0..vertex_count as u32).collect();
    repair_welded(vertex_count, faces, &first).map_err(Unrepairable::into_error)
}

/// Why there is no mesh.
pub(super) enum Unrepairable {
    /// There is nothing, or too much to look at.
    Size(MeshError),
    /// What is wrong with the faces.
    Faults(Faults),
}

impl Unrepairable {
    pub fn into_error(self) -> MeshError {
        match self {
            Unrepairable::Size(error) => error,
            Unrepairable::Faults(faults) => faults.into_error(),
        }
    }
}

/// As [`repair`], of vertices each of which is one with the vertex `first` of it, which faces name in its place.
pub(super) fn repair_welded(vertex_count: usize, faces: &[[u32; 3]], first: &[u32]) -> Result<Repaired, Unrepairable> {
    check_size(vertex_count, faces.len()).map_err(Unrepairable::Size)?;
    let Orientable { reversed, components, .. } = orient(vertex_count, faces).map_err(Unrepairable::Faults)?;
    let mut repairs = Vec::new();
    let count = reversed.iter().filter(|reverse| **reverse).count();
    if count > 0 {
        let plural = if components == 1 { "" } else { "s" };
        repairs.push(format!(
            "reversed {count} of {} faces, in {components} component{plural}, so that neighbours agree in orientation",
            faces.len(),
        ));
    }

    let mut used = vec![false; vertex_count];
    for v in faces.iter().flatten() {
        used[*v as usize] = true;
    }
    let input_vertices: Vec<usize> = (0..vertex_count).filter(|&v| used[v]).collect();
    let mut vertex_map = vec![None; vertex_count];
    for (new, &old) in input_vertices.iter().enumerate() {
        vertex_map[old] = Some(VertexId::new(new));
    }
    for v in 0..vertex_count {
        vertex_map[v] = vertex_map[first[v] as usize];
    }
    let dropped = vertex_map.iter().filter(|v| v.is_none()).count();
    if let Some(first) = vertex_map.iter().position(Option::is_none) {
        let subject = if dropped == 1 { "vertex that belongs" } else { "vertices that belong" };
        repairs.push(format!("dropped {dropped} {subject} to no face (the first is vertex {first})"));
    }

    let compact = |v: u32| vertex_map[v as usize].map_or(0, |v: VertexId| v.0);
    let oriented: Vec<[u32; 3]> = faces
        .iter()
        .zip(&reversed)
        .map(|(&[a, b, c], &reverse)| if reverse { [a, c, b] } else { [a, b, c] }.map(compact))
        .collect();
    let mesh = Mesh::from_faces(input_vertices.len(), &oriented).map_err(Unrepairable::Size)?;
    Ok(Repaired { mesh, input_vertices, vertex_map, repairs })
}
