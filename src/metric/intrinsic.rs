//! What edge lengths determine: angles, areas, curvature, edge directions and weights.

use super::error::MetricError;
use super::triangle::{TRIANGLE_MARGIN, angles, area, slack};
use crate::algebra::Complex;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Mesh, VertexId};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

/// A piecewise Euclidean metric on a mesh (Sec. 1.3) and the quantities it determines.
#[derive(Clone, Debug)]
pub struct Metric {
    edge_lengths: Vec<f64>,
    corner_angles: Vec<[f64; 3]>,
    face_areas: Vec<f64>,
    directions: Vec<Complex>,
    dual_weights: Vec<f64>,
    primal_weights: Vec<f64>,
}

impl Metric {
    /// The lengths that the longest side of a face may have. Areas, weights and what is made of them stay far from where double precision
    /// ends, and single precision in the renderer; tori are the same from 10⁻²² to 10¹⁹.
    pub const LENGTHS: RangeInclusive<f64> = 1e-15..=1e15;

    /// Derives everything from one length per edge.
    ///
    /// # Errors
    /// [`MetricError`] where lengths are missing, not positive and finite, outside of [`Metric::LENGTHS`], or break the
    /// triangle inequality (the worst face is named).
    pub fn new(mesh: &Mesh, edge_lengths: Vec<f64>) -> Result<Metric, MetricError> {
        if edge_lengths.len() != mesh.edge_count() {
            return Err(MetricError::Count { edges: mesh.edge_count(), lengths: edge_lengths.len() });
        }
        if let Some(edge) = edge_lengths.iter().position(|l| !(l.is_finite() && *l > 0.0)) {
            return Err(MetricError::NotPositive {
                edge,
                vertices: mesh.file_ends(EdgeId::new(edge)),
                length: edge_lengths[edge],
            });
        }
        check_range(mesh, &edge_lengths)?;
        check_triangles(mesh, &edge_lengths)?;
        let sides: Vec<[f64; 3]> =
            mesh.faces().map(|f| f.halfedges().map(|h| edge_lengths[mesh.edge(h).index()])).collect();
        let corner_angles: Vec<[f64; 3]> = sides.par_iter().map(|&l| angles(l)).collect();
        let face_areas: Vec<f64> = sides.par_iter().map(|&l| area(l)).collect();
        let directions = corner_angles
            .par_iter()
            .flat_map_iter(|&[t0, t1, _]| {
                // App. D: z_0 = 1, z_1 = exp(i(π − θ_1)), z_2 = exp(i(θ_0 − π)).
                [Complex::ONE, Complex::from_angle(PI - t1), Complex::from_angle(t0 - PI)]
            })
            .collect();
        let sides_area = |e: EdgeId| -> f64 {
            let h = mesh.edge_halfedge(e);
            face_areas[h.face().index()] + mesh.twin(h).map_or(0.0, |t| face_areas[t.face().index()])
        };
        let primal_weights: Vec<f64> =
            mesh.edges().map(|e| 2.0 * sides_area(e) / (3.0 * edge_lengths[e.index()].powi(2))).collect();
        let dual_weights = primal_weights.iter().map(|w| 1.0 / w).collect();
        Ok(Metric { edge_lengths, corner_angles, face_areas, directions, dual_weights, primal_weights })
    }

    /// Derives everything from a length for the numbers of the two ends of each edge.
    ///
    /// # Errors
    /// As [`Metric::new`].
    pub fn from_fn(mesh: &Mesh, mut length: impl FnMut(usize, usize) -> f64) -> Result<Metric, MetricError> {
        let lengths = mesh.edges().map(|e| mesh.edge_vertices(e)).map(|[a, b]| length(a.index(), b.index()));
        Metric::new(mesh, lengths.collect())
    }

    /// Length of an edge.
    #[inline]
    pub fn length(&self, e: EdgeId) -> f64 {
        self.edge_lengths[e.index()]
    }
    /// All lengths, |E|.
    pub fn edge_lengths(&self) -> &[f64] {
        &self.edge_lengths
    }
    /// Mean of all lengths.
    pub fn mean_edge_length(&self) -> f64 {
        self.edge_lengths.iter().sum::<f64>() / self.edge_lengths.len() as f64
    }
    /// Angle in radians at corner `k` of a face, the tail of its halfedge `k`.
    #[inline]
    pub fn corner_angle(&self, f: FaceId, k: usize) -> f64 {
        self.corner_angles[f.index()][k]
    }
    /// Area of a face.
    #[inline]
    pub fn area(&self, f: FaceId) -> f64 {
        self.face_areas[f.index()]
    }
    /// All face areas, |F|.
    pub fn face_areas(&self) -> &[f64] {
        &self.face_areas
    }
    /// Sum of the face areas.
    pub fn total_area(&self) -> f64 {
        self.face_areas.iter().sum()
    }
    /// Mean of the face areas, the unit of time steps.
    pub fn mean_face_area(&self) -> f64 {
        self.total_area() / self.face_areas.len() as f64
    }
    /// A third of the area of the faces around each vertex, |V|; they sum to the total area.
    pub fn vertex_areas(&self, mesh: &Mesh) -> Vec<f64> {
        let mut areas = vec![0.0; mesh.vertex_count()];
        for f in mesh.faces() {
            mesh.corners(f).into_iter().for_each(|v| areas[v.index()] += self.area(f) / 3.0);
        }
        areas
    }

