//! Rims as what they stand for: loops that the surface makes.
//!
//! A rim says that the surface turns by 360° more where it crosses an edge (Sec. 4.1 and Fig. 6 of the paper). Drawn is a sheet that does so: it leaves
//! the surface along the rim, tangent to it, goes once around on the front, and comes back, tangent again. It is as wide as is asked for and comes to a point where the rim
//! ends, at what would be a pinch point without it.

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use glam::DVec3;

use crate::immersion::FieldValues;
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::render::Field;

/// Cross-sections along an edge, and points of each.
const ALONG: usize = 6;
const AROUND: usize = 24;

/// All loops of a surface.
#[derive(Clone, Debug, Default)]
pub(super) struct Loops {
    strands: Vec<Strand>,
    radius: f64,
}

/// A rim from one end to the other, or around.
#[derive(Clone, Debug)]
struct Strand {
    stations: Vec<Station>,
    is_closed: bool,
}

/// A cross-section.
#[derive(Clone, Copy, Debug)]
struct Station {
    /// Ends of the edge that it is at.
    ends: [VertexId; 2],
    /// Where on the edge, from 0 to 1.
    part: f64,
    /// A face beside it.
    face: u32,
    /// Its size, as a share of the radius.
    size: f64,
}

impl Loops {
    /// Along all rims, of this radius, as wide open as a rim with these vertices is said to be.
    pub fn along(mesh: &Mesh, rims: &[EdgeId], radius: f64, openness: impl Fn(&BTreeSet<VertexId>) -> f64) -> Loops {
        let mut edges_at: BTreeMap<VertexId, Vec<EdgeId>> = BTreeMap::new();
        for &edge in rims {
            mesh.edge_vertices(edge).iter().for_each(|v| edges_at.entry(*v).or_default().push(edge));
        }
        let mut left: BTreeSet<EdgeId> = rims.iter().copied().collect();
        let ends = edges_at.iter().filter(|(_, edges)| edges.len() != 2).map(|(v, _)| *v);
        let starts: Vec<VertexId> = ends.chain(edges_at.keys().copied()).collect();
        let mut strands = Vec::new();
        for start in starts {
            loop {
                let path = walk(mesh, &edges_at, &mut left, start);
                if path.is_empty() {
                    break;
                }
                let vertices: BTreeSet<VertexId> = path.iter().flat_map(|(_, ends)| *ends).collect();
                strands.push(Strand::of(mesh, &edges_at, &path, openness(&vertices)));
            }
        }
        Loops { strands, radius }
    }

    /// Places of all its points, on a surface with these positions, |V|.
    pub fn places(&self, mesh: &Mesh, positions: &[DVec3]) -> Vec<DVec3> {
        self.strands.iter().flat_map(|strand| strand.places(mesh, positions, self.radius)).collect()
    }

    /// Its triangles, whose points are numbered from `first`.
    pub fn triangles(&self, first: u32) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        let mut first = first;
        for strand in &self.strands {
            triangles.extend(strand.triangles(first));
            first += (strand.stations.len() * AROUND) as u32;
        }
        triangles
    }

    /// A face beside each triangle.
    pub fn faces(&self) -> Vec<u32> {
        let of_strand = |strand: &'_ Strand| -> Vec<u32> {
            let bands = strand.stations.iter().take(strand.bands());
            bands.flat_map(|station| [station.face; 2 * AROUND]).collect()
        };
        self.strands.iter().flat_map(of_strand).collect()
    }

    /// Values of a field on the loops behind those on the surface: what it is beside them.
    pub fn extend(&self, field: &mut Field) {
        match &mut field.values {
            FieldValues::PerFace(values) => {
                let more: Vec<f32> = self.faces().into_iter().map(|face| values[face as usize]).collect();
                values.extend(more);
            }
            FieldValues::PerVertex(values) => {
                let period = field.period;
                let stations = self.strands.iter().flat_map(|strand| &strand.stations);
                let more: Vec<f32> = stations.flat_map(|station| [station.value(values, period); AROUND]).collect();
                values.extend(more);
            }
        }
    }
}

/// The edges of a rim from a vertex on, each with its ends in order, until it ends or divides; they are taken out.
fn walk(
    mesh: &Mesh,
    edges_at: &BTreeMap<VertexId, Vec<EdgeId>>,
    left: &mut BTreeSet<EdgeId>,
    start: VertexId,
) -> Vec<(EdgeId, [VertexId; 2])> {
    let mut path = Vec::new();
    let mut here = start;
    while let Some(edge) = edges_at.get(&here).and_then(|edges| edges.iter().find(|edge| left.contains(edge))) {
        left.remove(edge);
        let [a, b] = mesh.edge_vertices(*edge);
        let there = if a == here { b } else { a };
        path.push((*edge, [here, there]));
        here = there;
        if edges_at.get(&here).is_none_or(|edges| edges.len() != 2) {
            break;
        }
    }
    path
}

