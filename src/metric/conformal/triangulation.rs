//! A triangulation under conformal scaling: curvatures, areas and their derivatives.

use crate::mesh::Mesh;
use crate::metric::MetricError;
use crate::metric::triangle::{TRIANGLE_MARGIN, angles, area, slack};
use std::f64::consts::{PI, TAU};

/// Faces and reference lengths `ℓ`, to be scaled to `ℓ̃_ij = ℓ_ij exp((u_i + u_j)/2)`.
///
/// A copy of a mesh whose edges may be flipped, after which a face may meet itself along an edge or in a
/// vertex. Edge `k` of a face runs from its corner `k` to its corner `k + 1`.
#[derive(Clone, Debug)]
pub(super) struct Triangulation {
    /// The vertices of each face, counterclockwise.
    pub corners: Vec<[u32; 3]>,
    /// The edges of each face.
    pub edges: Vec<[u32; 3]>,
    /// Per edge: face and place in that face on either side; the second side of a boundary edge is `None`.
    pub sides: Vec<[Option<(u32, u8)>; 2]>,
    /// Per edge: the length before scaling.
    pub lengths: Vec<f64>,
    /// Per vertex: whether it is on the boundary.
    pub on_boundary: Vec<bool>,
}

/// What the scaled lengths determine.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Per face: cotangents of the angles at its corners.
    pub cotangents: Vec<[f64; 3]>,
    /// Per face: squared lengths of its edges.
    pub squares: Vec<[f64; 3]>,
    /// Per vertex: 2π, on the boundary π, minus the sum of its angles.
    pub curvature: Vec<f64>,
    /// Per vertex: a third of the areas of the faces around it.
    pub areas: Vec<f64>,
}

impl Triangulation {
    pub fn new(mesh: &Mesh, lengths: &[f64]) -> Triangulation {
        Triangulation {
            corners: mesh.triangles(),
            edges: mesh.faces().map(|f| f.halfedges().map(|h| mesh.edge(h).0)).collect(),
            sides: mesh
                .edges()
                .map(|e| {
                    let h = mesh.edge_halfedge(e);
                    [Some(h), mesh.twin(h)].map(|h| h.map(|h| (h.face().0, h.corner() as u8)))
                })
                .collect(),
            lengths: lengths.to_vec(),
            on_boundary: mesh.vertices().map(|v| mesh.is_boundary_vertex(v)).collect(),
        }
    }

    pub fn vertex_count(&self) -> usize {
        self.on_boundary.len()
    }

    /// Lengths of the three edges of a face, scaled.
    fn scaled(&self, face: usize, half_factors: &[f64]) -> [f64; 3] {
        let corners = self.corners[face].map(|v| half_factors[v as usize]);
        let edges = self.edges[face];
        [0, 1, 2].map(|k| self.lengths[edges[k] as usize] * (corners[k] * corners[(k + 1) % 3]))
    }

    /// All lengths after scaling by `u`, |E|.
    pub fn scaled_lengths(&self, u: &[f64]) -> Vec<f64> {
        let half_factors: Vec<f64> = u.iter().map(|u| libm::exp(0.5 * u)).collect();
        let mut lengths = vec![0.0; self.lengths.len()];
        for (f, edges) in self.edges.iter().enumerate() {
            let scaled = self.scaled(f, &half_factors);
            for k in 0..3 {
                lengths[edges[k] as usize] = scaled[k];
            }
        }
        lengths
    }

