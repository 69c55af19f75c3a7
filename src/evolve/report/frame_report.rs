//! What is known of a frame besides its positions.

use crate::evolve::relax::Cursor;
use crate::frames::Stiffness;
use crate::polish::PolishReport;
use serde::{Deserialize, Serialize};

/// What one of several components is worth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ComponentReport {
    /// Number of its faces.
    pub faces: usize,
    /// Root mean square of the relative length errors of its edges.
    pub l2_length_error: f64,
    /// Their largest absolute value.
    pub max_length_error: f64,
    /// Number of its rim edges.
    pub rims: usize,
    /// Number of its pinch points.
    pub pinch_points: usize,
    /// How far its relaxation has come.
    #[serde(flatten)]
    pub cursor: Cursor,
    /// Whether all its phases are done and the last one met its tolerance.
    pub converged: bool,
}

/// Distance of bending angles from their targets, over the edges that have one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BendingError {
    /// Root mean square in degrees, edges weighted by length.
    pub rms_degrees: f64,
    /// The largest distance in degrees.
    pub max_degrees: f64,
    /// The ends of the edge with the largest distance.
    pub edge: [usize; 2],
}

/// Where a frame is worst. Vertices and faces have the numbers of the mesh file, from 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Places {
    /// Ends of the edge with the largest length error.
    pub worst_edge: [usize; 2],
    /// Ends of the first few rims.
    pub rims: Vec<[usize; 2]>,
    /// The first few pinch points.
    pub pinch_points: Vec<usize>,
    /// The thinnest face.
    pub thinnest_face: usize,
    /// The least height of the thinnest face over its longest side; 0.87 for an equilateral triangle.
    pub thinness: f64,
    /// The inner vertex of largest absolute curvature.
    pub sharpest_vertex: usize,
    /// The curvature of that vertex in degrees.
    pub sharpest_degrees: f64,
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
    /// The class that the frame was to have.
    pub asked_class: String,
    /// Energy of the frames (Eq. 20) with the weights `stiffness`.
    pub energy: f64,
    /// The weights ε of the last phase.
    pub stiffness: Stiffness,
    /// Period part of the edge vectors relative to their norm.
    pub period_error: f64,
    /// With Ricci flow: the largest distance of a curvature from its target, in radians.
    pub curvature_error: Option<f64>,
    /// Where the mesh has positions and the first frame their metric: mean distance of the surface from them after
    /// rigid alignment, over their diameter.
    pub mean_distance: Option<f64>,
    /// With pins: the largest distance of a pinned vertex from its place.
    pub pin_distance: Option<f64>,
    /// Largest change of an edge's length since the frame before, as a share of it.
    pub strain: f64,
    /// Median distance that vertices moved since the frame before, rigid motion taken away.
    pub median_move: f64,
    /// Largest such distance.
    pub max_move: f64,
    /// Number of rims that were not there in the frame before.
    pub rims_born: usize,
    /// Number of rims of the frame before that are no longer there.
    pub rims_died: usize,
    /// Number of rims that moved to an edge which shares a vertex with the old one.
    pub rims_moved: usize,
    /// The volume that the surface encloses, positive where its front is outside; parts that are covered several times
    /// count as often. `None` for a surface with boundary.
    pub enclosed_volume: Option<f64>,
    /// How far the deepest inward dent of a surface of convex metric lies inside its convex hull. `None` where the metric
    /// is not convex, or one of the components has another.
    pub largest_dent: Option<f64>,
    /// With target bending angles: how far the surface is from them.
    pub bending_error: Option<BendingError>,
    /// What polish did, where the frame was polished. All other measures are those of the polished surface, but for the energy
    /// and the period part, which are about the frames before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polish: Option<PolishReport>,
    /// Where what may be wrong with the frame is to be looked for.
    pub places: Places,
    /// The components one by one, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub components: Vec<ComponentReport>,
    /// How far the relaxation has come.
    #[serde(flatten)]
    pub cursor: Cursor,
    /// Wall time of the frame. It is not kept on disk, where the same film has the same bytes.
    #[serde(skip)]
    pub seconds: f64,
    /// Whether all phases are done and the last one met its tolerance, in every component.
    pub converged: bool,
    /// Whether this is a frame after so many steps, of a film of the relaxation that is not over or of one that changes
    /// with time: it was not to converge.
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

    /// Where the relaxation of each component stands.
    pub fn cursors(&self) -> Vec<Cursor> {
        match self.components.as_slice() {
            [] => vec![self.cursor],
            components => components.iter().map(|component| component.cursor).collect(),
        }
    }

    /// The first measure that is no number, which could not be written to a report and read again.
    pub fn first_lost(&self) -> Option<&'static str> {
        // Every field is named here, so that none is forgotten.
        let FrameReport {
            frame: _,
            time,
            l2_length_error,
            max_length_error,
            median_length_error,
            p95_length_error,
            rims: _,
            rim_length,
            pinch_points: _,
            spin_class: _,
            asked_class: _,
            energy,
            stiffness,
            period_error,
            curvature_error,
            mean_distance,
            pin_distance,
            strain,
            median_move,
            max_move,
            rims_born: _,
            rims_died: _,
            rims_moved: _,
            enclosed_volume,
            largest_dent,
            bending_error,
            polish,
            places,
            components,
            cursor,
            seconds,
            converged: _,
            on_the_way: _,
        } = self;
        let always = [
            ("time", *time),
            ("l2_length_error", *l2_length_error),
            ("max_length_error", *max_length_error),
            ("median_length_error", *median_length_error),
            ("p95_length_error", *p95_length_error),
            ("rim_length", *rim_length),
            ("energy", *energy),
            ("period_error", *period_error),
            ("strain", *strain),
            ("median_move", *median_move),
            ("max_move", *max_move),
            ("seconds", *seconds),
            ("thinness", places.thinness),
            ("sharpest_degrees", places.sharpest_degrees),
        ];
        let sometimes = [
            ("curvature_error", *curvature_error),
            ("mean_distance", *mean_distance),
            ("pin_distance", *pin_distance),
            ("enclosed_volume", *enclosed_volume),
            ("largest_dent", *largest_dent),
        ];
        let of_bending = bending_error.map_or([0.0; 2], |error| [error.rms_degrees, error.max_degrees]);
        let of_components = components.iter().flat_map(|part| {
            let ComponentReport { l2_length_error, max_length_error, cursor, .. } = *part;
            [l2_length_error, max_length_error, cursor.dt, cursor.turn]
        });
        let of_polish = polish.map_or([0.0; 5], |polish| {
            [
                polish.l2_length_error_before,
                polish.max_length_error_before,
                polish.l2_length_error,
                polish.mean_bending_before,
                polish.mean_bending,
            ]
        });
        let named = |name: &'static str| move |number: f64| (name, number);
        let mut numbers = (always.into_iter())
            .chain(sometimes.into_iter().filter_map(|(name, number)| Some((name, number?))))
            .chain(stiffness.map(named("stiffness")))
            .chain(of_bending.map(named("bending_error")))
            .chain(of_polish.map(named("polish")))
            .chain(of_components.map(named("components")))
            .chain([cursor.dt, cursor.turn].map(named("cursor")));
        numbers.find(|(_, number)| !number.is_finite()).map(|(name, _)| name)
    }
}
