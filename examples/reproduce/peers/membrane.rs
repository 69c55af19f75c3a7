//! A membrane with decreasing bending: positions, squared strains of edges and squared mean curvature. It knows no orientations.

use crate::request::Outcome;
use glam::DVec3;
use immerse::Metric;
use immerse::algebra::SparseCholesky;
use immerse::frames::random_frames;
use immerse::mesh::Mesh;
use std::collections::{BTreeMap, VecDeque};

/// Weights of bending as shares of the area, one stage each.
pub const FROM_STIFF: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
/// The same without the stiff stages, which forget where they started.
pub const FROM_SOFT: [f64; 2] = [1e-6, 1e-7];
/// The most steps of a stage.
const STEPS: usize = 1500;
/// A stage ends where a step lowers the energy by less than this share.
const TOLERANCE: f64 = 1e-7;
/// Steps that L-BFGS remembers.
const MEMORY: usize = 12;

/// In a ball as large as a round sphere of that area.
pub fn random_positions(mesh: &Mesh, metric: &Metric, seed: u64) -> Vec<DVec3> {
    let radius = (metric.total_area() / (4.0 * std::f64::consts::PI)).sqrt();
    // The vector part of a unit quaternion lies in the unit ball.
    random_frames(mesh.vertex_count(), seed).into_iter().map(|q| radius * DVec3::new(q.x, q.y, q.z)).collect()
}

/// Lowers the energy stage by stage. Gives the number of steps.
pub fn relax(mesh: &Mesh, metric: &Metric, bending: &[f64], positions: &mut Vec<DVec3>) -> Outcome<usize> {
    let mut steps = 0;
    for share in bending {
        steps += Energy::new(mesh, metric, share * metric.total_area()).descend(positions)?;
    }
    Ok(steps)
}

/// ½ Σ area (|d|/ℓ − 1)² + ½ κ Σ |Δx|² area.
struct Energy<'a> {
    mesh: &'a Mesh,
    metric: &'a Metric,
    /// Area of each edge.
    edge_area: f64,
    kappa: f64,
    vertex_areas: Vec<f64>,
}

