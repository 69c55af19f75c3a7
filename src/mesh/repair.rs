//! From faces as found in files to a [`Mesh`]: orients, compacts, and says what it did.

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
/// [`MeshError`] for what cannot be repaired: no faces, a vertex out of range, degenerate or duplicate
/// faces (same corners in any order), non-manifold edges or vertices, a surface that cannot be oriented.
/// Numbers in errors are those of the input.
pub fn repair(vertex_count: usize, faces: &[[u32; 3]]) -> Result<Repaired, MeshError> {
    check_faces(vertex_count, faces)?;
    let pairs = adjacent_faces(faces)?;
    let (reversed, mut repairs) = orientation(faces, &pairs)?;

    let mut used = vec![false; vertex_count];
    for v in faces.iter().flatten() {
        used[*v as usize] = true;
    }
    let input_vertices: Vec<usize> = (0..vertex_count).filter(|&v| used[v]).collect();
    let mut vertex_map = vec![None; vertex_count];
    for (new, &old) in input_vertices.iter().enumerate() {
        vertex_map[old] = Some(VertexId::new(new));
    }
    if input_vertices.len() < vertex_count {
        let first = used.iter().position(|&u| !u).unwrap_or(0);
        let count = vertex_count - input_vertices.len();
        let subject = if count == 1 { "vertex that belongs" } else { "vertices that belong" };
        repairs.push(format!("dropped {count} {subject} to no face (the first is vertex {first})"));
    }

    let compact = |v: u32| vertex_map[v as usize].map_or(0, |v: VertexId| v.0);
    let oriented: Vec<[u32; 3]> = faces
        .iter()
        .zip(&reversed)
        .map(|(&[a, b, c], &reverse)| if reverse { [a, c, b] } else { [a, b, c] }.map(compact))
        .collect();
    let mesh = Mesh::from_faces(input_vertices.len(), &oriented).map_err(|error| match error {
        // The only thing left that can be wrong.
        MeshError::NonManifoldVertex { vertex } => MeshError::NonManifoldVertex { vertex: input_vertices[vertex] },
        other => other,
    })?;
    Ok(Repaired { mesh, input_vertices, vertex_map, repairs })
}

fn check_faces(vertex_count: usize, faces: &[[u32; 3]]) -> Result<(), MeshError> {
    if faces.is_empty() {
        return Err(MeshError::Empty);
    }
    // Halfedges are numbered with 32 bits, one number being taken for "none".
    let limit = u32::MAX as usize / 3 - 1;
    if faces.len() > limit || vertex_count > u32::MAX as usize - 1 {
        return Err(MeshError::TooLarge { faces: faces.len(), vertices: vertex_count, limit });
    }
    for (face, &corners) in faces.iter().enumerate() {
        let [a, b, c] = corners;
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertex_count) {
            return Err(MeshError::VertexOutOfRange { face, vertex: vertex.into(), vertex_count });
        }
        if a == b || b == c || c == a {
            return Err(MeshError::DegenerateFace { face, corners });
        }
    }
    let mut sorted: Vec<([u32; 3], usize)> = faces
        .iter()
        .enumerate()
        .map(|(f, &corners)| {
            let mut key = corners;
            key.sort_unstable();
            (key, f)
        })
        .collect();
    sorted.sort_unstable();
    match sorted.windows(2).filter(|w| w[0].0 == w[1].0).min_by_key(|w| w[1].1) {
        Some(twice) => Err(MeshError::DuplicateFace { faces: [twice[0].1, twice[1].1] }),
        None => Ok(()),
    }
}

/// Two faces with a common edge.
struct Pair {
    faces: [usize; 2],
    edge: [u32; 2],
    /// Both run along the edge in the same direction, so one of them has to be reversed.
    clash: bool,
}

/// All interior edges, sorted by their vertices.
fn adjacent_faces(faces: &[[u32; 3]]) -> Result<Vec<Pair>, MeshError> {
    let mut sides: Vec<([u32; 2], usize, bool)> = Vec::with_capacity(3 * faces.len());
    for (f, corners) in faces.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push(([a.min(b), a.max(b)], f, a < b));
        }
    }
    sides.sort_unstable();
    sides
        .chunk_by(|s, t| s.0 == t.0)
        .filter(|group| group.len() > 1)
        .map(|group| match *group {
            [(edge, f, up), (_, g, also_up)] => Ok(Pair { faces: [f, g], edge, clash: up == also_up }),
            _ => Err(MeshError::NonManifoldEdge { edge: group[0].0, faces: group.iter().map(|s| s.1).collect() }),
        })
        .collect()
}

/// Which faces to reverse, and a sentence about it if there are any.
fn orientation(faces: &[[u32; 3]], pairs: &[Pair]) -> Result<(Vec<bool>, Vec<String>), MeshError> {
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); faces.len()];
    for (p, pair) in pairs.iter().enumerate() {
        for f in pair.faces {
            neighbours[f].push(p as u32);
        }
    }
    let mut reversed: Vec<Option<bool>> = vec![None; faces.len()];
    let (mut count, mut components) = (0, 0);
    for seed in 0..faces.len() {
        if reversed[seed].is_some() {
            continue;
        }
        reversed[seed] = Some(false);
        let mut component = vec![(seed, false)];
        let mut next = 0;
        while let Some(&(f, reverse)) = component.get(next) {
            next += 1;
            for &p in &neighbours[f] {
                let pair = &pairs[p as usize];
                let g = if pair.faces[0] == f { pair.faces[1] } else { pair.faces[0] };
                let wanted = reverse ^ pair.clash;
                match reversed[g] {
                    None => {
                        reversed[g] = Some(wanted);
                        component.push((g, wanted));
                    }
                    Some(found) if found != wanted => {
                        return Err(MeshError::NonOrientable { edge: pair.edge, faces: [f, g] });
                    }
                    Some(_) => {}
                }
            }
        }
        let minority = component.iter().filter(|f| f.1).count();
        let invert = 2 * minority > component.len();
        for (f, reverse) in &component {
            reversed[*f] = Some(reverse ^ invert);
        }
        let changed = if invert { component.len() - minority } else { minority };
        count += changed;
        components += usize::from(changed > 0);
    }
    let repairs = match count {
        0 => Vec::new(),
        _ => vec![format!(
            "reversed {count} of {} faces, in {components} component{}, so that neighbours agree in orientation",
            faces.len(),
            if components == 1 { "" } else { "s" },
        )],
    };
    Ok((reversed.into_iter().map(|r| r == Some(true)).collect(), repairs))
}
