//! Ricci flow as discrete conformal scaling, integrated in time.

use super::linear::LaplacianInverse;
use super::target::{CurvatureTarget, Goal};
use super::triangulation::{Shape, Triangulation};
use super::uniformize::{Conformal, uniformize};
use crate::mesh::Mesh;
use crate::metric::{Metric, MetricError};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Estimated error of the log scale factors that a step may make. The estimate is that of a method of order one,
/// the result of order two is better.
const STEP_TOLERANCE: f64 = 1e-3;
/// Steps shorter than this mean that a triangle is about to degenerate.
const SHORTEST_STEP: f64 = 1e-8;
const FIRST_STEP: f64 = 1e-4;
const LONGEST_STEP: f64 = 0.25;
/// Makes the two-stage Rosenbrock method L-stable.
const GAMMA: f64 = 1.0 - FRAC_1_SQRT_2;

/// The flow `dg/dt = (K̂ − K) g` of Eq. 22 (there for target curvature K̂ = 0), on a mesh of fixed connectivity.
///
/// Discretely `du_i/dt = (K̂_i − K_i) / 2A_i` for the log scale factors `u` of discrete conformal equivalence, with
/// the vertex areas of the metric at that time, so that the speed does not depend on the mesh (the flow of Luo 2004
/// has no areas). Time is in units of `area/4π`, the squared radius of the round sphere of that area, so that it does
/// not depend on the scale either. The distance from the limit falls off exponentially, to about 1 % at `t = 5`.
///
/// Curvature in proportion to area moves with the areas during the flow. Only where it is positive `K̂_i` is that of
/// the limit at all times: spheres, which have many round metrics in one conformal class, would drift among them.
/// The flow keeps the area or, where the target decrees another, changes it as `goal (start/goal)^exp(−t)`.
///
/// Integrated by a linearly implicit method of order two whose matrix is the cotangent Laplacian (ROS2: Verwer,
/// Spee, Blom and Hundsdorfer 1999) in steps chosen by its error. Between steps `u` is interpolated, so the metric
/// at a time does not depend on which other times were asked for.
#[derive(Clone, Debug)]
pub struct RicciFlow {
    triangulation: Triangulation,
    /// What the flow aims at on its way.
    goal: Goal,
    /// What was asked for.
    asked: Goal,
    limit: Conformal,
    initial_area: f64,
    /// Where the last step ended.
    state: State,
    /// The last step; none at time 0.
    last: Option<Step>,
    /// Length of the next step.
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

/// A step of the integrator, with the two stages that tell what happened during it.
#[derive(Clone, Debug)]
struct Step {
    start: f64,
    length: f64,
    u: Vec<f64>,
    stages: [Vec<f64>; 2],
}

impl RicciFlow {
    /// Starts at the metric of the given lengths (|E|), and finds the limit.
    ///
    /// # Errors
    /// What [`uniformize`] refuses.
    pub fn new(mesh: &Mesh, edge_lengths: &[f64], target: &CurvatureTarget) -> Result<RicciFlow, MetricError> {
        let limit = uniformize(mesh, edge_lengths, target)?;
        let metric = Metric::new(mesh, edge_lengths.to_vec())?;
        let mut asked = Goal::new(target, mesh, &metric)?;
        let triangulation = Triangulation::new(mesh, edge_lengths);
        if limit.by_initial_areas {
            asked.spread_by_areas_of(&triangulation, &triangulation.shape(&vec![0.0; mesh.vertex_count()])?);
        }
        let mut goal = asked.clone();
        let end = Triangulation::new(mesh, &limit.edge_lengths);
        goal.settle_positive(&end, &end.shape(&vec![0.0; mesh.vertex_count()])?);
        let state = state(&triangulation, &goal, 0.0, vec![0.0; mesh.vertex_count()])?;
        let initial_area = metric.total_area();
        Ok(RicciFlow { triangulation, goal, asked, limit, initial_area, state, last: None, step: FIRST_STEP })
    }

