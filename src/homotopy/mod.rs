//! Whether a surface that moves stays an immersion: every hinge and every face between two surfaces of one mesh is decided.
//!
//! Vertices move on straight lines, and time runs from 0 to 1. A hinge has the faces (a, b, c) and (b, a, d). With
//! e = b − a, u = c − a, w = d − a their normals are m = e × u and n = w × e, and
//!
//! m × n = −e det(e, u, w)   and so   |m|² |n|² = (m · n)² + |e|² det(e, u, w)².
//!
//! A face *vanishes* where its normal does. A hinge *folds* where its faces lie upon each other: at a root of the cubic
//! v = det(e, u, w) at which the quartic m · n is negative; where both are zero, a face vanishes. As long as no hinge folds and no face
//! vanishes, the shortest rotation from a face to the next changes continuously. Then no rim appears or goes, and what is
//! figure 0 stays so: the motion is a regular homotopy if it begins with an immersion.
//!
//! A rigid motion, or any affine one, between two surfaces folds nothing on its straight lines unless it turns by 180° or mirrors,
//! because all v keep their sign then. But what is decided is always what happens on the straight lines between the positions as they are given.
//!
//! What is nearly always so is settled by balls that contain the true values (`ball`, `settled`): v without a root, or m · n
//! without one. Everything else is decided in integers (`exact`), so that nothing is left open. The work is proportional to the
//! number of edges.
//!
//! Sheets may pass through each other all the while; `multiple_points` says where.

mod ball;
mod events;
mod exact;
mod film;
mod form;
mod motion;
mod multiple_points;
mod number;
mod polynomial;
mod rims;
mod search;
mod settled;
#[cfg(test)]
mod tests;

pub use events::{Element, Event, events_between};
pub use film::{FilmEvent, Homotopy};
pub use multiple_points::{MultiplePoints, QuadruplePoint, Sheets};
pub use rims::{Change, Rim, RimCounts, Rims, rims_through_time};
