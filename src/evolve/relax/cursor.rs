//! How far a relaxation has come.

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
    /// Iterations of the linear solver in all of them; 0 in films of versions that did not count them.
    #[serde(default)]
    pub inner_iterations: usize,
    /// How often frames were drawn anew because rims would not resolve.
    pub restarts: usize,
    /// Δt of the next step in mean face areas, where the phase lets it change; 0 at the start of a phase.
    pub dt: f64,
    /// Mean turn of the frames in the last step in radians; 0 at the start of a phase.
    pub turn: f64,
    /// Whether the last phase that ended did so because frames stood still.
    pub settled: bool,
    /// How often the bending stiffness of a film came down from what it started with.
    pub level: usize,
    /// Whether the mirror image was taken of what random frames had led to.
    pub mirrored: bool,
}

impl Cursor {
    /// The same run at the start of a phase.
    pub(crate) fn at_start_of(self, phase: usize) -> Cursor {
        Cursor { phase, step: 0, dt: 0.0, turn: 0.0, ..self }
    }

    /// Of several components together: steps and restarts of all, and where the one stands that is least far.
    pub(crate) fn of_all(cursors: &[Cursor]) -> Cursor {
        let Some(least) = cursors.iter().min_by_key(|cursor| (cursor.phase, cursor.step)) else {
            return Cursor::default();
        };
        Cursor {
            steps: cursors.iter().map(|cursor| cursor.steps).sum(),
            inner_iterations: cursors.iter().map(|cursor| cursor.inner_iterations).sum(),
            restarts: cursors.iter().map(|cursor| cursor.restarts).sum(),
            settled: cursors.iter().all(|cursor| cursor.settled),
            mirrored: cursors.iter().any(|cursor| cursor.mirrored),
            ..*least
        }
    }
}