    /// The metric that the flow tends to, with curvature as exact as that of [`uniformize`].
    pub fn limit(&self) -> &Conformal {
        &self.limit
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
        if time == 0.0 {
            return Ok(vec![0.0; self.state.u.len()]);
        }
        if self.last.as_ref().is_some_and(|step| time < step.start) {
            self.state = state(&self.triangulation, &self.goal, 0.0, vec![0.0; self.state.u.len()])?;
            (self.last, self.step) = (None, FIRST_STEP);
        }
        while self.state.time < time {
            self.advance()?;
        }
        let mut u = match &self.last {
            Some(step) if time < self.state.time => step.after((time - step.start) / step.length),
            _ => self.state.u.clone(),
        };
        let scale = self.goal.scale_shift(&self.triangulation, &u, self.initial_area, time)?;
        u.iter_mut().for_each(|u| *u += scale);
        Ok(u)
    }

    /// How far the curvature of any vertex of a metric (|E| lengths) is from its target, in radians.
    ///
    /// # Errors
    /// [`MetricError::TriangleInequality`], [`MetricError::TooThin`]
    pub fn curvature_error(&self, mesh: &Mesh, edge_lengths: &[f64]) -> Result<f64, MetricError> {
        let triangulation = Triangulation::new(mesh, edge_lengths);
        let shape = triangulation.shape(&vec![0.0; mesh.vertex_count()])?;
        let target = self.asked.curvature(&triangulation, &shape);
        Ok(shape.curvature.iter().zip(target).map(|(k, target)| (k - target).abs()).fold(0.0, f64::max))
    }

    /// One step of the length that the error allows.
    fn advance(&mut self) -> Result<(), MetricError> {
        loop {
            let blocked = match self.try_step() {
                Ok((step, next, error)) => {
                    let change = (0.9 * (STEP_TOLERANCE / error).sqrt()).clamp(0.2, 4.0);
                    self.step = (self.step * change).min(LONGEST_STEP);
                    if error <= STEP_TOLERANCE {
                        (self.last, self.state) = (Some(step), next);
                        return Ok(());
                    }
                    None
                }
                Err(reason) => {
                    self.step *= 0.25;
                    Some(reason.degenerate_face().ok_or(reason)?)
                }
            };
            if self.step < SHORTEST_STEP {
                let thinnest = || self.triangulation.thinnest_face(&self.state.shape);
                let (face, vertices) = blocked.unwrap_or_else(thinnest);
                return Err(MetricError::FlowBlocked { time: self.state.time, face, vertices });
            }
        }
    }

    /// One step, the state after it, and an estimate of the largest error in that.
    fn try_step(&self) -> Result<(Step, State, f64), MetricError> {
        let (from, h) = (&self.state, self.step);
        // (I + γ h J) k = r with J = A⁻¹ (½ area/4π) L, multiplied by what stands before L. Negative target
        // densities c add −2cA, the derivative of the target by the areas in the limit of fine meshes.
        let pace = pace(&from.shape);
        let mass: Vec<f64> = from.shape.areas.iter().map(|area| area / (GAMMA * h * pace)).collect();
        let densities = self.goal.densities(&self.triangulation, &from.shape);
        let diagonal: Vec<f64> =
            (0..mass.len()).map(|v| mass[v] - 2.0 * densities[v].min(0.0) * from.shape.areas[v]).collect();
        let inverse = LaplacianInverse::new(&self.triangulation, &from.shape, &self.goal.free, Some(&diagonal))?;
        let solve = |r: &[f64]| inverse.apply(&r.iter().zip(&mass).map(|(r, m)| r * m).collect::<Vec<_>>());

        let first = solve(&from.speed);
        let middle = from.u.iter().zip(&first).map(|(u, k)| u + h * k).collect();
        let middle = state(&self.triangulation, &self.goal, from.time + h, middle)?;
        let second = solve(&middle.speed.iter().zip(&first).map(|(f, k)| f - 2.0 * k).collect::<Vec<_>>());
        let error = first.iter().zip(&second).map(|(a, b)| (0.5 * h * (a + b)).abs()).fold(0.0, f64::max);
        let step = Step { start: from.time, length: h, u: from.u.clone(), stages: [first, second] };
        let next = state(&self.triangulation, &self.goal, from.time + h, step.after(1.0))?;
        Ok((step, next, error))
    }
}

impl Step {
    /// The scale factors after a part of the step, of order two like its end, and as insensitive to stiffness.
    fn after(&self, part: f64) -> Vec<f64> {
        let [first, second] = &self.stages;
        let b = (0.5 * part * part - GAMMA * part) / (1.0 - 2.0 * GAMMA);
        let (a, b) = (self.length * (part + b), self.length * b);
        (0..self.u.len()).map(|v| self.u[v] + a * first[v] + b * second[v]).collect()
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
