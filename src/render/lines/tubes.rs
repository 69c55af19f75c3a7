//! Which curves are drawn as lines.

use glam::DVec3;

use super::{
    edges::Edges,
    intersect::{Crossing, cuts, self_intersections},
};
use crate::{
    immersion::FieldValues,
    render::{
        Camera, Look, Output, Scenery,
        raster::{ScreenTube, Stroke},
        stage::{Projection, Stage},
    },
};

/// How far silhouettes lie behind their edges, as a share of the edge's length: deeper than the zigzags of
/// the mesh, so that these stay hidden.
const OUTLINE_SINK: f32 = 0.6;
/// Sine of the angle between crossing sheets at which their curve is drawn in full width; where they nearly
/// coincide there is no curve, only noise.
const FULL_CROSSING: f64 = 0.25;
/// Below this width, as a share of the full one, nothing is drawn.
const FAINTEST: f64 = 0.25;

/// The lines of a picture, in a fixed order: silhouettes, creases, boundary, cut, self-intersections, rims,
/// pinch points, pins.
pub fn tubes(scenery: &Scenery, stage: &Stage, camera: &Camera, look: &Look, output: &Output) -> Vec<ScreenTube> {
    let lines = &look.lines;
    let pen = Pen { projection: &stage.projection, stage, scenery, camera, look, output };
    let at = |ends: [u32; 2]| ends.map(|vertex| scenery.positions[vertex as usize]);
    let edges = Edges::new(scenery, stage, lines);
    let solid = |list: &[[u32; 2]]| list.iter().flat_map(|&ends| pen.solid_parts(ends)).collect::<Vec<_>>();

    let silhouettes = solid(&edges.silhouettes);
    let silhouettes = silhouettes.iter().filter_map(|&(edge, ends)| {
        let sink = output.line_pixels(lines.silhouette) + OUTLINE_SINK * pen.pixels_long(at(edge));
        pen.stroke(ends, 2.0 * lines.silhouette, Stroke::Outline { sink })
    });
    let (creases, boundary) = (solid(&edges.creases), solid(&edges.boundary));
    let creases = creases.iter().filter_map(|&(_, ends)| pen.stroke(ends, lines.crease, Stroke::Line));
    let boundary = boundary.iter().filter_map(|&(_, ends)| pen.stroke(ends, lines.boundary, Stroke::Line));
    let cut = match look.cut {
        Some(plane) if lines.boundary > 0.0 => cuts(&stage.faces, scenery.positions, plane),
        _ => Vec::new(),
    };
    let cut = cut.iter().filter_map(|&ends| pen.stroke(ends, lines.boundary, Stroke::Line));
    let double =
        if lines.intersection > 0.0 { self_intersections(&stage.faces, scenery.positions) } else { Vec::new() };
    let double = double.iter().filter(|crossing| pen.is_solid(crossing)).filter_map(|crossing| {
        let share = (crossing.sine / FULL_CROSSING).min(1.0);
        let width = if share > FAINTEST { lines.intersection * share as f32 } else { 0.0 };
        pen.stroke(crossing.ends, width, Stroke::Line)
    });
    let is_shown = |ends: &&[u32; 2]| edges.is_shown(**ends);
    let rims = scenery.rims.iter().filter(is_shown).filter_map(|&ends| pen.stroke(at(ends), lines.rim, Stroke::Rim));
    let points = |vertices: &'_ [u32], width: f32, stroke: Stroke| -> Vec<ScreenTube> {
        vertices.iter().filter_map(|&vertex| pen.stroke(at([vertex; 2]), width, stroke)).collect()
    };
    let pinches = points(scenery.pinch_points, lines.pinch, Stroke::Rim);
    let pins = points(scenery.pins, lines.pin, Stroke::Pin);
    let flat = silhouettes.chain(creases).chain(boundary).chain(cut).chain(double);
    flat.chain(rims).chain(pinches).chain(pins).collect()
}

/// Turns segments of space into tubes on the picture.
struct Pen<'a> {
    projection: &'a Projection,
    stage: &'a Stage,
    scenery: &'a Scenery<'a>,
    camera: &'a Camera,
    look: &'a Look,
    output: &'a Output,
}

