//! Connected components as meshes of their own.

use super::numbering::Numbering;
use super::{FaceId, Mesh, VertexId};
use std::sync::Arc;

/// Some of the elements of a whole, in their order there.
#[derive(Clone, Debug)]
pub struct Subset {
    /// Increasing numbers; `None` for all elements.
    numbers: Option<Vec<u32>>,
}

impl Subset {
    /// The values of these elements, given those of all.
    pub fn pick<T: Copy>(&self, whole: &[T]) -> Vec<T> {
        match &self.numbers {
            None => whole.to_vec(),
            Some(numbers) => numbers.iter().map(|&k| whole[k as usize]).collect(),
        }
    }

    /// Writes the values of these elements to their places among all.
    pub fn put<T: Copy>(&self, part: &[T], whole: &mut [T]) {
        match &self.numbers {
            None => whole.copy_from_slice(part),
            Some(numbers) => numbers.iter().zip(part).for_each(|(&k, value)| whole[k as usize] = *value),
        }
    }

    /// The number in the whole of the element with this number here.
    pub fn whole(&self, here: usize) -> usize {
        self.numbers.as_ref().map_or(here, |numbers| numbers[here] as usize)
    }

    /// The number here of the element with this number in the whole; `None` if it is not among them.
    pub fn here(&self, whole: usize) -> Option<usize> {
        match &self.numbers {
            None => Some(whole),
            Some(numbers) => numbers.binary_search(&u32::try_from(whole).ok()?).ok(),
        }
    }
}

/// A connected component. Faces, edges, halfedges, vertices and corners keep their order and direction.
#[derive(Clone, Debug)]
pub struct Component {
    /// The component alone.
    pub mesh: Arc<Mesh>,
    /// Its vertices among those of the whole.
    pub vertices: Subset,
    /// Its edges among those of the whole.
    pub edges: Subset,
    /// Its faces among those of the whole.
    pub faces: Subset,
}

impl Component {
    /// All components of a mesh, in the order of their first faces. A connected mesh is shared, not copied.
    pub fn all_of(mesh: &Arc<Mesh>) -> Vec<Component> {
        let components = mesh.components();
        if let [_] = components.as_slice() {
            let all = || Subset { numbers: None };
            return vec![Component { mesh: mesh.clone(), vertices: all(), edges: all(), faces: all() }];
        }
        components.into_iter().filter_map(|faces| Component::of_faces(mesh, &faces)).collect()
    }

    /// `None` only if the faces were no mesh, which those of a component are.
    fn of_faces(mesh: &Mesh, faces: &[FaceId]) -> Option<Component> {
        let sorted = |mut numbers: Vec<u32>| {
            numbers.sort_unstable();
            numbers.dedup();
            Subset { numbers: Some(numbers) }
        };
        let vertices = sorted(faces.iter().flat_map(|&f| mesh.corners(f)).map(|v| v.0).collect());
        let edges = sorted(faces.iter().flat_map(|f| f.halfedges()).map(|h| mesh.edge(h).0).collect());
        let here = |v: VertexId| vertices.here(v.index()).map_or(u32::MAX, |v| VertexId::new(v).0);
        let triangles: Vec<[u32; 3]> = faces.iter().map(|&f| mesh.corners(f).map(here)).collect();
        let count = vertices.numbers.as_ref().map_or(0, Vec::len);
        let names = Numbering::of_part(
            vertices.numbers.iter().flatten().map(|&v| mesh.vertex_number(VertexId(v))).collect(),
            faces.iter().map(|&f| mesh.face_number(f)).collect(),
        );
        let alone = Mesh::from_faces(count, &triangles).ok()?.numbered(names);
        let faces = Subset { numbers: Some(faces.iter().map(|f| f.0).collect()) };
        Some(Component { mesh: Arc::new(alone), vertices, edges, faces })
    }
}
