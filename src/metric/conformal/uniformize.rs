//! Metrics of prescribed curvature in a discrete conformal class.

use super::linear::{LaplacianInverse, norm, solve_near_laplacian};
use super::target::{CurvatureTarget, Goal};
use super::triangulation::{Shape, Triangulation};
use crate::mesh::{Mesh, VertexId};
use crate::metric::{Metric, MetricError};

/// [`uniformize`] brings every vertex within this many radians of its target curvature.
pub const CURVATURE_TOLERANCE: f64 = 1e-11;
/// Newton converges in about ten steps or hardly at all.
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
    /// Picard steps taken after Newton steps, with the same factorization.
    pub corrections: usize,
    /// Intrinsic edge flips on the way; 0 if the mesh could be kept.
    pub flips: usize,
    /// Largest distance of the curvature of a vertex from its target, in radians.
    pub residual: f64,
    /// Whether the curvature that regions leave had to be spread in proportion to the areas of the given metric, because
    /// none was found in which it is in proportion to its own.
    pub by_initial_areas: bool,
}

/// Finds the metric with the target curvature in the discrete conformal class of the given lengths (|E|).
///
/// Discrete conformal equivalence is that of Luo 2004 and of Springborn, Schröder and Pinkall 2008. Newton's method
/// solves `K(u) = K̂(u)`. Its Jacobian is the cotangent Laplacian, the second derivative of the convex energy of these
/// papers, minus the exact derivative of the target by the vertex areas, so that curvature in proportion to area is
/// reached on the final areas. Steps are cut until the triangle inequalities hold and the residual decreases.
///
/// If no step is short enough, the problem is solved again on intrinsic Delaunay triangulations that follow the metric
/// by flips. There every target on a closed surface has a solution (Gu, Luo, Sun and Wu 2018; with target curvature
/// in proportion to area, Kouřimská 2021). It is then expressed by the edges of the mesh, where they can be straight.
///
/// Beside regions the rest need not have a solution: no sphere has constant curvature but for a single cone (Troyanov
/// 1991). Then what is left is spread by the areas of the given metric, which can always be.
///
/// # Errors
/// What [`Metric::new`] refuses; [`MetricError::TargetCount`], [`MetricError::TargetCurvature`],
/// [`MetricError::TargetDensity`], [`MetricError::TargetRegion`], [`MetricError::GaussBonnet`] and
/// [`MetricError::Disconnected`] for targets that cannot be; [`MetricError::NotConverged`], and
/// [`MetricError::NotStraight`] where the solution is no metric on this mesh.
pub fn uniformize(mesh: &Mesh, edge_lengths: &[f64], target: &CurvatureTarget) -> Result<Conformal, MetricError> {
    let metric = Metric::new(mesh, edge_lengths.to_vec())?;
    let mut goal = Goal::new(target, mesh, &metric)?;
    let triangulation = Triangulation::new(mesh, edge_lengths);
    let in_file = |v: u32| mesh.file_vertex(VertexId(v)) as u32;
    let solve_somehow = |goal: &Goal| {
        let found = match solve(triangulation.clone(), None, goal) {
            Err(MetricError::NotConverged { .. }) => solve_with_flips(triangulation.clone(), goal),
            result => result,
        };
        found.map_err(|error| match error {
            MetricError::NotConverged { iterations, residual, vertex } => {
                MetricError::NotConverged { iterations, residual, vertex: in_file(vertex as u32) as usize }
            }
            MetricError::NotStraight { edge, vertices } => {
                MetricError::NotStraight { edge, vertices: vertices.map(in_file) }
            }
            other => other,
        })
    };
    let mut by_initial_areas = false;
    let mut found = match solve_somehow(&goal) {
        Err(error @ MetricError::NotConverged { .. }) => {
            let unscaled = triangulation.shape(&vec![0.0; mesh.vertex_count()])?;
            by_initial_areas = goal.spread_by_areas_of(&triangulation, &unscaled);
            if by_initial_areas { solve_somehow(&goal)? } else { return Err(error) }
        }
        result => result?,
    };
    let scale = goal.scale_shift(&found.triangulation, &found.u, metric.total_area(), f64::INFINITY)?;
    found.u.iter_mut().for_each(|u| *u += scale);
    Ok(Conformal {
        edge_lengths: found.triangulation.scaled_lengths(&found.u),
        log_scale: found.u.iter().zip(&found.earlier).map(|(u, earlier)| u + earlier).collect(),
        iterations: found.iterations,
        corrections: found.corrections,
        flips: found.flips,
        residual: found.residual,
        by_initial_areas,
    })
}

/// Where Newton's method ended.
struct Solution {
    triangulation: Triangulation,
    u: Vec<f64>,
    /// What `u` adds to.
    earlier: Vec<f64>,
    iterations: usize,
    corrections: usize,
    flips: usize,
    residual: f64,
}

