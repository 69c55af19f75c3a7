//! The middle of an eversion.

use super::symmetry::Exchange;
use glam::DVec3;

/// What an eversion over a pass is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// The halfway model, |V|.
    pub halfway: Vec<DVec3>,
    /// Which way it is pushed off, |V|; the other way is the opposite one.
    pub aside: Vec<DVec3>,
    /// What takes the halfway model to itself, and one way down to the other. Without it both ways are gone down.
    pub exchange: Option<Exchange>,
    /// The radius of what turns over, in radii of the sphere with the same area: 1 for a sphere, less for the tube that a torus is.
    pub size: f64,
    /// Weight of bending; strain of an edge weighs 1.
    pub stiffness: f64,
}

impl Pass {
    /// Makes vectors those of a surface that is both ways at once.
    pub(super) fn make_symmetric(&self, vectors: &mut [DVec3]) {
        if let Some(exchange) = &self.exchange {
            exchange.make_symmetric(vectors);
        }
    }

    /// Makes vectors those of a surface on one way.
    pub(super) fn make_turn_symmetric(&self, vectors: &mut [DVec3]) {
        if let Some(exchange) = &self.exchange {
            exchange.make_turn_symmetric(vectors);
        }
    }
}
