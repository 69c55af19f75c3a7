//! What can be wrong with edge lengths.

use super::TRIANGLE_MARGIN;
use super::intrinsic::slack;

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
        "{count} {} too thin, most of all face {face} with vertices {vertices:?} and lengths {lengths:?}: the longest side \
         is shorter than the sum of the others by {slack:.1e} of the sum of all, and below {least:e} rounding decides the \
         angles; flip the longest side or collapse the shortest one, or move the vertex between the shorter sides away \
         from the longest", if *count == 1 { "face is" } else { "faces are" }
    )]
    TooThin { count: usize, face: usize, vertices: [u32; 3], lengths: [f64; 3], slack: f64, least: f64 },
    #[error(
        "the mesh has no positions to take lengths from; add `length = …` or `csv = \"…\"` under [metric], \
         or use a mesh with positions"
    )]
    NoPositions,
    #[error("the formula uses coordinates, but the mesh has no positions; use a mesh that has them")]
    FormulaWithoutPositions,
    #[error("the log scale factor of vertex {vertex} is {value}; it must be finite, correct the formula there")]
    LogScale { vertex: usize, value: f64 },
    #[error(transparent)]
    Timeline(#[from] crate::timeline::TimelineError),
    #[error(transparent)]
    Selection(#[from] crate::mesh::SelectionError),
    #[error("the mesh has {vertices} vertices, but {values} target curvatures were given; give one per vertex")]
    TargetCount { vertices: usize, values: usize },
    #[error(
        "the target curvature of vertex {vertex} is {value} radians; it must be finite and below {limit:.6}, \
         which a vertex without any angle would have"
    )]
    TargetCurvature { vertex: usize, value: f64, limit: f64 },
    #[error(
        "region {region} of the target curvature: {reason}; give every region interior vertices of its own, and less \
         than 360 degrees for each"
    )]
    TargetRegion { region: usize, reason: String },
    #[error("the target curvature per area is {density}; it must be finite")]
    TargetDensity { density: f64 },
    #[error(
        "the target curvatures break Gauss-Bonnet: they add up to {sum} radians instead of 2 pi chi = {expected}, \
         which is {excess:e} too much; spread the difference over the vertices"
    )]
    GaussBonnet { sum: f64, expected: f64, excess: f64 },
    #[error("the mesh has {components} components; scale each of them as a mesh of its own")]
    Disconnected { components: usize },
    #[error(
        "no conformal metric with these curvatures was found: after {iterations} Newton steps a curvature is still off \
         by {residual:e} radians, and face {face} with vertices {vertices:?} is about to degenerate; refine the mesh \
         there or choose a target nearer to the metric"
    )]
    NotConverged { iterations: usize, residual: f64, face: usize, vertices: [u32; 3] },
    #[error(
        "the conformal metric was found with edge flips, but could not be brought back to this mesh: the edge {edge} \
         between vertices {vertices:?} would have to bend around another vertex; refine the mesh there, or make its \
         triangles Delaunay"
    )]
    NotStraight { edge: usize, vertices: [u32; 2] },
    #[error("no Delaunay triangulation was reached in {flips} edge flips; the lengths are too far apart in size")]
    TooManyFlips { flips: usize },
    #[error("the flow is defined at finite times from 0 on, not at {time}; correct it, or the amount that says it")]
    FlowTime { time: f64 },
    #[error(
        "the flow ends at time {time}, where face {face} with vertices {vertices:?} degenerates; \
         use a mesh with better triangles there (Delaunay ones are best), or a target nearer to the metric"
    )]
    FlowBlocked { time: f64, face: usize, vertices: [u32; 3] },
    #[error(transparent)]
    Linear(crate::algebra::CholeskyError),
    #[error(transparent)]
    Mesh(#[from] crate::mesh::MeshError),
}

impl MetricError {
    /// Of faces whose lengths are those of no usable triangle, the worst of which is named.
    pub(super) fn no_triangle(count: usize, face: usize, vertices: [u32; 3], lengths: [f64; 3]) -> MetricError {
        let slack = slack(lengths);
        if slack > 0.0 {
            MetricError::TooThin { count, face, vertices, lengths, slack, least: TRIANGLE_MARGIN }
        } else {
            MetricError::TriangleInequality { count, face, vertices, lengths }
        }
    }

    /// The face that is no usable triangle, and its vertices, if it is that.
    pub(super) fn degenerate_face(&self) -> Option<(usize, [u32; 3])> {
        match *self {
            MetricError::TriangleInequality { face, vertices, .. } | MetricError::TooThin { face, vertices, .. } => {
                Some((face, vertices))
            }
            _ => None,
        }
    }
}
