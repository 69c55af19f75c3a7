//! What is known of a frame besides its positions.

use serde::{Deserialize, Serialize};

/// Where a relaxation stands between two steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cursor {
    /// Phase, from 0; the number of phases when all are done.
    pub phase: usize,
    /// Steps taken in this phase.
    pub step: usize,
    /// Steps taken in all phases.
    pub steps: usize,
    /// How often frames were drawn anew because rims would not resolve.
    pub restarts: usize,
    /// Δt of the next step in mean face areas, where the phase lets it change; 0 at the start of a phase.
    #[serde(default)]
    pub dt: f64,
    /// Mean turn of the frames in the last step in radians; 0 at the start of a phase.
    #[serde(default)]
    pub turn: f64,
    /// Whether the last phase that ended did so because frames stood still.
    pub settled: bool,
}

impl Cursor {
    /// The same run at the start of a phase.
    pub(super) fn at_start_of(self, phase: usize) -> Cursor {
        Cursor { phase, step: 0, dt: 0.0, turn: 0.0, ..self }
    }
}

/// One line of `inspect`: what a cached frame is worth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameReport {
    /// Number of the frame, from 1.
    pub frame: usize,
    /// Time of the frame, unit-free.
    pub time: f64,
    /// Root mean square of the relative length errors of all edges.
    pub l2_length_error: f64,
    /// Their largest absolute value.
    pub max_length_error: f64,
    /// Median of their absolute values.
    pub median_length_error: f64,
    /// 95th percentile of their absolute values.
    pub p95_length_error: f64,
    /// Number of rim edges (Def. 4.1).
    pub rims: usize,
    /// Total intrinsic length of the rim edges.
    pub rim_length: f64,
    /// Number of interior vertices with figure-8 star (Sec. 2.2).
    pub pinch_points: usize,
    /// q_f on every generator, as digits, measured on the positions; [`NO_CLASS`] while there are pinch points, because a
    /// surface that is pinched is no immersion and in no class.
    pub spin_class: String,
    /// Energy of the frames (Eq. 20) with the last phase's ε.
    pub energy: f64,
    /// Period part of the edge vectors relative to their norm.
    pub period_error: f64,
    /// With Ricci flow: the largest distance of a curvature from its target, in radians.
    #[serde(default)]
    pub curvature_error: Option<f64>,
    /// Where the mesh has positions and the first frame their metric: mean distance of the surface from them after
    /// rigid alignment, over their diameter.
    #[serde(default)]
    pub mean_distance: Option<f64>,
    /// With pins: the largest distance of a pinned vertex from its place.
    #[serde(default)]
    pub pin_distance: Option<f64>,
    /// Largest change of an edge's length since the frame before, as a share of it.
    #[serde(default)]
    pub strain: f64,
    /// Median distance that vertices moved since the frame before, rigid motion taken away.
    #[serde(default)]
    pub median_move: f64,
    /// Largest such distance.
    #[serde(default)]
    pub max_move: f64,
    /// Rims that were not there in the frame before,
    #[serde(default)]
    pub rims_born: usize,
    /// that are no longer there,
    #[serde(default)]
    pub rims_died: usize,
    /// and that moved to an edge which shares a vertex with the old one.
    #[serde(default)]
    pub rims_moved: usize,
    /// How far the relaxation has come.
    #[serde(flatten)]
    pub cursor: Cursor,
    /// Wall time of these steps.
    pub seconds: f64,
    /// Whether all phases are done and the last one met its tolerance.
    pub converged: bool,
    /// Whether this is a frame after so many steps, of a film of the relaxation that is not over or of one that changes
    /// with time: it was not to converge.
    #[serde(default)]
    pub on_the_way: bool,
}

/// In place of the class of a surface that has none.
pub const NO_CLASS: &str = "—";

impl FrameReport {
    /// Whether the frame was to converge and ran into the limit of steps.
    pub fn is_unconverged(&self) -> bool {
        !self.converged && !self.on_the_way
    }

    /// Whether the surface is pinched, so that it has no class.
    pub fn has_no_class(&self) -> bool {
        self.spin_class == NO_CLASS
    }
}
