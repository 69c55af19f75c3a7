//! The middle of an eversion.

use super::symmetry::SideExchange;
use glam::DVec3;

/// What an eversion over a pass is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// The halfway model, |V|.
    pub halfway: Vec<DVec3>,
    /// Which way it is pushed off, |V|: the rotation that exchanges sides takes it to its opposite.
    pub aside: Vec<DVec3>,
    /// What takes the halfway model to itself.
    pub exchange: SideExchange,
    /// Weight of bending; strain of an edge weighs 1.
    pub stiffness: f64,
}
