//! Pins that no surface with the lengths of the metric can keep.

use crate::evolve::course::Course;
use crate::evolve::error::EvolveError;
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::shortest_paths;
use crate::text::four_digits;
use crate::timeline::Clock;
use crate::tuning::{LOOK_AHEAD, PINNED_LENGTH_TOLERANCE, PINNED_PATH_SOURCES};
use glam::DVec3;

/// What pins and metric disagree about at a time.
struct Contradiction {
    time: f64,
    /// Pinned over wanted length.
    ratio: f64,
    what: Length,
}

enum Length {
    /// Of an edge with both ends pinned, and the ratio for all such edges together.
    Edge { edge: EdgeId, pinned: f64, wanted: f64, count: usize, together: f64 },
    /// Of the shortest way along edges.
    Path { ends: [VertexId; 2], pinned: f64, path: f64 },
}

/// Sentences about pins that contradict the metric at the time of any frame, the worst of each kind: pinned edges that do
/// not have the length the metric asks for, and pinned vertices that are farther apart than the shortest path along
/// edges. Surfaces are found all the same, but do not have all lengths.
///
/// # Errors
/// [`EvolveError`] where there is no metric or no place for a pin.
pub(in crate::evolve) fn contradictions(
    mesh: &Mesh,
    course: &Course,
    clock: &Clock,
) -> Result<Vec<String>, EvolveError> {
    let pins = course.pins();
    let pinned = pins.vertices();
    if pinned.len() < 2 {
        return Ok(Vec::new());
    }
    let count = PINNED_PATH_SOURCES.min(pinned.len());
    let sources: Vec<VertexId> = (0..count).map(|k| pinned[k * pinned.len() / count]).collect();
    let mut program = course.program().clone();
    let mut known: Option<(Vec<f64>, Vec<Vec<f64>>)> = None;
    let (mut worst_edge, mut worst_path): (Option<Contradiction>, Option<Contradiction>) = (None, None);
    let is_still = !program.changes() && !pins.changes();
    let frames = if is_still { 1 } else { clock.frames() };
    for time in frames_to_look_at(frames, mesh.face_count()).map(|frame| clock.time(frame)) {
        let (lengths, paths) = match known.take() {
            Some(known) if !program.changes() => known,
            _ => {
                let lengths = program.at(mesh, time)?.metric.edge_lengths().to_vec();
                let paths = sources.iter().map(|&source| shortest_paths(mesh, &lengths, source)).collect();
                (lengths, paths)
            }
        };
        let places = pins.at(time)?;
        keep_worse(&mut worst_edge, worst_pinned_edge(mesh, &lengths, &places, time));
        for (source, path) in sources.iter().zip(&paths) {
            keep_worse(&mut worst_path, farthest_beyond(*source, path, &places, time));
        }
        known = Some((lengths, paths));
    }
    // An edge that is too short for its pins is a path, too.
    let edge_says_so = |path: &Contradiction| {
        worst_edge.as_ref().is_some_and(|edge| edge.ratio >= path.ratio * (1.0 - PINNED_LENGTH_TOLERANCE))
    };
    worst_path = worst_path.filter(|path| !edge_says_so(path));
    Ok(worst_edge.into_iter().chain(worst_path).map(|worst| worst.sentence(mesh)).collect())
}

fn keep_worse(worst: &mut Option<Contradiction>, found: Option<Contradiction>) {
    let size = |contradiction: &Contradiction| libm::log(contradiction.ratio).abs();
    if let Some(found) = found.filter(|found| size(found) > PINNED_LENGTH_TOLERANCE)
        && worst.as_ref().is_none_or(|worst| size(&found) > size(worst))
    {
        *worst = Some(found);
    }
}

fn worst_pinned_edge(mesh: &Mesh, lengths: &[f64], places: &[(VertexId, DVec3)], time: f64) -> Option<Contradiction> {
    let mut at = vec![None; mesh.vertex_count()];
    places.iter().for_each(|(v, place)| at[v.index()] = Some(*place));
    let pinned: Vec<(EdgeId, f64, f64)> = mesh
        .edges()
        .filter_map(|e| {
            let [a, b] = mesh.edge_vertices(e).map(|v| at[v.index()]);
            Some((e, a?.distance(b?), lengths[e.index()]))
        })
        .collect();
    let size = |&(_, pinned, wanted): &(EdgeId, f64, f64)| libm::log(pinned / wanted).abs();
    let &(edge, length, wanted) = pinned.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let [sum, all] = pinned.iter().fold([0.0; 2], |[p, w], edge| [p + edge.1, w + edge.2]);
    let what = Length::Edge { edge, pinned: length, wanted, count: pinned.len(), together: sum / all };
    Some(Contradiction { time, ratio: length / wanted, what })
}

/// The pinned vertex that is farthest from a source in comparison with the path to it, if it is farther than that.
fn farthest_beyond(source: VertexId, paths: &[f64], places: &[(VertexId, DVec3)], time: f64) -> Option<Contradiction> {
    let (_, from) = *places.iter().find(|(v, _)| *v == source)?;
    let beyond = |(v, place): &(VertexId, DVec3)| (*v, from.distance(*place), paths[v.index()]);
    let pairs = places.iter().filter(|(v, _)| *v != source).map(beyond);
    let (v, pinned, path) = pairs.max_by(|a, b| (a.1 / a.2).total_cmp(&(b.1 / b.2)))?;
    let what = Length::Path { ends: [source, v], pinned, path };
    (pinned > path).then_some(Contradiction { time, ratio: pinned / path, what })
}

impl Contradiction {
    fn sentence(&self, mesh: &Mesh) -> String {
        let time = self.time;
        let remedy = "no surface has these lengths with these pins; lead the pins along (`formula`, `motion`), change the \
                      metric there, or expect length errors and rims";
        match self.what {
            Length::Edge { edge, pinned, wanted, count, together } => format!(
                "pinned edges are {} times the length that the metric asks for at time {time}: {count} of them together are \
                 {} times, and worst the edge between vertices {:?} with {} instead of {}; {remedy}",
                four_digits(self.ratio),
                four_digits(together),
                mesh.file_ends(edge),
                four_digits(pinned),
                four_digits(wanted),
            ),
            Length::Path { ends, pinned, path } => format!(
                "vertices {:?} are pinned {} apart at time {time}, {} times as far as the shortest path along edges, which has \
                 length {}; {remedy}",
                ends.map(|v| mesh.file_vertex(v)),
                four_digits(pinned),
                four_digits(self.ratio),
                four_digits(path),
            ),
        }
    }
}

/// The numbers of the frames that are looked at, of a film of so many on a surface with so many faces: all of them, or
/// as many as are seen in a moment, evenly, with the first and the last.
fn frames_to_look_at(frames: usize, faces: usize) -> impl Iterator<Item = usize> {
    let stride = frames.div_ceil((LOOK_AHEAD / faces.max(1)).max(1)).max(1);
    (1..frames).step_by(stride).chain([frames])
}
