//! What can be wrong with edge lengths.

use super::triangle::{TRIANGLE_MARGIN, slack};
use crate::advice::Advice;
use crate::mesh::{FaceId, Mesh};

/// Why a list of lengths is not a metric on a mesh. Faces and vertices are those of the mesh file, counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum MetricError {
    #[error("the mesh has {edges} edges, but {lengths} lengths were given; {}", self.remedy())]
    Count { edges: usize, lengths: usize },
    #[error("edge {edge} between vertices {vertices:?} has length {length}; {}", self.remedy())]
    NotPositive { edge: usize, vertices: [u32; 2], length: f64 },
    #[error(
        "edge {edge} between vertices {vertices:?} has length {length:e}, and the longest side of a face may be from \
         {least:e} to {most:e}; {}",
        self.remedy()
    )]
    OutOfRange { edge: usize, vertices: [u32; 2], length: f64, least: f64, most: f64 },
    #[error(
        "the triangle inequality fails in {count} faces, worst in face {face} with vertices {vertices:?} and \
         lengths {lengths:?}: the longest side must be shorter than the sum of the others; {}",
        self.remedy()
    )]
    TriangleInequality { count: usize, face: usize, vertices: [u32; 3], lengths: [f64; 3] },
    #[error(
        "{count} {} too thin, most of all face {face} with vertices {vertices:?} and lengths {lengths:?}: the \
         longest side is shorter than the sum of the others by {slack:.1e} of the sum of all, and below {least:e} \
         rounding decides the angles; {}",
        if *count == 1 { "face is" } else { "faces are" }, self.remedy()
    )]
    TooThin { count: usize, face: usize, vertices: [u32; 3], lengths: [f64; 3], slack: f64, least: f64 },
    #[error("the mesh has no positions to take lengths from; {}", self.remedy())]
    NoPositions,
    #[error("the formula uses coordinates, but the mesh has no positions; {}", self.remedy())]
    FormulaWithoutPositions,
    #[error("the log scale factor of vertex {vertex} is {value}; {}", self.remedy())]
    LogScale { vertex: usize, value: f64 },
    #[error("the mesh has {vertices} vertices, but {values} target curvatures were given; {}", self.remedy())]
    TargetCount { vertices: usize, values: usize },
    #[error("the target curvature of vertex {vertex} is {} degrees; {}", degrees(*value), self.remedy())]
    TargetCurvature { vertex: usize, value: f64, limit: f64 },
    #[error(
        "the target curvature of vertex {vertex} is {} degrees, but its {faces} angles are less than 180 degrees \
         each, so that it stays above {} degrees; {}",
        degrees(*value), degrees(*limit), self.remedy()
    )]
    TooFewFaces { vertex: usize, faces: usize, value: f64, limit: f64 },
    #[error("region {region} of the target curvature: {reason}; {}", self.remedy())]
    TargetRegion { region: usize, reason: String },
    #[error("the target curvature of vertex {vertex}: {reason}; {}", self.remedy())]
    TargetCone { vertex: usize, reason: String },
    #[error("the target curvature per area is {density}; {}", self.remedy())]
    TargetDensity { density: f64 },
    #[error(
        "the target curvatures break Gauss-Bonnet: {}; {}",
        gauss_bonnet(*sum, *expected, *excess, *density, surface), self.remedy()
    )]
    GaussBonnet { sum: f64, expected: f64, excess: f64, density: Option<(f64, f64)>, surface: String },
    #[error("the mesh has {components} components; {}", self.remedy())]
    Disconnected { components: usize },
    #[error(
        "no conformal metric with these curvatures was found: after {iterations} Newton steps the curvature of \
         vertex {vertex} is still off by {} degrees; {}",
        degrees(*residual), self.remedy()
    )]
    NotConverged { iterations: usize, residual: f64, vertex: usize },
    #[error(
        "the conformal metric was found with edge flips, but could not be brought back to this mesh: the edge \
         between vertices {vertices:?} would have to bend around another vertex; {}",
        self.remedy()
    )]
    NotStraight { edge: usize, vertices: [u32; 2] },
    #[error("no Delaunay triangulation was reached in {flips} edge flips; {}", self.remedy())]
    TooManyFlips { flips: usize },
    #[error("the flow is defined at finite times from 0 on, not at {time}; {}", self.remedy())]
    FlowTime { time: f64 },
    #[error(
        "the flow ends at time {time}, where face {face} with vertices {vertices:?} degenerates; {}",
        self.remedy()
    )]
    FlowBlocked { time: f64, face: usize, vertices: [u32; 3] },
    #[error("{}; {}", .0, self.remedy())]
    Linear(crate::algebra::CholeskyError),
}

