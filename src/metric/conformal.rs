//! Metrics of prescribed curvature in a discrete conformal class.

use super::conformal_linear::{LaplacianInverse, norm, solve_near_laplacian};
use super::conformal_target::{CurvatureTarget, Goal};
use super::conformal_triangulation::{Shape, Triangulation};
use super::{Metric, MetricError};
use crate::mesh::Mesh;

/// [`uniformize`] brings every vertex within this many radians of its target curvature.
pub const CURVATURE_TOLERANCE: f64 = 1e-11;
/// Newton converges in about ten steps or not at all.
const MAX_ITERATIONS: usize = 60;
/// Step lengths below this mean that Newton is stuck.
const SHORTEST_STEP: f64 = 1e-4;
/// Part of the decrease that Newton promises which a step must reach.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Picard steps after each Newton step.
const MAX_CORRECTIONS: usize = 10;
/// Decrease of the residual that makes a Picard step worth it.
const CORRECTION_DECREASE: f64 = 0.8;
/// Relative residual of each Newton step.
const LINEAR_TOLERANCE: f64 = 1e-9;

/// A metric that is discretely conformally equivalent to a given one.
#[derive(Clone, Debug)]
pub struct Conformal {
    /// `u`, one per vertex, |V|: near the vertex, lengths are scaled by `exp(u)`.
    pub log_scale: Vec<f64>,
    /// One per edge, |E|: `ℓ̃_ij = ℓ_ij exp((u_i + u_j)/2)` if there were no flips, otherwise the lengths of the
    /// straight edges of the mesh in the metric found.
    pub edge_lengths: Vec<f64>,
    /// Newton steps taken.
    pub iterations: usize,
    /// Intrinsic edge flips on the way; 0 if the mesh could be kept.
    pub flips: usize,
    /// Largest distance of the curvature of a vertex from its target, in radians.
    pub residual: f64,
}

/// Finds the metric with the target curvature in the discrete conformal class of the given lengths (|E|).
///
/// Discrete conformal equivalence is that of Luo 2004 and of Springborn, Schröder and Pinkall 2008. Newton's method
/// solves `K(u) = K̂(u)`, the Jacobian the cotangent Laplacian minus the exact derivative of target curvature by
/// vertex areas, so that curvature in proportion to area is reached to [`CURVATURE_TOLERANCE`] on the final
/// areas. Steps are cut until the triangle inequalities hold and the residual decreases. If no step is short enough,
/// the problem is solved again with flips, which always has a solution (Gu, Luo, Sun and Wu 2018), and the result is
/// brought back to the edges of the mesh.
///
/// # Errors
/// What [`Metric::new`] refuses; [`MetricError::TargetCount`], [`MetricError::TargetCurvature`],
/// [`MetricError::GaussBonnet`] and [`MetricError::Disconnected`] for targets that cannot be;
/// [`MetricError::NotConverged`], and [`MetricError::NotStraight`] where the solution is no metric on this mesh.
pub fn uniformize(mesh: &Mesh, edge_lengths: &[f64], target: &CurvatureTarget) -> Result<Conformal, MetricError> {
    let metric = Metric::new(mesh, edge_lengths.to_vec())?;
    let goal = Goal::new(target, mesh, &metric)?;
    let mesh_triangulation = Triangulation::new(mesh, edge_lengths);
    let mut solution = match Solution::find(mesh_triangulation.clone(), &goal, None) {
        Ok(solution) => solution,
        Err(MetricError::NotConverged { .. }) => solve_with_flips(mesh_triangulation, &goal)?,
        Err(other) => return Err(other),
    };
    goal.fix_scale(&solution.triangulation, &mut solution.u, metric.total_area(), f64::INFINITY)?;
    let edge_lengths = solution.triangulation.scaled_lengths(&solution.u);
    let log_scale = solution.u.iter().zip(&solution.earlier).map(|(u, earlier)| u + earlier).collect();
    Ok(Conformal {
        log_scale,
        edge_lengths,
        iterations: solution.iterations,
        flips: solution.flips,
        residual: solution.residual,
    })
}

/// Solves on Delaunay triangulations that change with the metric, takes the flips back, and solves once more on the
/// mesh, whose vertex areas differ from those of the Delaunay triangulation.
fn solve_with_flips(mut triangulation: Triangulation, goal: &Goal) -> Result<Solution, MetricError> {
    let mut flips = Vec::new();
    triangulation.flip_to_intrinsic_delaunay(&mut flips)?;
    let mut flipped = Solution::find(triangulation, goal, Some(&mut flips))?;
    flipped.triangulation.lengths = flipped.triangulation.scaled_lengths(&flipped.u);
    flipped.triangulation.unflip(&flips)?;
    let mut last = Solution::find(flipped.triangulation, goal, None)?;
    last.iterations += flipped.iterations;
    last.flips = flips.len();
    last.earlier = flipped.u;
    Ok(last)
}

/// Where Newton's method ended.
struct Solution {
    triangulation: Triangulation,
    u: Vec<f64>,
    /// What `u` adds to.
    earlier: Vec<f64>,
    iterations: usize,
    flips: usize,
    residual: f64,
}

