//! What is to be seen of a film: the surface and the curves on it, frame by frame.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use glam::DVec3;

use super::{
    loops::Loops,
    plan::Plan,
    quantities::{Measures, Quantities, Spreads},
};
use crate::{
    digest::Digest,
    evolve::Frame,
    film::{
        disk::{FilmFolder, FilmMesh},
        error::FilmError,
    },
    homotopy::{Element, events_between},
    immersion::{FieldName, pinch_points},
    mesh::{EdgeId, FaceId, Mesh, VertexId},
    render::{Extent, Legend, Look, Plane, Scenery},
};

/// What is the same in all frames.
#[derive(Debug)]
pub(super) struct Subject {
    mesh: Arc<Mesh>,
    measures: Measures,
    triangles: Vec<[u32; 3]>,
    boundary: Vec<[u32; 2]>,
    /// Vertices that are held.
    pins: Vec<u32>,
    /// What x, y and z of the middle of each face mean in the scene; empty where nothing asks for it.
    middles: Vec<DVec3>,
    /// Vertices of each component; empty unless components are moved apart.
    components: Vec<Vec<u32>>,
    explode: f64,
    hidden_faces: Vec<usize>,
}

/// The frames beside one, as far as its picture takes them.
#[derive(Clone, Copy, Default)]
pub(super) struct Beside<'a> {
    pub before: Option<&'a Frame>,
    pub next: Option<&'a Frame>,
}

/// A frame as it is drawn.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    pub positions: Vec<DVec3>,
    /// Empty if nothing moves.
    pub next_positions: Vec<DVec3>,
    /// Those of the surface and of loops along its rims; empty without loops.
    triangles: Vec<[u32; 3]>,
    shown: Vec<bool>,
    rims: Vec<[u32; 2]>,
    pinch_points: Vec<u32>,
    quantities: Quantities,
}

impl Subject {
    pub fn of(plan: &Plan, folder: &FilmFolder) -> Result<Subject, FilmError> {
        let (scene, look) = (plan.scene, &plan.scene.look);
        let surface = folder.mesh()?;
        let FilmMesh { mesh, places, pins, .. } = &surface;
        let triangles = mesh.triangles();
        let file_faces = if look.hide_faces.is_empty() { Vec::new() } else { folder.file_faces()? };
        let polygons = file_faces.iter().max().map_or(0, |last| *last as usize + 1);
        if let Some(face) = look.hide_faces.iter().find(|&&face| face >= polygons) {
            let reason = format!("there is no face {face}");
            return Err(scene.complain("look.hide_faces", reason, format!("write indices below {polygons}")).into());
        }
        let hidden_faces = hidden_faces(&look.hide_faces, &file_faces);
        let pins = pins.iter().map(|v| v.0).collect();
        let middles = match (&plan.hide, places) {
            (None, _) => Vec::new(),
            (Some(_), None) => {
                let remedy = "name faces by index with hide_faces";
                return Err(scene.complain("look.hide", "the mesh has no positions", remedy).into());
            }
            (Some(_), Some(places)) => {
                let middle = |corners: &[u32; 3]| corners.iter().map(|&v| places[v as usize]).sum::<DVec3>() / 3.0;
                triangles.iter().map(middle).collect()
            }
        };
        let components = if look.explode > 0.0 { components(mesh) } else { Vec::new() };
        let boundary = mesh.edges().filter(|&e| mesh.is_boundary_edge(e)).map(|e| ends(mesh, e)).collect();
        let explode = look.explode;
        let measures = Measures::of(plan, folder, &surface)?;
        Ok(Subject {
            mesh: mesh.clone(),
            measures,
            triangles,
            boundary,
            pins,
            middles,
            components,
            explode,
            hidden_faces,
        })
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.triangles.len()
    }

    /// What pictures show of the surface beside its frames and what is asked of them, for their keys.
    pub fn add_to(&self, digest: Digest) -> Digest {
        self.measures.add_to(digest)
    }