    /// Angles, areas and curvatures of the scaled metric; `Err` with the worst face where it is none.
    pub fn shape(&self, u: &[f64]) -> Result<Shape, MetricError> {
        let half_factors: Vec<f64> = u.iter().map(|u| libm::exp(0.5 * u)).collect();
        let n = self.vertex_count();
        let mut shape = Shape {
            cotangents: Vec::with_capacity(self.corners.len()),
            squares: Vec::with_capacity(self.corners.len()),
            curvature: self.on_boundary.iter().map(|&boundary| if boundary { PI } else { TAU }).collect(),
            areas: vec![0.0; n],
        };
        let (mut count, mut worst) = (0, (TRIANGLE_MARGIN, 0));
        for (f, corners) in self.corners.iter().enumerate() {
            let l = self.scaled(f, &half_factors);
            let slack = slack(l);
            if slack.is_nan() || slack < TRIANGLE_MARGIN {
                count += 1;
                // An overflow compares as the worst.
                let slack = if slack.is_finite() { slack } else { f64::NEG_INFINITY };
                if slack < worst.0 {
                    worst = (slack, f);
                }
                continue;
            }
            let (theta, area) = (angles(l), area(l));
            let squares = l.map(|l| l * l);
            for k in 0..3 {
                shape.curvature[corners[k] as usize] -= theta[k];
                shape.areas[corners[k] as usize] += area / 3.0;
            }
            // cot θ_k = (next² + previous² − opposite²) / 4A.
            shape
                .cotangents
                .push([0, 1, 2].map(|k| (squares[k] + squares[(k + 2) % 3] - squares[(k + 1) % 3]) / (4.0 * area)));
            shape.squares.push(squares);
        }
        if count > 0 {
            let face = worst.1;
            let lengths = self.scaled(face, &half_factors);
            return Err(MetricError::no_triangle(count, face, self.corners[face], lengths));
        }
        Ok(shape)
    }

    /// The face with the smallest angle, and its corners.
    pub fn thinnest_face(&self, shape: &Shape) -> (usize, [u32; 3]) {
        let sharpest = |f: usize| shape.cotangents[f].iter().fold(0.0, |most: f64, c| most.max(*c));
        let face = (0..self.corners.len()).max_by(|&a, &b| sharpest(a).total_cmp(&sharpest(b))).unwrap_or(0);
        (face, self.corners[face])
    }

    /// Lower triangle of the derivative of the curvatures by `u`, the cotangent Laplacian: symmetric, positive
    /// semidefinite, its kernel the constants (Springborn, Schröder and Pinkall 2008, Eq. 6).
    pub fn laplacian(&self, shape: &Shape) -> Vec<(usize, usize, f64)> {
        let mut entries = Vec::with_capacity(9 * self.corners.len());
        self.for_sides(shape, |i, j, weight| {
            entries.extend([(i, i, weight), (j, j, weight), (i.max(j), i.min(j), -weight)]);
        });
        entries
    }

    /// The product of the Laplacian and `x`.
    pub fn apply_laplacian(&self, shape: &Shape, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        self.for_sides(shape, |i, j, weight| {
            let flow = weight * (x[i] - x[j]);
            product[i] += flow;
            product[j] -= flow;
        });
        product
    }

    /// Calls `visit` with both ends of each side of each face and half the cotangent of the angle facing it.
    fn for_sides(&self, shape: &Shape, mut visit: impl FnMut(usize, usize, f64)) {
        for (corners, cotangents) in self.corners.iter().zip(&shape.cotangents) {
            for k in 0..3 {
                let (i, j) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
                if i != j {
                    visit(i, j, 0.5 * cotangents[(k + 2) % 3]);
                }
            }
        }
    }

    /// Derivative of the vertex areas in the direction `x` of scale factors.
    pub fn area_change(&self, shape: &Shape, x: &[f64]) -> Vec<f64> {
        let mut change = vec![0.0; x.len()];
        for ((corners, cotangents), squares) in self.corners.iter().zip(&shape.cotangents).zip(&shape.squares) {
            // ∂A/∂ln ℓ_k = ½ ℓ_k² cot(angle facing k), and ln ℓ_k changes by the mean of x at its ends.
            let face: f64 = (0..3)
                .map(|k| {
                    let mean = 0.5 * (x[corners[k] as usize] + x[corners[(k + 1) % 3] as usize]);
                    0.5 * squares[k] * cotangents[(k + 2) % 3] * mean
                })
                .sum();
            for &v in corners {
                change[v as usize] += face / 3.0;
            }
        }
        change
    }
}
