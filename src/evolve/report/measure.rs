//! The measures of a frame.

use super::frame_report::{ComponentReport, FrameReport, NO_CLASS};
use super::worst_places::{BendingSums, worst_places};
use crate::evolve::frame::Frame;
use crate::evolve::relax::{Cursor, Relaxation};
use crate::frames::{Stiffness, energy};
use crate::immersion::{RigidMotion, class_of_positions, enclosed_volume, length_error, pinch_points};
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::{Metric, largest_strain};
use crate::polish::{Ending, PolishReport};
use crate::spin::Homology;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Rims of a surface at these positions, |V|, and what it is worth. What is known only of the film (number and time of the
/// frame, changes since the one before) is left to the caller.
pub(in crate::evolve) fn measure(
    mesh: &Mesh,
    metric: &Metric,
    homology: &Homology,
    components: &[Relaxation],
    positions: &[DVec3],
    polish: &[PolishReport],
) -> (Vec<EdgeId>, FrameReport) {
    let part = |(k, relaxation)| Part::of(relaxation, positions, polish.get(k));
    let parts: Vec<Part> = components.iter().enumerate().map(part).collect();
    let mut rims: Vec<EdgeId> = parts.iter().flat_map(|part| part.rims.iter().copied()).collect();
    rims.sort_unstable();
    let pinch_points = pinch_points(mesh, positions);
    let error = length_error(mesh, metric, positions);
    let class = || class_of_positions(mesh, homology, positions).to_string();
    let cursors: Vec<Cursor> = components.iter().map(Relaxation::cursor).collect();
    let sum = |value: fn(&Part) -> f64| parts.iter().map(value).sum::<f64>();
    let bending = parts.iter().filter_map(|part| part.bending).reduce(BendingSums::with);
    let mut report = FrameReport {
        l2_length_error: error.l2,
        max_length_error: error.max,
        median_length_error: error.median,
        p95_length_error: error.p95,
        rims: rims.len(),
        rim_length: rims.iter().map(|&e| metric.length(e)).sum(),
        pinch_points: pinch_points.len(),
        spin_class: if pinch_points.is_empty() { class() } else { NO_CLASS.into() },
        asked_class: components.iter().map(|relaxation| relaxation.state().class().to_string()).collect(),
        energy: sum(|part| part.energy),
        stiffness: stiffness_of(components.first()),
        period_error: (sum(|part| part.periods[0]) / sum(|part| part.periods[1])).sqrt(),
        mean_distance: parts
            .iter()
            .all(|part| part.mean_distance.is_some())
            .then(|| sum(|part| part.area * part.mean_distance.unwrap_or_default()) / sum(|part| part.area)),
        pin_distance: parts.iter().filter_map(|part| part.pin_distance).reduce(f64::max),
        enclosed_volume: enclosed_volume(mesh, positions),
        largest_dent: parts.iter().map(|part| part.dent).reduce(|a, b| Some(a?.max(b?))).flatten(),
        bending_error: bending.map(|sums| sums.error()),
        polish: whole(polish, components),
        places: worst_places(mesh, metric, positions, &rims, &pinch_points),
        cursor: Cursor::of_all(&cursors),
        converged: components.iter().all(Relaxation::has_converged),
        ..FrameReport::default()
    };
    if parts.len() > 1 {
        report.components = parts.into_iter().map(|part| part.report).collect();
    }
    (rims, report)
}

/// What has changed since the frame before.
pub(in crate::evolve) fn compare(mesh: &Mesh, previous: &Frame, frame: &mut Frame) {
    let mut moves: Vec<f64> = frame.positions.iter().zip(&previous.positions).map(|(a, b)| a.distance(*b)).collect();
    moves.sort_unstable_by(f64::total_cmp);
    let report = &mut frame.report;
    report.median_move = moves[moves.len() / 2];
    report.max_move = moves[moves.len() - 1];
    report.strain = largest_strain(&previous.edge_lengths, &frame.edge_lengths);
    [report.rims_born, report.rims_died, report.rims_moved] = rim_changes(mesh, &previous.rims, &frame.rims);
}

/// What polish did to the whole surface, from what it did to its components, if it did; it ended as that one did which came
/// least far.
fn whole(reports: &[PolishReport], components: &[Relaxation]) -> Option<PolishReport> {
    if let [] | [_] = reports {
        return reports.first().copied();
    }
    let edges = |k: usize| components[k].state().mesh().edge_count() as f64;
    let total: f64 = (0..reports.len()).map(edges).sum();
    let mean = |value: fn(&PolishReport) -> f64| {
        reports.iter().enumerate().map(|(k, report)| edges(k) * value(report)).sum::<f64>() / total
    };
    Some(PolishReport {
        l2_length_error_before: mean(|report| report.l2_length_error_before.powi(2)).sqrt(),
        max_length_error_before: reports.iter().map(|report| report.max_length_error_before).fold(0.0, f64::max),
        l2_length_error: mean(|report| report.l2_length_error.powi(2)).sqrt(),
        mean_bending_before: mean(|report| report.mean_bending_before),
        mean_bending: mean(|report| report.mean_bending),
        steps: reports.iter().map(|report| report.steps).sum(),
        ending: reports.iter().map(|report| report.ending).max()?,
    })
}

/// The weights of the last phase.
fn stiffness_of(relaxation: Option<&Relaxation>) -> Stiffness {
    relaxation.and_then(|relaxation| relaxation.phases().last()).map_or([1.0; 4], |phase| phase.stiffness)
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
    fn of(relaxation: &Relaxation, positions: &[DVec3], polish: Option<&PolishReport>) -> Part {
        let state = relaxation.state();
        let (component, mesh, metric) = (state.component(), state.mesh(), state.metric());
        let positions = component.vertices.pick(positions);
        let is_moved = polish.is_some_and(|polish| polish.ending != Ending::Unchanged);
        let rims = if is_moved { state.rims_of_surface(&positions) } else { state.rims_at(&positions) };
        let pin_distances = state.pins().iter().map(|(v, place)| positions[v.index()].distance(*place));
        let original = relaxation.placement().original();
        let mut report = ComponentReport {
            faces: mesh.face_count(),
            rims: rims.len(),
            cursor: relaxation.cursor(),
            converged: relaxation.has_converged(),
            ..ComponentReport::default()
        };
        if relaxation.among().of > 1 {
            let error = length_error(mesh, metric, &positions);
            (report.l2_length_error, report.max_length_error) = (error.l2, error.max);
            report.pinch_points = pinch_points(mesh, &positions).len();
        }
        Part {
            rims: rims.into_iter().map(|e| EdgeId::new(component.edges.whole(e.index()))).collect(),
            area: metric.total_area(),
            energy: energy(state.shell(), stiffness_of(Some(relaxation)), state.face_frames()),
            periods: state.period_norms(),
            mean_distance: original.map(|original| mean_distance(mesh, metric, original, &positions)),
            dent: relaxation.dent(&positions),
            bending: BendingSums::of(state, &positions),
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
