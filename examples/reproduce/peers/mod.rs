//! The methods that the paper compares itself with in Sec. 6.1, on the same scenes: Fig. 9, 10 and 11.

mod figures;
mod membrane;
mod rotations;

pub use figures::{figure_9, figure_10, figure_11};

use super::measure::{report_of, rims_of};
use super::request::{Outcome, Request, own};
use super::solve::{Found, Polish, scene, solve};
use glam::DVec3;
use immerse::mesh::{Surface, shapes};
use immerse::metric::{Lengths, MetricProgram, lengths_of_positions};
use immerse::polish::mean_bending;
use immerse::spin::{Homology, SpinStructure};
use immerse::{Mesh, Metric, Program};
use std::sync::Arc;
use std::time::Instant;

/// A metric on a mesh, and a spin structure that rims are counted in.
pub struct Given {
    pub mesh: Arc<Mesh>,
    pub metric: Metric,
    pub spin: SpinStructure,
    /// What the mesh is.
    pub words: String,
}

impl Given {
    fn new(mesh: Mesh, lengths: Vec<f64>, words: String) -> Outcome<Given> {
        let metric = Metric::new(&mesh, lengths)?;
        let homology = Homology::new(&mesh, &metric);
        let spin = SpinStructure::of_class(&mesh, &metric, &homology, &vec![false; homology.betti()])?;
        Ok(Given { mesh: Arc::new(mesh), metric, spin, words })
    }

    fn program(&self) -> Program {
        Program::of(MetricProgram::of(Lengths::fixed(self.metric.edge_lengths().to_vec())))
    }

    fn surface(&self) -> Surface {
        let mesh = (*self.mesh).clone();
        Surface { mesh, positions: None, coordinates: None, edge_lengths: None, repairs: Vec::new() }
    }

    /// Our method.
    fn ours(&self, program: &Program) -> Outcome<Vec<Found>> {
        Polish::ALL.into_iter().map(|polish| solve(self.surface(), program.clone(), polish)).collect()
    }

    /// What positions are worth that some other method found.
    fn found(&self, positions: Vec<DVec3>, steps: usize, begin: Instant) -> Found {
        let seconds = begin.elapsed().as_secs_f64();
        let rims = rims_of(&self.mesh, &self.metric, &self.spin, &positions);
        Found {
            moments: Vec::new(),
            reports: vec![report_of(&self.mesh, &self.metric, &self.spin, &positions)],
            rims: rims.into_iter().map(|e| self.mesh.edge_vertices(e).map(|v| v.0)).collect(),
            bending_degrees: mean_bending(&self.mesh, &positions).to_degrees(),
            mesh: self.mesh.clone(),
            metric: self.metric.clone(),
            positions,
            steps,
            seconds,
        }
    }

    fn membrane(&self, bending: &[f64], mut positions: Vec<DVec3>) -> Outcome<Found> {
        let begin = Instant::now();
        let steps = membrane::relax(&self.mesh, &self.metric, bending, &mut positions)?;
        Ok(self.found(positions, steps, begin))
    }

    /// From random positions of each seed.
    fn membranes(&self, request: &Request, bending: &[f64]) -> Outcome<Vec<Found>> {
        let start = |seed| membrane::random_positions(&self.mesh, &self.metric, seed);
        request.seeds().into_iter().map(|seed| self.membrane(bending, start(seed))).collect()
    }

    /// The surface of the method that knows rotations only.
    pub fn rotations(&self, seed: u64) -> Outcome<Found> {
        let begin = Instant::now();
        let (positions, steps) = rotations::relax(self, seed)?;
        Ok(self.found(positions, steps, begin))
    }
}

/// The flat torus of Fig. 14, whose edges all have length 0.05: the paper's mesh or the one that ships.
pub fn torus(request: &Request) -> Outcome<Given> {
    let (surface, words) = match request.paper_mesh("torus.obj")?.filter(|_| !request.quick) {
        Some(path) => (immerse::mesh::read(&path)?, "the paper's own mesh, `torus.obj`"),
        None => {
            let keys: &[&str] = &["mesh.columns=30", "mesh.rows=24", "mesh.a=[1.5, 0]", "mesh.b=[0, 1.0392304845]"];
            let keys: Vec<String> = keys.iter().filter(|_| request.quick).map(|key| (*key).to_owned()).collect();
            (
                scene(&own("flat_torus_6000"), &keys, None)?.surface()?,
                "a rectangle of equilateral triangles, opposite sides glued",
            )
        }
    };
    let edges = surface.mesh.edge_count();
    Given::new(surface.mesh, vec![0.05; edges], words.to_owned())
}

/// A round sphere of unit radius, and the same deformed: star-shaped, smaller, with bulges.
fn sphere(request: &Request) -> Outcome<(Given, Vec<DVec3>)> {
    let surface = shapes::sphere(1.0, request.size(9, 4))?;
    let positions = surface.positions.unwrap_or_default();
    let lengths = lengths_of_positions(&surface.mesh, &positions);
    let bulge = |p: &DVec3| libm::sin(3.0 * p.x + 0.5) * libm::sin(4.0 * p.y + 1.0) * libm::cos(5.0 * p.z + 0.3);
    let deformed = positions.iter().map(|p| 0.7 * (1.0 + 0.5 * bulge(p)) * *p).collect();
    Ok((Given::new(surface.mesh, lengths, "a subdivided icosahedron".to_owned())?, deformed))
}