    /// The field that is shown as colour.
    pub fn color(&self) -> Option<FieldName> {
        self.measures.color()
    }

    /// Whether fields are shown, which are measured against the first frame.
    pub fn has_fields(&self) -> bool {
        self.measures.has_fields()
    }

    /// Where the vertices of a frame are in the picture: components are moved away from the middle of all.
    pub fn positions(&self, frame: &Frame) -> Vec<DVec3> {
        let mut positions = frame.positions.clone();
        let mean = |points: &mut dyn Iterator<Item = DVec3>, count: usize| points.sum::<DVec3>() / count.max(1) as f64;
        let middle = mean(&mut frame.positions.iter().copied(), frame.positions.len());
        for component in &self.components {
            let own = mean(&mut component.iter().map(|&v| frame.positions[v as usize]), component.len());
            let shift = (own - middle) * self.explode;
            component.iter().for_each(|&v| positions[v as usize] += shift);
        }
        positions
    }

    /// What the camera has to know of a frame.
    pub fn extent(&self, frame: &Frame) -> Extent {
        Extent::of_surface(&self.positions(frame), &self.triangles)
    }

    /// Whether the look depends on how the values of all frames are spread.
    pub fn spreads_matter(&self, plan: &Plan) -> bool {
        self.measures.spreads_matter(plan)
    }

    /// How the values of a frame are spread, as far as the look depends on it.
    pub fn spreads(&self, plan: &Plan, frame: &Frame) -> Result<Spreads, FilmError> {
        self.measures.spreads(plan, &self.mesh, frame)
    }

    /// The look with the ranges of what it shows, and the key to its colours.
    pub fn look(&self, plan: &Plan, spreads: &Spreads) -> (Look, Option<Legend>) {
        self.measures.complete(plan, spreads)
    }

    /// What is seen of a frame; the one after it tells where vertices go.
    pub fn moment(&self, plan: &Plan, frame: &Frame, beside: Beside) -> Result<Moment, FilmError> {
        let mut moment = Moment {
            triangles: Vec::new(),
            positions: self.positions(frame),
            next_positions: beside.next.map(|next| self.positions(next)).unwrap_or_default(),
            shown: self.shown(plan, frame.report.time),
            rims: frame.rims.iter().map(|&e| ends(&self.mesh, e)).collect(),
            pinch_points: pinch_points(&self.mesh, &frame.positions).into_iter().map(|v| v.0).collect(),
            quantities: self.measures.at(&self.mesh, frame)?,
        };
        if plan.scene.look.rim_loops > 0.0 && !frame.rims.is_empty() {
            self.open_rims(&mut moment, plan.scene.look.rim_loops, frame, beside);
        }
        Ok(moment)
    }

    /// Makes loops of the rims, which are no lines then, and end in no pinch points.
    fn open_rims(&self, moment: &mut Moment, size: f64, frame: &Frame, beside: Beside) {
        let mesh = &self.mesh;
        let mean_length = frame.edge_lengths.iter().sum::<f64>() / frame.edge_lengths.len() as f64;
        let is_there = |other: &Frame, vertices: &BTreeSet<VertexId>| {
            other.rims.iter().any(|edge| mesh.edge_vertices(*edge).iter().any(|v| vertices.contains(v)))
        };
        let openness = |vertices: &BTreeSet<VertexId>| {
            let others = [beside.before, beside.next].into_iter().flatten();
            if others.into_iter().all(|other| is_there(other, vertices)) { 1.0 } else { 0.5 }
        };
        let loops = Loops::along(mesh, &frame.rims, size * mean_length, openness);
        let first = moment.positions.len() as u32;
        let places = loops.places(mesh, &moment.positions);
        moment.positions.extend(places);
        if !moment.next_positions.is_empty() {
            let places = loops.places(mesh, &moment.next_positions);
            moment.next_positions.extend(places);
        }
        moment.triangles = self.triangles.clone();
        moment.triangles.extend(loops.triangles(first));
        if !moment.shown.is_empty() {
            let shown: Vec<bool> = loops.faces().into_iter().map(|face| moment.shown[face as usize]).collect();
            moment.shown.extend(shown);
        }
        let Quantities { color, along, layers } = &mut moment.quantities;
        let fields = color.iter_mut().chain(along.iter_mut().flatten()).chain(layers);
        fields.for_each(|field| loops.extend(field));
        let opened: BTreeSet<u32> = moment.rims.iter().flatten().copied().collect();
        moment.pinch_points.retain(|vertex| !opened.contains(vertex));
        moment.rims.clear();
    }

