//! The measures of a frame.

use super::follow::strain;
use super::places::{BendingSums, worst_places};
use super::relaxation::Relaxation;
use super::simulation::Previous;
use super::{ComponentReport, Cursor, Frame, FrameReport, NO_CLASS, Pace, Simulation};
use crate::frames::energy;
use crate::immersion::*;
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::Metric;
use crate::spin::class_digits;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

impl Simulation {
    /// Rims and measures of the frames as they are and the positions they integrate to.
    pub(super) fn realize(&mut self, positions: Vec<DVec3>) -> Frame {
        let Self { mesh, metric, homology, .. } = &*self;
        let parts: Vec<Part> = self.components.iter().map(|relaxation| Part::of(relaxation, &positions)).collect();
        let mut rims: Vec<EdgeId> = parts.iter().flat_map(|part| part.rims.iter().copied()).collect();
        rims.sort_unstable();
        let pinch_points = pinch_points(mesh, &positions);
        let error = length_error(mesh, metric, &positions);
        let class: Vec<bool> = homology.generators().iter().map(|g| is_figure_8(mesh, &positions, &g.strip)).collect();
        let cursors: Vec<Cursor> = self.components.iter().map(|relaxation| relaxation.cursor).collect();
        let sum = |value: fn(&Part) -> f64| parts.iter().map(value).sum::<f64>();
        let mut report = FrameReport {
            frame: self.frame,
            time: self.time,
            l2_length_error: error.l2,
            max_length_error: error.max,
            median_length_error: error.median,
            p95_length_error: error.p95,
            rims: rims.len(),
            rim_length: rims.iter().map(|&e| metric.length(e)).sum(),
            pinch_points: pinch_points.len(),
            spin_class: if pinch_points.is_empty() { class_digits(&class) } else { NO_CLASS.into() },
            asked_class: self.components.iter().map(|relaxation| class_digits(&relaxation.class)).collect(),
            energy: sum(|part| part.energy),
            period_error: (sum(|part| part.periods[0]) / sum(|part| part.periods[1])).sqrt(),
            curvature_error: self.curvature_error,
            mean_distance: parts
                .iter()
                .all(|part| part.mean_distance.is_some())
                .then(|| sum(|part| part.area * part.mean_distance.unwrap_or_default()) / sum(|part| part.area)),
            pin_distance: parts.iter().filter_map(|part| part.pin_distance).reduce(f64::max),
            enclosed_volume: enclosed_volume(mesh, &positions),
            largest_dent: parts.iter().map(|part| part.dent).reduce(|a, b| Some(a?.max(b?))).flatten(),
            bending_error: parts
                .iter()
                .filter_map(|part| part.bending)
                .reduce(BendingSums::with)
                .map(|sums| sums.error()),
            places: worst_places(mesh, metric, &positions, &rims, &pinch_points),
            cursor: Cursor::of_all(&cursors),
            converged: self.components.iter().all(Relaxation::has_converged),
            on_the_way: matches!(self.pace, Pace::Steps(_))
                && (self.course.changes() || self.components.iter().any(Relaxation::is_on_the_way)),
            ..FrameReport::default()
        };
        if parts.len() > 1 {
            report.components = parts.into_iter().map(|part| part.report).collect();
        }
        if let Some(previous) = &self.previous {
            let mut moves: Vec<f64> = positions.iter().zip(&previous.positions).map(|(a, b)| a.distance(*b)).collect();
            moves.sort_unstable_by(f64::total_cmp);
            report.median_move = moves[moves.len() / 2];
            report.max_move = moves[moves.len() - 1];
            report.strain = strain(&previous.edge_lengths, metric.edge_lengths());
            [report.rims_born, report.rims_died, report.rims_moved] = rim_changes(mesh, &previous.rims, &rims);
        }
        self.previous = Some(Previous {
            positions: positions.clone(),
            rims: rims.clone(),
            edge_lengths: metric.edge_lengths().to_vec(),
        });
        Frame { positions, rims, pinch_points, report }
    }
}

/// The measures of one component.
struct Part {
    /// Numbered as in the whole.
    rims: Vec<EdgeId>,
    area: f64,
    energy: f64,
    /// Squared norms of the harmonic part of the edge vectors and of the edge lengths.
    periods: [f64; 2],
    mean_distance: Option<f64>,
    dent: Option<f64>,
    bending: Option<BendingSums>,
    /// The largest distance of a pinned vertex from its place; `None` without pins.
    pin_distance: Option<f64>,
    report: ComponentReport,
}