/// Solves on Delaunay triangulations that change with the metric, takes the flips back, and solves once more on the
/// mesh, whose vertex areas differ from those of the Delaunay triangulation.
fn solve_with_flips(mut triangulation: Triangulation, goal: &Goal) -> Result<Solution, MetricError> {
    let mut log = Vec::new();
    triangulation.flip_to_intrinsic_delaunay(&mut log)?;
    let Solution { mut triangulation, u, iterations, corrections, .. } = solve(triangulation, Some(&mut log), goal)?;
    triangulation.lengths = triangulation.scaled_lengths(&u);
    triangulation.unflip(&log)?;
    let mut last = solve(triangulation, None, goal)?;
    last.iterations += iterations;
    last.corrections += corrections;
    last.flips = log.len();
    last.earlier = u;
    Ok(last)
}

/// Newton's method from `u = 0`. With a log of flips, on Delaunay triangulations, and the log is continued.
fn solve(triangulation: Triangulation, log: Option<&mut Vec<u32>>, goal: &Goal) -> Result<Solution, MetricError> {
    let zero = vec![0.0; triangulation.vertex_count()];
    let mut here = Iterate::new(triangulation, log.as_ref().map(|log| (*log).clone()), zero.clone(), goal)?;
    let (mut iterations, mut corrections) = (0, 0);
    while here.residual() > CURVATURE_TOLERANCE {
        if iterations == MAX_ITERATIONS {
            return Err(here.not_converged(iterations));
        }
        let inverse = LaplacianInverse::new(&here.triangulation, &here.shape, &goal.free, None)?;
        let step = here.newton_step(goal, &inverse);
        let mut length = 1.0;
        here = loop {
            let u = here.u.iter().zip(&step).map(|(u, step)| u - length * step).collect();
            match Iterate::new(here.triangulation.clone(), here.flips.clone(), u, goal) {
                Ok(next) => {
                    let (next, taken) = next.corrected(goal, &inverse)?;
                    let decrease = norm(&next.excess) / norm(&here.excess);
                    if decrease <= 1.0 - SUFFICIENT_DECREASE * length || next.residual() <= CURVATURE_TOLERANCE {
                        corrections += taken;
                        break next;
                    }
                }
                Err(reason) if reason.is_of_long_step() => {}
                Err(other) => return Err(other),
            }
            length *= 0.5;
            if length < SHORTEST_STEP {
                return Err(here.not_converged(iterations));
            }
        };
        iterations += 1;
    }
    let residual = here.residual();
    let Iterate { triangulation, u, flips, .. } = here;
    if let (Some(log), Some(flips)) = (log, flips) {
        *log = flips;
    }
    Ok(Solution { triangulation, u, earlier: zero, iterations, corrections, flips: 0, residual })
}

/// Scale factors and what they imply.
struct Iterate {
    triangulation: Triangulation,
    /// Edges flipped so far; `None` if none may be.
    flips: Option<Vec<u32>>,
    u: Vec<f64>,
    shape: Shape,
    /// Curvature minus target, 0 where the vertex is held.
    excess: Vec<f64>,
}

impl Iterate {
    fn new(
        mut triangulation: Triangulation,
        mut flips: Option<Vec<u32>>,
        u: Vec<f64>,
        goal: &Goal,
    ) -> Result<Iterate, MetricError> {
        if let Some(flips) = &mut flips {
            triangulation.flip_to_delaunay(&u, flips)?;
        }
        let shape = triangulation.shape(&u)?;
        let target = goal.curvature(&triangulation, &shape);
        let excess = shape.curvature.iter().zip(&target).map(|(curvature, target)| curvature - target).collect();
        Ok(Iterate { triangulation, flips, u, shape, excess })
    }

    fn residual(&self) -> f64 {
        self.excess.iter().fold(0.0, |most, excess| excess.abs().max(most))
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
    /// this brings a long Newton step back to the curved family of metrics that differ by such a transformation;
    /// without it Newton follows that family in many short steps.
    fn corrected(mut self, goal: &Goal, inverse: &LaplacianInverse) -> Result<(Iterate, usize), MetricError> {
        for taken in 0..MAX_CORRECTIONS {
            if self.residual() <= CURVATURE_TOLERANCE {
                return Ok((self, taken));
            }
            let change = inverse.apply(&self.excess);
            let u = self.u.iter().zip(&change).map(|(u, change)| u - change).collect();
            match Iterate::new(self.triangulation.clone(), self.flips.clone(), u, goal) {
                Ok(next) if norm(&next.excess) < CORRECTION_DECREASE * norm(&self.excess) => self = next,
                Err(reason) if !reason.is_of_long_step() => return Err(reason),
                Ok(_) | Err(_) => return Ok((self, taken)),
            }
        }
        Ok((self, MAX_CORRECTIONS))
    }

    fn not_converged(&self, iterations: usize) -> MetricError {
        let worst = (0..self.excess.len()).max_by(|&a, &b| self.excess[a].abs().total_cmp(&self.excess[b].abs()));
        MetricError::NotConverged { iterations, residual: self.residual(), vertex: worst.unwrap_or(0) }
    }
}
