//! The discrete spin structure (Sec. 3): spin connection, figure-0 vertices (Alg. 3), choice of class.

use super::{Homology, SpinError, Strip};
use crate::algebra::Complex;
use crate::mesh::{EdgeId, HalfedgeId, Mesh};
use crate::metric::Metric;

/// A discrete spin connection τ with every interior vertex figure-0 (Def. 3.1).
///
/// One unit complex number per edge, the transport from the face of the edge's named halfedge to the
/// face of its twin; 1, and unused, on boundary edges. Its class under sign gauge is the spin structure.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinStructure {
    transports: Vec<Complex>,
}

impl SpinStructure {
    /// A spin structure of this metric in the class that Algorithm 3 happens to find.
    pub fn new(mesh: &Mesh, metric: &Metric, homology: &Homology) -> SpinStructure {
        let root = |e| mesh.edge_sides(e).map_or(Complex::ONE, |[h, twin]| metric.transport(h, twin));
        let mut spin = SpinStructure { transports: mesh.edges().map(root).collect() };
        spin.make_vertices_figure_0(mesh, metric, homology);
        spin
    }

    /// A spin structure with `q(γ_k) = digits[k]` on the generators (App. A).
    ///
    /// # Errors
    /// [`SpinError::ClassLength`] unless there is one digit per generator.
    pub fn of_class(
        mesh: &Mesh,
        metric: &Metric,
        homology: &Homology,
        digits: &[bool],
    ) -> Result<SpinStructure, SpinError> {
        if digits.len() != homology.betti() {
            return Err(SpinError::ClassLength { given: digits.len(), generators: homology.betti() });
        }
        let mut spin = SpinStructure::new(mesh, metric, homology);
        for (generator, &digit) in homology.generators().iter().zip(digits) {
            if spin.is_figure_8(mesh, metric, &generator.strip) != digit {
                spin.flip_along(&generator.path);
            }
        }
        Ok(spin)
    }

    /// A spin structure from one transport per edge, |E|, as [`SpinStructure::transports`] gives them.
    ///
    /// # Errors
    /// [`SpinError::TransportCount`], [`SpinError::NotUnit`]
    pub fn from_transports(mesh: &Mesh, transports: Vec<Complex>) -> Result<SpinStructure, SpinError> {
        if transports.len() != mesh.edge_count() {
            return Err(SpinError::TransportCount { given: transports.len(), edges: mesh.edge_count() });
        }
        // Products of unit numbers are unit up to rounding.
        let is_unit = |t: &Complex| (t.re * t.re + t.im * t.im - 1.0).abs() < 1e-9;
        match transports.iter().position(|t| !is_unit(t)) {
            Some(edge) => Err(SpinError::NotUnit { edge }),
            None => Ok(SpinStructure { transports }),
        }
    }

    /// From transports that are known to be those of a spin structure.
    pub(crate) fn of_known(transports: Vec<Complex>) -> SpinStructure {
        SpinStructure { transports }
    }

    /// Transport across a halfedge, from its face to the face of its twin; conjugate to the twin's.
    #[inline]
    pub fn across(&self, mesh: &Mesh, h: HalfedgeId) -> Complex {
        let e = mesh.edge(h);
        let tau = self.transports[e.index()];
        if mesh.edge_halfedge(e) == h { tau } else { tau.conjugate() }
    }

    /// τ per edge, |E| values, in the direction of the edge's named halfedge.
    pub fn transports(&self) -> &[Complex] {
        &self.transports
    }

    /// q_τ of a closed strip (Eq. 9): true for figure-8, false for figure-0.
    pub fn is_figure_8(&self, mesh: &Mesh, metric: &Metric, strip: &Strip) -> bool {
        let curvature = Complex::from_angle(0.5 * strip.total_geodesic_curvature(mesh, metric));
        (curvature * strip.transport(|h| self.across(mesh, h))).re > 0.0 // Eq. 8
    }

    /// q_τ on every generator, shortest first.
    pub fn class(&self, mesh: &Mesh, metric: &Metric, homology: &Homology) -> Vec<bool> {
        homology.generators().iter().map(|g| self.is_figure_8(mesh, metric, &g.strip)).collect()
    }

    /// Interior vertices that are figure-8 under τ; none for a spin structure.
    pub fn figure_8_vertices(&self, mesh: &Mesh, metric: &Metric) -> Vec<usize> {
        mesh.vertices()
            .filter(|&v| Strip::around_vertex(mesh, v).is_some_and(|star| self.is_figure_8(mesh, metric, &star)))
            .map(|v| v.index())
            .collect()
    }

    /// Changes the sign of τ on the given edges.
    pub fn flip_along(&mut self, path: &[EdgeId]) {
        for e in path {
            self.transports[e.index()] = -self.transports[e.index()];
        }
    }

    /// Algorithm 3: flips every tree edge that has an odd number of figure-8 descendants.
    fn make_vertices_figure_0(&mut self, mesh: &Mesh, metric: &Metric, homology: &Homology) {
        let mut odd = vec![false; mesh.vertex_count()];
        for v in self.figure_8_vertices(mesh, metric) {
            odd[v] = true;
        }
        let tree = homology.tree();
        for v in tree.order.iter().rev() {
            if let (true, Some(edge), Some(parent)) =
                (odd[v.index()], tree.parents[v.index()], tree.parent_vertices[v.index()])
            {
                self.flip_along(&[edge]);
                odd[parent.index()] ^= true;
            }
        }
    }
}

/// A class as text, one digit of q per generator.
pub fn class_digits(class: &[bool]) -> String {
    class.iter().map(|&q| if q { '1' } else { '0' }).collect()
}