impl Part {
    /// `positions` are those of the whole.
    fn of(relaxation: &Relaxation, positions: &[DVec3]) -> Part {
        let Relaxation { component, metric, parts, face_frames, phases, .. } = relaxation;
        let mesh = &*component.mesh;
        let positions = component.vertices.pick(positions);
        let rims = rims(&parts.shell, &frames_of_positions(mesh, metric, &positions, face_frames));
        let stiffness = phases.last().map_or([1.0; 4], |phase| phase.step.stiffness);
        let vectors = edge_vectors(mesh, metric, face_frames);
        let pin_distances = relaxation.places.iter().map(|(v, place)| positions[v.index()].distance(*place));
        let mut report = ComponentReport {
            faces: mesh.face_count(),
            rims: rims.len(),
            cursor: relaxation.cursor,
            converged: relaxation.has_converged(),
            ..ComponentReport::default()
        };
        if relaxation.of > 1 {
            let error = length_error(mesh, metric, &positions);
            (report.l2_length_error, report.max_length_error) = (error.l2, error.max);
            report.pinch_points = pinch_points(mesh, &positions).len();
        }
        Part {
            rims: rims.into_iter().map(|e| EdgeId::new(component.edges.whole(e.index()))).collect(),
            area: metric.total_area(),
            energy: energy(&parts.shell, stiffness, face_frames),
            periods: parts.periods.squared_norms(mesh, metric, &vectors),
            mean_distance: relaxation.original.as_ref().map(|o| mean_distance(mesh, metric, o, &positions)),
            dent: relaxation.dent(&positions),
            bending: BendingSums::of(relaxation, &positions),
            pin_distance: pin_distances.reduce(f64::max),
            report,
        }
    }
}

/// Mean distance of a surface from the original after rigid alignment, over the original's diameter.
fn mean_distance(mesh: &Mesh, metric: &Metric, original: &[DVec3], positions: &[DVec3]) -> f64 {
    let areas = metric.vertex_areas(mesh);
    let motion = RigidMotion::onto(original, positions, &areas);
    let distance = |((p, q), area): ((&DVec3, &DVec3), &f64)| area * motion.point(*p).distance(*q);
    let sum: f64 = positions.iter().zip(original).zip(&areas).map(distance).sum();
    sum / areas.iter().sum::<f64>() / diameter(original)
}

/// The largest distance that walking to the farthest point finds: the diameter or little less.
fn diameter(points: &[DVec3]) -> f64 {
    let mut longest: f64 = 0.0;
    let mut from = points[0];
    for _ in 0..4 {
        let far = points.par_iter().copied().map(|p| (p.distance_squared(from), p));
        let Some((squared, to)) = far.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        longest = longest.max(squared.sqrt());
        from = to;
    }
    longest
}

/// Rims that appeared, vanished, and moved to an edge that shares a vertex. Both lists are in order.
fn rim_changes(mesh: &Mesh, before: &[EdgeId], after: &[EdgeId]) -> [usize; 3] {
    let without = |list: &[EdgeId], others: &[EdgeId]| -> Vec<EdgeId> {
        list.iter().filter(|e| others.binary_search(e).is_err()).copied().collect()
    };
    let gone = without(before, after);
    // Which of those that are gone end at a vertex, the last one first.
    let mut at_vertices: HashMap<VertexId, Vec<usize>> = HashMap::new();
    for (k, e) in gone.iter().enumerate().rev() {
        mesh.edge_vertices(*e).into_iter().for_each(|v| at_vertices.entry(v).or_default().push(k));
    }
    let (mut born, mut moved) = (0, 0);
    let mut is_taken = vec![false; gone.len()];
    for e in without(after, before) {
        let mut first_at = |v| {
            let list = at_vertices.get_mut(&v)?;
            while list.pop_if(|k| is_taken[*k]).is_some() {}
            list.last().copied()
        };
        let [a, b] = mesh.edge_vertices(e).map(&mut first_at);
        match [a, b].into_iter().flatten().min() {
            Some(k) => {
                is_taken[k] = true;
                moved += 1;
            }
            None => born += 1,
        }
    }
    [born, gone.len() - moved, moved]
}
