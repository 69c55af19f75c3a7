//! Ricci flow as discrete conformal scaling, integrated in time.

use super::conformal_linear::LaplacianInverse;
use super::conformal_target::{CurvatureTarget, Goal};
use super::conformal_triangulation::{Shape, Triangulation};
use super::{Metric, MetricError};
use crate::mesh::Mesh;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Estimated error of the log scale factors that a step may make.
const STEP_TOLERANCE: f64 = 1e-4;
/// Steps shorter than this mean that a triangle is about to degenerate.
const SHORTEST_STEP: f64 = 1e-8;
const FIRST_STEP: f64 = 1e-4;
/// Makes the two-stage Rosenbrock method L-stable.
const GAMMA: f64 = 1.0 - FRAC_1_SQRT_2;

/// The flow `dg/dt = (K̂ − K) g` of Eq. 22 (there for target curvature K̂ = 0), on a mesh of fixed connectivity.
///
/// Discretely `du_i/dt = (K̂_i − K_i) / 2A_i` for the log scale factors `u`, with the vertex areas of the metric
/// at that time, so that the speed does not depend on the mesh (Luo 2004 has the flow without areas). Time is in
/// units of `area/4π`, the squared radius of the round sphere of that area, so that it does not depend on the scale
/// either; what remains of the initial curvature falls off exponentially, to 1 % by `t = 5` or so. The flow keeps
/// the area or, where the target decrees another one, changes it as `area = goal (start/goal)^exp(−t)`.
///
/// Integrated by a linearly implicit method of order two whose matrix is the cotangent Laplacian (ROS2: Verwer,
/// Spee, Blom and Hundsdorfer 1999) in steps chosen by its error. Between steps `u` is interpolated, so the metric
/// at a time does not depend on which other times were asked for.
#[derive(Clone, Debug)]
pub struct RicciFlow {
    triangulation: Triangulation,
    goal: Goal,
    initial_area: f64,
    last: State,
    next: State,
    step: f64,
}

/// Log scale factors, up to a constant, with their speed.
#[derive(Clone, Debug)]
struct State {
    time: f64,
    u: Vec<f64>,
    shape: Shape,
    speed: Vec<f64>,
}

impl RicciFlow {
    /// Starts at the metric of the given lengths (|E|).
    ///
    /// # Errors
    /// What [`Metric::new`] refuses about lengths and [`super::uniformize`] about targets.
    pub fn new(mesh: &Mesh, edge_lengths: &[f64], target: &CurvatureTarget) -> Result<RicciFlow, MetricError> {
        let metric = Metric::new(mesh, edge_lengths.to_vec())?;
        let goal = Goal::new(target, mesh, &metric)?;
        let triangulation = Triangulation::new(mesh, edge_lengths);
        let state = state(&triangulation, &goal, 0.0, vec![0.0; mesh.vertex_count()])?;
        Ok(RicciFlow {
            triangulation,
            goal,
            initial_area: metric.total_area(),
            last: state.clone(),
            next: state,
            step: FIRST_STEP,
        })
    }

    /// The edge lengths (|E|) at a time of at least 0.
    ///
    /// Cheapest for increasing times; earlier ones start over and give the same bits.
    ///
    /// # Errors
    /// [`MetricError::FlowTime`] for times that are negative or not finite, [`MetricError::FlowBlocked`] with time
    /// and face where a triangle degenerates before.
    pub fn advance_to(&mut self, time: f64) -> Result<Vec<f64>, MetricError> {
        let u = self.log_scale_at(time)?;
        Ok(self.triangulation.scaled_lengths(&u))
    }

    /// The log scale factors (|V|) at a time of at least 0, see [`RicciFlow::advance_to`].
    ///
    /// # Errors
    /// As [`RicciFlow::advance_to`].
    pub fn log_scale_at(&mut self, time: f64) -> Result<Vec<f64>, MetricError> {
        if !(time.is_finite() && time >= 0.0) {
            return Err(MetricError::FlowTime { time });
        }
        if time < self.last.time {
            let start = state(&self.triangulation, &self.goal, 0.0, vec![0.0; self.last.u.len()])?;
            (self.last, self.next, self.step) = (start.clone(), start, FIRST_STEP);
        }
        while self.next.time < time {
            self.advance()?;
        }
        let mut u = interpolate(&self.last, &self.next, time);
        self.goal.fix_scale(&self.triangulation, &mut u, self.initial_area, time)?;
        Ok(u)
    }