impl Pen<'_> {
    /// A tube between two points, `width` pixels wide at 1080p; none if nothing of it can be seen.
    fn stroke(&self, ends: [DVec3; 2], width: f32, stroke: Stroke) -> Option<ScreenTube> {
        if width == 0.0 || !ends.iter().all(|end| end.is_finite()) {
            return None;
        }
        let ends = self.uncut(ends)?;
        let width = if self.look.lines.perspective { width * self.closeness(ends) } else { width };
        let radius = self.output.line_pixels(width / 2.0);
        let segment = self.projection.segment(ends)?;
        let tube = ScreenTube::new(segment, radius, stroke, self.camera, self.output);
        tube.is_near(self.output).then_some(tube)
    }

    /// The parts of an edge that do not lie in see-through gaps of the pattern, with the edge.
    fn solid_parts(&self, [a, b]: [u32; 2]) -> Vec<([u32; 2], [DVec3; 2])> {
        let [from, to] = [a, b].map(|vertex| self.scenery.positions[vertex as usize]);
        let whole = vec![([a, b], [from, to])];
        let (Some(pattern), Some(field)) = (&self.look.pattern, self.scenery.along[0]) else { return whole };
        let FieldValues::PerVertex(_) = field.values else { return whole };
        let [value_a, value_b, _] = field.at_corners(0, [a, b, b]);
        let parts = pattern.solid_parts([value_a, value_b]).into_iter();
        parts.map(|part| ([a, b], part.map(|part| from.lerp(to, f64::from(part))))).collect()
    }

    /// Whether the curve in which two triangles cross lies in no see-through gap of either.
    fn is_solid(&self, crossing: &Crossing) -> bool {
        let Some(pattern) = &self.look.pattern else { return true };
        let middle = (crossing.ends[0] + crossing.ends[1]) / 2.0;
        crossing.triangles.iter().all(|&face| {
            let Some(values) = self.stage.along[0].get(face) else { return true };
            let [a, b, c] = self.stage.faces[face].map(|vertex| self.scenery.positions[vertex as usize]);
            let normal = (b - a).cross(c - a);
            let share =
                |p: DVec3, q: DVec3| ((p - middle).cross(q - middle).dot(normal) / normal.length_squared()) as f32;
            let value = values[0] * share(b, c) + values[1] * share(c, a) + values[2] * share(a, b);
            !pattern.is_gap(f64::from(value))
        })
    }

    /// The part of a segment that is not cut away.
    fn uncut(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let Some(plane) = self.look.cut else { return Some([a, b]) };
        // A little beyond, so that the outline of the cut itself stays.
        let (_, radius) = self.camera.subject();
        let height = |point: DVec3| plane.normal.dot(point) - plane.offset - 1e-6 * radius;
        let (over_a, over_b) = (height(a), height(b));
        let at_plane = || a.lerp(b, over_a / (over_a - over_b));
        match (over_a > 0.0, over_b > 0.0) {
            (true, true) => None,
            (false, false) => Some([a, b]),
            (false, true) => Some([a, at_plane()]),
            (true, false) => Some([at_plane(), b]),
        }
    }

    /// How much larger things look here than in the middle of what is framed.
    fn closeness(&self, ends: [DVec3; 2]) -> f32 {
        let size = |point: DVec3| {
            let depth = self.projection.pixel(self.projection.clip(point)).z;
            self.camera.pixel_size(depth, self.output)
        };
        let here = size((ends[0] + ends[1]) / 2.0);
        let share = size(self.camera.subject().0) / here;
        if share.is_finite() { share.clamp(0.1, 10.0) as f32 } else { 1.0 }
    }

    /// Length in pixels of a segment that lies across the picture where this one begins.
    fn pixels_long(&self, ends: [DVec3; 2]) -> f32 {
        let depth = self.projection.pixel(self.projection.clip(ends[0])).z;
        (ends[0].distance(ends[1]) / self.camera.pixel_size(depth, self.output)) as f32
    }
}