    /// Where the hinges and faces of a frame are that fold or vanish on the way from the frame before or to the next one.
    pub fn places_of_events(&self, frame: &Frame, beside: Beside) -> Vec<DVec3> {
        let positions = self.positions(frame);
        // In a film that loops, nothing is decided from the last frame to the first.
        let next = beside.next.filter(|next| next.report.frame == frame.report.frame + 1);
        let ways = [beside.before.map(|before| [before, frame]), next.map(|next| [frame, next])];
        let events = ways.into_iter().flatten();
        let events = events.flat_map(|[from, to]| events_between(&self.mesh, &from.positions, &to.positions));
        let elements: BTreeSet<Element> = events.map(|event| event.element).collect();
        let middle = |element: Element| {
            let mut vertices = element.vertices(&self.mesh);
            if let Element::Hinge(_) = element {
                vertices.truncate(2);
            }
            vertices.iter().map(|v| positions[v.index()]).sum::<DVec3>() / vertices.len() as f64
        };
        elements.into_iter().map(middle).collect()
    }

    /// Whether each face is shown; empty if all are.
    fn shown(&self, plan: &Plan, time: f64) -> Vec<bool> {
        if plan.hide.is_none() && self.hidden_faces.is_empty() {
            return Vec::new();
        }
        let mut shown = vec![true; self.triangles.len()];
        if let Some(formula) = &plan.hide {
            let formula = formula.at(time);
            for (shown, middle) in shown.iter_mut().zip(&self.middles) {
                *shown = formula.value(&middle.to_array()) <= 0.0;
            }
        }
        self.hidden_faces.iter().for_each(|&face| shown[face] = false);
        shown
    }

    /// A moment as it is given to the renderer, with vertices in these positions.
    pub fn scenery<'a>(&'a self, moment: &'a Moment, positions: &'a [DVec3], ground: Plane) -> Scenery<'a> {
        let Quantities { color, along, layers } = &moment.quantities;
        Scenery {
            triangles: if moment.triangles.is_empty() { &self.triangles } else { &moment.triangles },
            positions,
            next_positions: &moment.next_positions,
            shown: &moment.shown,
            rims: &moment.rims,
            boundary: &self.boundary,
            pinch_points: &moment.pinch_points,
            pins: &self.pins,
            ground: Some(ground),
            color: color.as_ref(),
            along: along.each_ref().map(Option::as_ref),
            fields: layers,
        }
    }
}

/// The triangles that were cut from these faces of the mesh file.
fn hidden_faces(faces: &[usize], file_faces: &[u32]) -> Vec<usize> {
    let faces: HashSet<usize> = faces.iter().copied().collect();
    (0..file_faces.len()).filter(|&f| faces.contains(&(file_faces[f] as usize))).collect()
}

fn ends(mesh: &Mesh, e: EdgeId) -> [u32; 2] {
    mesh.edge_vertices(e).map(|v| v.0)
}

/// Vertices of each component, each once.
fn components(mesh: &Mesh) -> Vec<Vec<u32>> {
    let vertices = |faces: Vec<FaceId>| {
        let mut vertices: Vec<u32> = faces.into_iter().flat_map(|face| mesh.corners(face)).map(|v| v.0).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    };
    mesh.components().into_iter().map(vertices).collect()
}