    /// `z = φ(v)/ℓ` of a halfedge in its face's own coordinates (Eq. 14); 1 for the reference edge.
    #[inline]
    pub fn direction(&self, h: HalfedgeId) -> Complex {
        self.directions[h.index()]
    }
    /// Weight of a dual edge in the frame energy (Eq. 20), scale-invariant.
    ///
    /// `w = 3 ℓ² / (2 (A_i + A_j))`: primal length over the barycentric dual length `2 (A_i + A_j) / 3ℓ`.
    /// It equals the circumcentric weight on equilateral triangles and is positive on all others,
    /// where the circumcentric one turns negative as soon as an edge is not Delaunay.
    #[inline]
    pub fn dual_weight(&self, e: EdgeId) -> f64 {
        self.dual_weights[e.index()]
    }
    /// Weight of an edge in the Poisson problem (Eq. 42), `ŵ = 1/w`, scale-invariant and positive.
    ///
    /// Up to a factor, the area around the edge over its length squared: the Poisson problem then
    /// minimizes the relative error of edge vectors, averaged over the surface.
    #[inline]
    pub fn primal_weight(&self, e: EdgeId) -> f64 {
        self.primal_weights[e.index()]
    }

    /// √r from the face of `h` to that of its twin, r = −z_ji / z_ij (Eq. 6, App. D): the root of positive real part.
    /// The signs of a spin connection are chosen elsewhere.
    pub fn transport(&self, h: HalfedgeId, twin: HalfedgeId) -> Complex {
        let r = -(self.direction(twin) * self.direction(h).conjugate());
        Complex::from_angle(0.5 * r.angle())
    }

    /// Discrete Gaussian curvature of an interior vertex, `Ω = 2π − Σ θ` (App. D); for a boundary
    /// vertex the turning angle of the boundary, `π − Σ θ`. Summed over all vertices: `2π χ`.
    pub fn curvature(&self, mesh: &Mesh, v: VertexId) -> f64 {
        let flat = if mesh.is_boundary_vertex(v) { PI } else { TAU };
        flat - mesh.outgoing(v).map(|h| self.corner_angle(h.face(), h.corner())).sum::<f64>()
    }
}

/// Lengths of the edges of a mesh with vertices at `positions` (|V|); |E| values.
pub fn lengths_of_positions(mesh: &Mesh, positions: &[glam::DVec3]) -> Vec<f64> {
    mesh.edges()
        .map(|e| {
            let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
            (b - a).length()
        })
        .collect()
}

/// The largest change of a length between two lists of them, as a share of it (by its logarithm).
pub fn largest_strain(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| libm::log(b / a).abs()).fold(0.0, f64::max)
}

fn check_range(mesh: &Mesh, lengths: &[f64]) -> Result<(), MetricError> {
    let (least, most) = (*Metric::LENGTHS.start(), *Metric::LENGTHS.end());
    let longest = |f: FaceId| {
        let sides = f.halfedges().map(|h| mesh.edge(h));
        sides.into_iter().fold(sides[0], |a, b| if lengths[b.index()] > lengths[a.index()] { b } else { a })
    };
    match mesh.faces().map(longest).find(|e| !Metric::LENGTHS.contains(&lengths[e.index()])) {
        None => Ok(()),
        Some(e) => {
            let (edge, vertices) = (e.index(), mesh.file_ends(e));
            Err(MetricError::OutOfRange { edge, vertices, length: lengths[edge], least, most })
        }
    }
}

fn check_triangles(mesh: &Mesh, lengths: &[f64]) -> Result<(), MetricError> {
    let slack = |f: FaceId| slack(f.halfedges().map(|h| lengths[mesh.edge(h).index()]));
    let bad: Vec<(f64, FaceId)> =
        mesh.faces().map(|f| (slack(f), f)).filter(|(slack, _)| *slack < TRIANGLE_MARGIN).collect();
    match bad.iter().min_by(|a, b| a.0.total_cmp(&b.0)) {
        None => Ok(()),
        Some(&(worst, f)) => {
            let count = bad.iter().filter(|(slack, _)| worst > 0.0 || *slack <= 0.0).count();
            let lengths = f.halfedges().map(|h| lengths[mesh.edge(h).index()]);
            Err(MetricError::no_triangle(count, mesh.file_face(f), mesh.file_corners(f), lengths))
        }
    }
}