impl Advice for MetricError {
    fn remedy(&self) -> String {
        match self {
            MetricError::Count { .. } => "give one length per edge".into(),
            MetricError::NotPositive { .. } => "every length must be positive and finite".into(),
            MetricError::OutOfRange { .. } => {
                "use another unit: multiply all lengths, positions and pins by one number, which changes no shape"
                    .into()
            }
            MetricError::TriangleInequality { .. } => "correct these lengths".into(),
            MetricError::TooThin { .. } => {
                "flip the longest side or collapse the shortest one, or move the vertex between the shorter sides \
                 away from the longest"
                    .into()
            }
            MetricError::NoPositions => "give lengths, or use a mesh with positions".into(),
            MetricError::FormulaWithoutPositions => "use a mesh that has them".into(),
            MetricError::LogScale { .. } => "it must be finite, correct the formula there".into(),
            MetricError::TargetCount { .. } => "give one per vertex".into(),
            MetricError::TargetCurvature { limit, .. } => format!(
                "it must be finite and below {limit:.4} radians, which are {} degrees and which a vertex without any angle \
                 would have",
                degrees(*limit)
            ),
            MetricError::TooFewFaces { .. } => "ask for more than that, or give the vertex more faces".into(),
            MetricError::TargetRegion { .. } => {
                "give every region interior vertices of its own, and less than 360 degrees for each".into()
            }
            MetricError::TargetCone { .. } => {
                "name interior vertices that are in no region, and less than 360 degrees for each".into()
            }
            MetricError::TargetDensity { .. } => "it must be finite".into(),
            MetricError::GaussBonnet { density: Some((_, total)), .. } => {
                let write = match sign(*total) {
                    Sign::Zero => "write curvature = 0",
                    Sign::Negative => "write a negative `curvature`",
                    Sign::Positive => "write a positive `curvature`",
                };
                format!("{write}, leave it out, or spread the difference over regions")
            }
            MetricError::GaussBonnet { density: None, .. } => "spread the difference over the vertices".into(),
            MetricError::Disconnected { .. } => "scale each of them as a mesh of its own".into(),
            MetricError::NotConverged { .. } => "refine the mesh there or choose a target nearer to the metric".into(),
            MetricError::NotStraight { .. } => "refine the mesh there, or make its triangles Delaunay".into(),
            MetricError::TooManyFlips { .. } => "the lengths are too far apart in size".into(),
            MetricError::FlowTime { .. } => "correct it, or the amount that says it".into(),
            MetricError::FlowBlocked { .. } => {
                "use a mesh with better triangles there (Delaunay ones are best), or a target nearer to the metric"
                    .into()
            }
            MetricError::Linear(_) => {
                "even out the edge lengths, the weights differ by too many orders of magnitude".into()
            }
        }
    }
}

impl MetricError {
    /// As it is, but for faces of the mesh, which become those of its file.
    pub(super) fn of_flow(self, mesh: &Mesh) -> MetricError {
        match self {
            MetricError::FlowBlocked { time, face, .. } => {
                let f = FaceId::new(face);
                MetricError::FlowBlocked { time, face: mesh.file_face(f), vertices: mesh.file_corners(f) }
            }
            other => other,
        }
    }

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

    /// Whether a shorter step may not meet this.
    pub(super) fn is_of_long_step(&self) -> bool {
        self.degenerate_face().is_some() || matches!(self, MetricError::TooManyFlips { .. })
    }
}

/// An angle in radians, in degrees with at most four decimals.
pub(super) fn degrees(radians: f64) -> String {
    let degrees = radians.to_degrees();
    if degrees.is_finite() && degrees.abs() >= 5e-5 {
        let text = format!("{degrees:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else if degrees.abs() < 1e-9 {
        "0".to_owned()
    } else {
        format!("{degrees:.1e}")
    }
}

enum Sign {
    Negative,
    Zero,
    Positive,
}

/// Of an angle that is told in degrees.
fn sign(radians: f64) -> Sign {
    match degrees(radians).as_str() {
        "0" => Sign::Zero,
        text if text.starts_with('-') => Sign::Negative,
        _ => Sign::Positive,
    }
}

/// What is asked for, and what there is.
fn gauss_bonnet(sum: f64, expected: f64, excess: f64, density: Option<(f64, f64)>, surface: &str) -> String {
    if let Some((density, total)) = density {
        let must = match sign(total) {
            Sign::Zero => "0",
            Sign::Negative => "negative",
            Sign::Positive => "positive",
        };
        let boundary = if (total - expected).abs() > 1e-9 {
            format!(", of which its boundary takes {} and leaves {}", degrees(expected - total), degrees(total))
        } else {
            String::new()
        };
        return format!(
            "{surface} has a total curvature of {} degrees{boundary}, so that constant curvature must be {must}, and \
             {density} is asked for",
            degrees(expected)
        );
    }
    let apart = if excess < 0.0 { "few" } else { "many" };
    format!(
        "they add up to {} degrees instead of 2 pi chi = {expected:.5}, the {} degrees of {surface}, which is {} degrees \
         too {apart}",
        degrees(sum),
        degrees(expected),
        degrees(excess.abs())
    )
}