impl<'a> Energy<'a> {
    fn new(mesh: &'a Mesh, metric: &'a Metric, kappa: f64) -> Energy<'a> {
        let edge_area = metric.total_area() / mesh.edge_count() as f64;
        Energy { mesh, metric, edge_area, kappa, vertex_areas: metric.vertex_areas(mesh) }
    }

    /// The stiffness matrix of the Laplacian applied to positions.
    fn laplacian(&self, x: &[DVec3]) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; x.len()];
        for e in self.mesh.edges() {
            let [a, b] = self.mesh.edge_vertices(e).map(|v| v.index());
            let difference = self.metric.primal_weight(e) * (x[a] - x[b]);
            sums[a] += difference;
            sums[b] -= difference;
        }
        sums
    }

    fn value_and_gradient(&self, x: &[DVec3]) -> (f64, Vec<DVec3>) {
        let curvature: Vec<DVec3> =
            self.laplacian(x).into_iter().zip(&self.vertex_areas).map(|(l, a)| l / *a).collect();
        let squares: f64 = curvature.iter().zip(&self.vertex_areas).map(|(c, a)| a * c.length_squared()).sum();
        let mut value = 0.5 * self.kappa * squares;
        let mut gradient: Vec<DVec3> = self.laplacian(&curvature).into_iter().map(|l| self.kappa * l).collect();
        for e in self.mesh.edges() {
            let [a, b] = self.mesh.edge_vertices(e).map(|v| v.index());
            let (d, length) = (x[a] - x[b], self.metric.length(e));
            let strain = d.length() / length - 1.0;
            value += 0.5 * self.edge_area * strain * strain;
            let force = self.edge_area * strain / length * d.normalize_or_zero();
            gradient[a] += force;
            gradient[b] -= force;
        }
        (value, gradient)
    }

    /// The matrix that preconditions: springs that forget where they point, bending as it is, and a little mass.
    fn factorized(&self) -> Outcome<SparseCholesky> {
        let mut entries = BTreeMap::new();
        let mut add = |a: usize, b: usize, value: f64| *entries.entry((a.max(b), a.min(b))).or_insert(0.0) += value;
        let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.mesh.vertex_count()];
        let mut spring_sum = 0.0;
        for e in self.mesh.edges() {
            let [a, b] = self.mesh.edge_vertices(e).map(|v| v.index());
            let length = self.metric.length(e);
            let spring = self.edge_area / (length * length);
            spring_sum += spring;
            add(a, a, spring);
            add(b, b, spring);
            add(a, b, -spring);
            let weight = self.metric.primal_weight(e);
            rows[a].push((b, -weight));
            rows[b].push((a, -weight));
        }
        let mass = 1e-6 * spring_sum / self.mesh.vertex_count() as f64;
        for (v, row) in rows.iter_mut().enumerate() {
            add(v, v, mass);
            let diagonal = -row.iter().map(|(_, weight)| weight).sum::<f64>();
            row.push((v, diagonal));
            let scale = self.kappa / self.vertex_areas[v];
            for &(a, of_a) in row.iter() {
                row.iter().filter(|(b, _)| *b <= a).for_each(|&(b, of_b)| add(a, b, scale * of_a * of_b));
            }
        }
        let lower: Vec<(usize, usize, f64)> =
            entries.into_iter().map(|((row, column), value)| (row, column, value)).collect();
        Ok(SparseCholesky::new(self.mesh.vertex_count(), &lower)?)
    }

    /// L-BFGS until steps no longer help. Gives their number.
    fn descend(&self, x: &mut Vec<DVec3>) -> Outcome<usize> {
        let factorized = self.factorized()?;
        let mut memory: VecDeque<[Vec<DVec3>; 2]> = VecDeque::new();
        let (mut value, mut gradient) = self.value_and_gradient(x);
        let mut idle = 0;
        for step in 1..=STEPS {
            let direction = direction(&factorized, &memory, &gradient);
            let slope = dot(&direction, &gradient);
            let mut length = 1.0;
            let moved = loop {
                let next: Vec<DVec3> = x.iter().zip(&direction).map(|(x, d)| *x + length * *d).collect();
                let (next_value, next_gradient) = self.value_and_gradient(&next);
                if next_value <= value + 1e-4 * length * slope {
                    break Some((next, next_value, next_gradient));
                }
                length *= 0.5;
                if length < 1e-8 {
                    break None;
                }
            };
            let Some((next, next_value, next_gradient)) = moved else {
                // Once more without what is remembered.
                if memory.is_empty() {
                    return Ok(step);
                }
                memory.clear();
                continue;
            };
            let pair = [difference(&next, x), difference(&next_gradient, &gradient)];
            if dot(&pair[0], &pair[1]) > 0.0 {
                memory.push_back(pair);
                memory.drain(..memory.len().saturating_sub(MEMORY));
            }
            idle = if value - next_value < TOLERANCE * value { idle + 1 } else { 0 };
            (*x, value, gradient) = (next, next_value, next_gradient);
            if idle >= 10 {
                return Ok(step);
            }
        }
        Ok(STEPS)
    }
}

/// The direction of L-BFGS, by the two loops of Nocedal.
fn direction(factorized: &SparseCholesky, memory: &VecDeque<[Vec<DVec3>; 2]>, gradient: &[DVec3]) -> Vec<DVec3> {
    let mut q: Vec<DVec3> = gradient.iter().map(|g| -*g).collect();
    let mut shares = Vec::new();
    for [s, y] in memory.iter().rev() {
        let share = dot(s, &q) / dot(s, y);
        q.iter_mut().zip(y).for_each(|(q, y)| *q -= share * *y);
        shares.push(share);
    }
    factorized.solve(&mut q);
    for ([s, y], share) in memory.iter().zip(shares.into_iter().rev()) {
        let back = dot(y, &q) / dot(s, y);
        q.iter_mut().zip(s).for_each(|(q, s)| *q += (share - back) * *s);
    }
    q
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn difference(a: &[DVec3], b: &[DVec3]) -> Vec<DVec3> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}