impl Strand {
    fn of(
        mesh: &Mesh,
        edges_at: &BTreeMap<VertexId, Vec<EdgeId>>,
        path: &[(EdgeId, [VertexId; 2])],
        openness: f64,
    ) -> Strand {
        let [first, last] = [path[0].1[0], path[path.len() - 1].1[1]];
        let is_closed = first == last;
        let ends_there = |v: VertexId| !is_closed && edges_at.get(&v).is_some_and(|edges| edges.len() == 1);
        let length = path.len() as f64;
        // It opens on half of its length, but on no more than one edge.
        let reach = (0.5 * length).min(1.0);
        let size = |at: f64| {
            let from_ends = [(first, at), (last, length - at)].map(|(v, away)| {
                let share = if ends_there(v) { (away / reach).min(1.0) } else { 1.0 };
                (1.0 - (1.0 - share) * (1.0 - share)).max(0.0).sqrt()
            });
            openness * from_ends[0].min(from_ends[1])
        };
        let station = |k: usize| {
            let edge = (k / ALONG).min(path.len() - 1);
            let (id, ends) = path[edge];
            let face = mesh.edge_halfedge(id).face().0;
            Station { ends, part: (k - edge * ALONG) as f64 / ALONG as f64, face, size: size(k as f64 / ALONG as f64) }
        };
        let count = path.len() * ALONG + usize::from(!is_closed);
        Strand { stations: (0..count).map(station).collect(), is_closed }
    }

    /// Stretches between one cross-section and the next.
    fn bands(&self) -> usize {
        self.stations.len() - usize::from(!self.is_closed)
    }

    fn places(&self, mesh: &Mesh, positions: &[DVec3], radius: f64) -> Vec<DVec3> {
        let normal = |v: VertexId| -> DVec3 {
            let faces = mesh.outgoing(v).map(|h| mesh.corners(h.face()).map(|corner| positions[corner.index()]));
            faces.map(|[a, b, c]| (b - a).cross(c - a)).sum::<DVec3>().normalize_or_zero()
        };
        let middles: Vec<DVec3> =
            self.stations.iter().map(|station| station.between(|v| positions[v.index()])).collect();
        let count = middles.len();
        let section = |k: usize| {
            let station = &self.stations[k];
            let [before, after] = if self.is_closed {
                [(k + count - 1) % count, (k + 1) % count]
            } else {
                [k.saturating_sub(1), (k + 1).min(count - 1)]
            };
            let along = (middles[after] - middles[before]).normalize_or(DVec3::X);
            let up = station.between(normal);
            let up = (up - along * up.dot(along)).try_normalize().unwrap_or(along.any_orthonormal_vector());
            let across = along.cross(up);
            let (middle, radius) = (middles[k], radius * station.size);
            (0..AROUND).map(move |step| {
                let angle = TAU * step as f64 / AROUND as f64;
                let (sine, cosine) = libm::sincos(angle);
                middle + (up * (1.0 - cosine) + across * sine) * radius
            })
        };
        (0..count).flat_map(section).collect()
    }

    /// Their front is inside, where that of the surface is when it turns up into them.
    fn triangles(&self, first: u32) -> Vec<[u32; 3]> {
        let count = self.stations.len();
        let point = |station: usize, step: usize| first + ((station % count) * AROUND + step % AROUND) as u32;
        let cell = |station: usize, step: usize| {
            let [a, b] = [point(station, step), point(station, step + 1)];
            let [c, d] = [point(station + 1, step), point(station + 1, step + 1)];
            [[a, b, c], [b, d, c]]
        };
        (0..self.bands()).flat_map(|station| (0..AROUND).flat_map(move |step| cell(station, step))).collect()
    }
}

impl Station {
    fn between(&self, value: impl Fn(VertexId) -> DVec3) -> DVec3 {
        value(self.ends[0]).lerp(value(self.ends[1]), self.part)
    }

    /// The value of a field on the edge; where a period is given, the shorter way around.
    fn value(&self, values: &[f32], period: Option<f32>) -> f32 {
        let [from, to] = self.ends.map(|v| values[v.index()]);
        let way = to - from;
        let way = period.map_or(way, |period| way - (way / period).round() * period);
        from + way * self.part as f32
    }
}