    /// One step of the length that the error allows.
    fn advance(&mut self) -> Result<(), MetricError> {
        loop {
            let blocked = match self.try_step() {
                Ok((next, error)) => {
                    let change = (0.9 * (STEP_TOLERANCE / error).sqrt()).clamp(0.2, 4.0);
                    self.step *= change;
                    if error <= STEP_TOLERANCE {
                        self.last = std::mem::replace(&mut self.next, next);
                        return Ok(());
                    }
                    None
                }
                Err(reason @ MetricError::TriangleInequality { .. }) => {
                    self.step *= 0.25;
                    Some(reason)
                }
                Err(other) => return Err(other),
            };
            if self.step < SHORTEST_STEP {
                let (face, vertices) = match blocked {
                    Some(MetricError::TriangleInequality { face, vertices, .. }) => (face, vertices),
                    _ => self.triangulation.thinnest_face(&self.next.shape),
                };
                return Err(MetricError::FlowBlocked { time: self.next.time, face, vertices });
            }
        }
    }

    /// The state one step later, and an estimate of the largest error in it.
    fn try_step(&self) -> Result<(State, f64), MetricError> {
        let (from, h) = (&self.next, self.step);
        // (I + γ h J) k = r with J = A⁻¹ (½ area/4π) L, multiplied by what stands before L. Negative target
        // densities c add −2cA, the derivative of the target by the areas in the limit of fine meshes.
        let pace = pace(&from.shape);
        let mass: Vec<f64> = from.shape.areas.iter().map(|area| area / (GAMMA * h * pace)).collect();
        let density = self.goal.density(&self.triangulation, &from.shape).min(0.0);
        let diagonal: Vec<f64> = from.shape.areas.iter().zip(&mass).map(|(a, m)| m - 2.0 * density * a).collect();
        let inverse = LaplacianInverse::new(&self.triangulation, &from.shape, &self.goal.free, Some(&diagonal))?;
        let solve = |r: Vec<f64>| inverse.apply(&r.iter().zip(&mass).map(|(r, m)| r * m).collect::<Vec<_>>());

        let first = solve(from.speed.clone());
        let middle: Vec<f64> = from.u.iter().zip(&first).map(|(u, k)| u + h * k).collect();
        let middle = state(&self.triangulation, &self.goal, from.time + h, middle)?;
        let second = solve(middle.speed.iter().zip(&first).map(|(f, k)| f - 2.0 * k).collect());
        let u = (0..first.len()).map(|v| from.u[v] + h * (1.5 * first[v] + 0.5 * second[v])).collect();
        let error = first.iter().zip(&second).map(|(a, b)| (0.5 * h * (a + b)).abs()).fold(0.0, f64::max);
        Ok((state(&self.triangulation, &self.goal, from.time + h, u)?, error))
    }
}

fn state(triangulation: &Triangulation, goal: &Goal, time: f64, u: Vec<f64>) -> Result<State, MetricError> {
    let shape = triangulation.shape(&u)?;
    let pace = pace(&shape);
    let target = goal.curvature(triangulation, &shape);
    let speed = (0..u.len()).map(|v| pace * (target[v] - shape.curvature[v]) / shape.areas[v]).collect();
    Ok(State { time, u, shape, speed })
}

/// Half the unit of time.
fn pace(shape: &Shape) -> f64 {
    0.5 * shape.areas.iter().sum::<f64>() / (4.0 * PI)
}

/// Cubic through both states with their speeds.
fn interpolate(a: &State, b: &State, time: f64) -> Vec<f64> {
    let h = b.time - a.time;
    if h == 0.0 {
        return b.u.clone();
    }
    let s = (time - a.time) / h;
    let r = 1.0 - s;
    (0..a.u.len())
        .map(|v| {
            r * r * (1.0 + 2.0 * s) * a.u[v]
                + s * s * (1.0 + 2.0 * r) * b.u[v]
                + s * r * h * (r * a.speed[v] - s * b.speed[v])
        })
        .collect()
}
