//! Where sheets of a surface pass through each other: double curves, triple points, and the moments at which four sheets meet in a point.
//!
//! Triangles that may meet are those whose boxes overlap. `surface` counts what is there on one surface, and `moment` finds quadruple points between two:
//! four planes that move have a point in common when a determinant, of degree 9 in time, is zero. `film` puts both together.
//!
//! Films of symmetric surfaces pass through some on which sheets meet at corners and along edges. So every vertex is moved a little first,
//! each in a direction of its own that is the same in all frames (`general_position`). Then no corner lies upon another triangle, and no moment
//! falls on a frame. The parity of the number of quadruple points between two immersions without any is that of every regular homotopy near
//! by, and so does not depend on these moves. An eversion of the sphere has an odd number (Max and Banchoff 1981).
//!
//! Triangles that share a vertex are not asked: an immersion is one to one near every vertex.

mod film;
mod general_position;
mod moment;
mod surface;

pub use film::{MultiplePoints, QuadruplePoint};
pub use surface::Sheets;
