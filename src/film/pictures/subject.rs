//! What is to be seen of a film: the surface and the curves on it, frame by frame.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec3;

use super::{
    MovieError, Plan,
    quantities::{Measures, Quantities, Spreads},
};
use crate::{
    cache::{Cache, CacheError},
    evolve::Frame,
    immersion::pinch_points,
    mesh::{self, EdgeId, Mesh, Surface},
    render::{Extent, Legend, Look, Plane, Scenery},
    scene::{Scene, SceneErrors},
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
    /// Fingerprint of what was simulated.
    scene_hash: u32,
}

/// A frame as it is drawn.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    pub positions: Vec<DVec3>,
    /// Empty if nothing moves.
    pub next_positions: Vec<DVec3>,
    shown: Vec<bool>,
    rims: Vec<[u32; 2]>,
    pinch_points: Vec<u32>,
    quantities: Quantities,
}

impl Subject {
    pub fn of(plan: &Plan, cache: &Cache) -> Result<Subject, MovieError> {
        let (scene, look) = (plan.scene, &plan.scene.look);
        let triangles = cache.triangles()?;
        let vertices = cache.manifest().mesh.vertices;
        let mesh = Arc::new(Mesh::from_faces(vertices, &triangles).map_err(|error| CacheError::Damaged {
            path: cache.folder().to_owned(),
            reason: error.to_string(),
            remedy: "run `immerse simulate --restart`",
        })?);
        let file_faces = if look.hide_faces.is_empty() { Vec::new() } else { cache.file_faces()? };
        let polygons = file_faces.iter().max().map_or(0, |last| *last as usize + 1);
        if let Some(face) = look.hide_faces.iter().find(|&&face| face >= polygons) {
            let message = format!("there is no face {face}; write indices below {polygons}");
            return Err(MovieError::of_scene(scene, "look.hide_faces", &message));
        }
        let hidden_faces = hidden_faces(&look.hide_faces, &file_faces);
        let pins = if scene.pins.is_empty() { Vec::new() } else { pins_of(scene, &surface_of(scene, &triangles)?)? };
        let middles = if plan.hide.is_some() {
            let places = cache.places()?.ok_or_else(|| {
                let message = "the mesh has no positions; name faces by index with hide_faces";
                MovieError::of_scene(scene, "look.hide", message)
            })?;
            let middle = |corners: &[u32; 3]| corners.iter().map(|&v| places[v as usize]).sum::<DVec3>() / 3.0;
            triangles.iter().map(middle).collect()
        } else {
            Vec::new()
        };
        let components = if look.explode > 0.0 { components(&mesh) } else { Vec::new() };
        let boundary = mesh.edges().filter(|&e| mesh.is_boundary_edge(e)).map(|e| ends(&mesh, e)).collect();
        let explode = look.explode;
        let scene_hash = cache.manifest().fingerprint;
        let measures = Measures::of(plan, cache, &mesh)?;
        Ok(Subject {
            mesh,
            measures,
            triangles,
            boundary,
            pins,
            middles,
            components,
            explode,
            hidden_faces,
            scene_hash,
        })
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.triangles.len()
    }

    /// Fingerprint of what was simulated.
    pub fn scene_hash(&self) -> u32 {
        self.scene_hash
    }

    /// Where the vertices of a frame are in the picture: components are moved away from the middle of all.
    pub fn positions(&self, state: &Frame) -> Vec<DVec3> {
        let mut positions = state.positions.clone();
        let mean = |points: &mut dyn Iterator<Item = DVec3>, count: usize| points.sum::<DVec3>() / count.max(1) as f64;
        let middle = mean(&mut state.positions.iter().copied(), state.positions.len());
        for component in &self.components {
            let own = mean(&mut component.iter().map(|&v| state.positions[v as usize]), component.len());
            let shift = (own - middle) * self.explode;
            component.iter().for_each(|&v| positions[v as usize] += shift);
        }
        positions
    }

    /// What the camera has to know of a frame.
    pub fn extent(&self, state: &Frame) -> Extent {
        Extent::of_surface(&self.positions(state), &self.triangles)
    }

    /// Whether the look depends on how the values of all frames are spread.
    pub fn spreads_matter(&self, plan: &Plan) -> bool {
        self.measures.spreads_matter(plan)
    }

    /// How the values of a frame are spread, as far as the look depends on it.
    pub fn spreads(&self, plan: &Plan, state: &Frame) -> Result<Spreads, MovieError> {
        self.measures.spreads(plan, &self.mesh, state)
    }

    /// The look with the ranges of what it shows, and the key to its colours.
    pub fn look(&self, plan: &Plan, spreads: &Spreads) -> (Look, Option<Legend>) {
        self.measures.complete(plan, spreads)
    }

    /// What is seen of a frame; the one after it tells where vertices go.
    pub fn moment(&self, plan: &Plan, state: &Frame, next: Option<&Frame>) -> Result<Moment, MovieError> {
        Ok(Moment {
            positions: self.positions(state),
            next_positions: next.map(|next| self.positions(next)).unwrap_or_default(),
            shown: self.shown(plan, state.report.time),
            rims: state.rims.iter().map(|&e| ends(&self.mesh, e)).collect(),
            pinch_points: pinch_points(&self.mesh, &state.positions).into_iter().map(|v| v.0).collect(),
            quantities: self.measures.at(&self.mesh, state)?,
        })
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
            triangles: &self.triangles,
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

/// The surface that the scene names, if it is still that of the film.
fn surface_of(scene: &Scene, triangles: &[[u32; 3]]) -> Result<Surface, MovieError> {
    let at_fault = |message: &str| MovieError::of_scene(scene, "mesh.file", message);
    let surface = scene.surface().map_err(|error| MovieError::Scene(SceneErrors::Mistakes(vec![error])))?;
    if surface.mesh.triangles() != triangles {
        return Err(at_fault("the mesh is not that of the film; simulate it anew"));
    }
    Ok(surface)
}

fn pins_of(scene: &Scene, surface: &Surface) -> Result<Vec<u32>, MovieError> {
    let pins = scene.pins(surface, &scene.parameters()?)?;
    Ok(pins.vertices().iter().map(|v| v.0).collect())
}

/// Vertices of each component, each once.
fn components(mesh: &Mesh) -> Vec<Vec<u32>> {
    let vertices = |faces: Vec<mesh::FaceId>| {
        let mut vertices: Vec<u32> = faces.into_iter().flat_map(|face| mesh.corners(face)).map(|v| v.0).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    };
    mesh.components().into_iter().map(vertices).collect()
}
