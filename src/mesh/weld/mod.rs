//! Seams: boundary edges of a file that lie upon each other because their vertices were doubled.
//!
//! Two boundary edges are glued where their ends coincide, their faces then agree in orientation, and these do not lie
//! upon each other. Where several edges coincide, those are glued that have the inside between them. Vertices become one
//! only as ends of glued edges, so bodies that touch in a vertex or along an edge stay apart, and every vertex keeps a
//! single fan. What would put a third face to an edge is not glued.

mod coincident;
mod components;
mod seams;

use glam::DVec3;
use seams::Seams;

pub(super) use seams::Welded;

/// A small distance is this share of the diagonal of the box around the mesh, which is far above the rounding of single precision, far below what can be seen.
const SMALL: f64 = 1e-5;
/// It is also no more than this share of all but one per cent of the edges.
const SMALL_OF_EDGES: f64 = 0.05;

/// What becomes of boundary edges of a file that lie upon each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weld {
    /// They stay as they are.
    None,
    /// They become one where coordinates are equal.
    Exact,
    /// They become one where their ends are no farther apart than this, in the units of the file.
    Within(f64),
}

/// A distance that is too small to be meant on this mesh.
pub(super) fn small_distance(triangles: &[[u32; 3]], positions: &[DVec3]) -> f64 {
    let low = positions.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = positions.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let at = |v: u32| positions[v as usize];
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut lengths: Vec<f64> = sides.map(|[a, b]| at(a).distance(at(b))).filter(|l| *l > 0.0).collect();
    let rank = lengths.len() / 100;
    let short = if lengths.is_empty() { 0.0 } else { *lengths.select_nth_unstable_by(rank, f64::total_cmp).1 };
    (SMALL * low.distance(high)).min(SMALL_OF_EDGES * short)
}

/// Glues what coincides exactly, and then what does within a tolerance; nothing without one. `None` if the faces are at
/// fault as they are.
pub(super) fn weld(triangles: &[[u32; 3]], positions: &[DVec3], tolerance: Option<f64>) -> Option<Welded> {
    let mut seams = Seams::new(triangles, positions)?;
    if let Some(tolerance) = tolerance {
        seams.glue_all(tolerance);
    }
    Some(seams.welded(tolerance.unwrap_or(0.0).max(small_distance(triangles, positions))))
}

/// Glues triangles that have their corners for themselves. `None` where an edge is left that lies upon another one, so that
/// the triangles are no surfaces that touch.
pub(super) fn weld_corners(corners: &[DVec3], tolerance: f64) -> Option<Welded> {
    let triangles: Vec<[u32; 3]> = (0..corners.len() as u32 / 3).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    let mut seams = Seams::new(&triangles, corners)?;
    seams.glue_all(tolerance);
    (!seams.is_torn(tolerance)).then(|| seams.welded(tolerance))
}
