//! `[metric]`: edge lengths, and how they change.

use super::{FilesSection, NumberSection};
use crate::mesh::Selection;
use crate::metric::Interpolation;
use crate::timeline::{Ease, Extrapolation};
use std::path::PathBuf;

/// `[metric]`: lengths, and changes made to them one after another.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct MetricSection {
    /// Where the lengths come from if there are no keys.
    pub lengths: LengthSource,
    /// `files = "pose*.obj"`: those of several files at their times, in place of keys.
    pub files: Option<FilesSection>,
    /// `[[metric.key]]`: the metrics at some times.
    pub keys: Vec<MetricKeySection>,
    /// What is interpolated between keys.
    pub interpolation: Interpolation,
    /// Between keys.
    pub ease: Ease,
    /// Before the first and after the last key.
    pub extrapolation: Extrapolation,
    /// `[[metric.change]]`, in order.
    pub changes: Vec<MetricChangeSection>,
}

/// Where edge lengths come from.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum LengthSource {
    /// Left out: the lengths the shape decrees, or those of the mesh's own positions.
    #[default]
    OfMesh,
    /// `length = 0.05`: the same for every edge.
    Uniform(f64),
    /// `csv = "…"`: lines `u,v,length`, every edge once.
    Csv(PathBuf),
    /// `file = "…"`: the lengths of another mesh with the same connectivity, or of arrays.
    File(PathBuf),
    /// `positions = ["…", "…", "…"]`: the lengths of the mesh with its vertices moved to x, y and z by these
    /// expressions in x, y, z of the vertex, time `t` and the parameters.
    Positions([String; 3]),
    /// `formula = "…"`: an expression in x, y, z of the edge midpoint, dx, dy, dz from end to end, `length`, the
    /// length of the mesh, time `t` and the parameters.
    Formula(String),
}

/// `[[metric.key]]`: the metric at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct MetricKeySection {
    /// When.
    pub time: f64,
    /// What.
    pub lengths: LengthSource,
}

/// `[[metric.change]]`
#[derive(Clone, Debug, PartialEq)]
pub struct MetricChangeSection {
    /// Which kind.
    pub kind: ChangeKind,
    /// How much of it: 0 none, 1 all.
    pub amount: NumberSection,
}

/// What is done to the lengths.
#[derive(Clone, Debug, PartialEq)]
pub enum ChangeKind {
    /// Lengths are multiplied by `exp((u + u')/2)`, the log scale factors of the ends: a formula in x, y, z of the
    /// vertex, time and the parameters.
    Conformal {
        /// u
        log_scale: String,
    },
    /// Discrete Ricci flow. Amount a is time −ln(1 − a), and 1 the limit.
    Ricci(RicciSection),
}

/// What a Ricci flow tends to.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct RicciSection {
    /// Gaussian curvature inside; left out, the constant that Gauss–Bonnet leaves.
    pub curvature: Option<f64>,
    /// Regions with a total curvature of their own, in place of `curvature`.
    pub regions: Vec<CurvatureRegionSection>,
    /// `csv = "…"`: lines `v,degrees`, vertices with a curvature of their own, as if each were a region.
    pub csv: Option<PathBuf>,
    /// Total turning angle of every boundary loop in degrees, spread in proportion to length; left out, the boundary
    /// keeps its lengths.
    pub turning: Option<f64>,
    /// Whether lengths may change as a whole.
    pub free_area: bool,
}

/// `[[metric.change.region]]`: total curvature of a set of vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvatureRegionSection {
    /// Which vertices.
    pub vertices: Selection,
    /// Total curvature in degrees, spread in proportion to area. What Gauss–Bonnet leaves is spread over the vertices
    /// in no region in the same way.
    pub total: f64,
}