impl Solution {
    /// Newton's method from `u = 0`; with `flips` given, on Delaunay triangulations, flips appended.
    fn find(
        triangulation: Triangulation,
        goal: &Goal,
        mut flips: Option<&mut Vec<u32>>,
    ) -> Result<Solution, MetricError> {
        let zero = vec![0.0; triangulation.vertex_count()];
        let mut here = Iterate::new(triangulation, goal, zero.clone())?;
        let mut iterations = 0;
        while largest(&here.excess) > CURVATURE_TOLERANCE {
            let inverse = LaplacianInverse::new(&here.triangulation, &here.shape, &goal.free, None)?;
            let step = here.newton_step(goal, &inverse);
            let mut length = 1.0;
            let mut blocked = None;
            here = loop {
                let u = here.u.iter().zip(&step).map(|(u, step)| u - length * step).collect();
                let mut flipped = flips.as_ref().map(|flips| (*flips).clone());
                match Iterate::after_flips(here.triangulation.clone(), goal, u, flipped.as_mut())
                    .map(|next| next.corrected(goal, &inverse))
                {
                    Ok(next)
                        if norm(&next.excess) <= (1.0 - SUFFICIENT_DECREASE * length) * norm(&here.excess)
                            || largest(&next.excess) <= CURVATURE_TOLERANCE =>
                    {
                        if let (Some(flips), Some(flipped)) = (flips.as_mut(), flipped) {
                            **flips = flipped;
                        }
                        break next;
                    }
                    Ok(_) => {}
                    Err(MetricError::TriangleInequality { face, vertices, .. }) => blocked = Some((face, vertices)),
                    Err(other) => return Err(other),
                }
                length *= 0.5;
                if length < SHORTEST_STEP {
                    return Err(here.not_converged(iterations, blocked));
                }
            };
            iterations += 1;
            if iterations == MAX_ITERATIONS {
                return Err(here.not_converged(iterations, None));
            }
        }
        let residual = largest(&here.excess);
        let Iterate { triangulation, u, .. } = here;
        Ok(Solution { triangulation, u, earlier: zero, iterations, flips: 0, residual })
    }
}

struct Iterate {
    triangulation: Triangulation,
    u: Vec<f64>,
    shape: Shape,
    /// Curvature minus target, 0 where the vertex is held.
    excess: Vec<f64>,
}

impl Iterate {
    fn new(triangulation: Triangulation, goal: &Goal, u: Vec<f64>) -> Result<Iterate, MetricError> {
        let shape = triangulation.shape(&u)?;
        let target = goal.curvature(&triangulation, &shape);
        let excess = shape.curvature.iter().zip(&target).map(|(curvature, target)| curvature - target).collect();
        Ok(Iterate { triangulation, u, shape, excess })
    }

    fn after_flips(
        mut triangulation: Triangulation,
        goal: &Goal,
        u: Vec<f64>,
        flips: Option<&mut Vec<u32>>,
    ) -> Result<Iterate, MetricError> {
        if let Some(flips) = flips {
            triangulation.flip_to_delaunay(&u, flips)?;
        }
        Iterate::new(triangulation, goal, u)
    }

    /// The change of `u` to subtract; `inverse` is that of the Laplacian here.
    fn newton_step(&self, goal: &Goal, inverse: &LaplacianInverse) -> Vec<f64> {
        let Iterate { triangulation, shape, excess, .. } = self;
        let jacobian = |x: &[f64]| -> Vec<f64> {
            let target = goal.curvature_change(triangulation, shape, x);
            let curvature = triangulation.apply_laplacian(shape, x);
            (0..x.len()).map(|v| if goal.free[v] { curvature[v] - target[v] } else { 0.0 }).collect()
        };
        solve_near_laplacian(inverse, jacobian, excess, LINEAR_TOLERANCE)
    }

    /// Picard steps, as long as they pay, with the Laplacian of the iterate before: it hardly depends on the metric
    /// in a conformal class. On spheres, where Moebius transformations are all but solutions of the linear problem,
    /// this brings a long Newton step back to metrics that differ by such a transformation.
    fn corrected(mut self, goal: &Goal, inverse: &LaplacianInverse) -> Iterate {
        for _ in 0..MAX_CORRECTIONS {
            let change = inverse.apply(&self.excess);
            let u = self.u.iter().zip(&change).map(|(u, c)| u - c).collect();
            match Iterate::new(self.triangulation.clone(), goal, u) {
                Ok(next) if norm(&next.excess) < CORRECTION_DECREASE * norm(&self.excess) => self = next,
                _ => break,
            }
        }
        self
    }

    fn not_converged(&self, iterations: usize, blocked: Option<(usize, [u32; 3])>) -> MetricError {
        let (face, vertices) = blocked.unwrap_or_else(|| self.triangulation.thinnest_face(&self.shape));
        MetricError::NotConverged { iterations, residual: largest(&self.excess), face, vertices }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}
