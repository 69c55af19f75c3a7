//! Over a pass: a halfway model takes on the lengths of a sphere or a torus and slides down to it, on either side.
//!
//! A halfway model is taken to itself by a motion that takes one way down from it to the other: a rotation that exchanges the sides of a sphere, a
//! reflection of a ring. Its lengths become those that are asked for little by little, within this symmetry (`saddle.rs`). Pushed off to one
//! side it descends as a thin shell would, vertex by vertex, to the surface that is asked for (`descent.rs`). The way to the other side
//! is the same one, moved by the symmetry; where there is none, it is gone down as well. One half backwards and then the other is an
//! eversion (`film.rs`, `way.rs`). No step folds a hinge over or crushes a face (`flow.rs`), so that it is a regular homotopy.

mod descent;
mod error;
mod film;
mod flow;
mod halfway;
mod saddle;
mod symmetry;
mod way;

pub use error::PassError;
pub use halfway::Pass;
pub use symmetry::{Exchange, Motion, NoSymmetry};
