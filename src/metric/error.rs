//! What can be wrong with edge lengths.

/// Why a list of lengths is not a metric on a mesh. Faces and edges count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum MetricError {
    #[error("the mesh has {edges} edges, but {lengths} lengths were given; give one length per edge")]
    Count { edges: usize, lengths: usize },
    #[error("edge {edge} between vertices {vertices:?} has length {length}; every length must be positive and finite")]
    NotPositive { edge: usize, vertices: [u32; 2], length: f64 },
    #[error(
        "the triangle inequality fails in {count} faces, worst in face {face} with vertices {vertices:?} and lengths \
         {lengths:?}: the longest side must be shorter than the sum of the others; correct these lengths"
    )]
    TriangleInequality { count: usize, face: usize, vertices: [u32; 3], lengths: [f64; 3] },
    #[error(
        "the mesh has no positions to take lengths from; add `length = …` or `csv = \"…\"` under [metric], \
         or use a mesh with positions"
    )]
    NoPositions,
    #[error("formula `{formula}`: {reason}; it may use x, y, z (edge midpoint) and length")]
    Formula { formula: String, reason: String },
    #[error(transparent)]
    Mesh(#[from] crate::mesh::MeshError),
}
