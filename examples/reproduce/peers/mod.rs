//! The methods that the paper compares itself with in Sec. 6.1, on the same scenes: Fig. 9, 10 and 11.

mod membrane;
mod rotations;

use super::document::{Line, Section};
use super::measure::{mean_bending_degrees, report_of, rims_of};
use super::pictures::{BESIDE, Style, Tile, picture_of, save, sheet};
use super::request::{Outcome, Request, own};
use super::solve::{Found, Polish, scene, solve};
use super::table::{Sorted, Table, line, percent};
use glam::DVec3;
use immerse::evolve::{AskedClass, Start};
use immerse::mesh::{Surface, shapes};
use immerse::metric::{Lengths, MetricProgram};
use immerse::spin::{Class, Homology, SpinStructure};
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

    /// Our method in a class.
    fn ours(&self, class: Class, start: Start) -> Outcome<Vec<Found>> {
        let program = Program { class: AskedClass::Of(class), start, ..self.program() };
        Polish::ALL.into_iter().map(|polish| solve(self.surface(), program.clone(), polish)).collect()
    }

    /// What positions are worth that some other method found.
    fn found(&self, positions: Vec<DVec3>, steps: usize, begin: Instant) -> Found {
        let seconds = begin.elapsed().as_secs_f64();
        let rims = rims_of(&self.mesh, &self.metric, &self.spin, &positions);
        Found {
            reports: vec![report_of(&self.mesh, &self.metric, &self.spin, &positions)],
            rims: rims.into_iter().map(|e| self.mesh.edge_vertices(e).map(|v| v.0)).collect(),
            bending_degrees: mean_bending_degrees(&self.mesh, &positions),
            mesh: self.mesh.clone(),
            metric: self.metric.clone(),
            face_frames: Vec::new(),
            positions,
            steps,
            seconds,
        }
    }

    fn membrane(&self, seed: u64) -> Outcome<Found> {
        let begin = Instant::now();
        let (positions, steps) = membrane::relax(&self.mesh, &self.metric, seed)?;
        Ok(self.found(positions, steps, begin))
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

fn sphere(request: &Request) -> Outcome<Given> {
    let (surface, words) = match request.paper_mesh("sphere.obj")?.filter(|_| !request.quick) {
        Some(path) => (immerse::mesh::read(&path)?, "the paper's own mesh, `sphere.obj`"),
        None => (shapes::sphere(1.0, request.size(9, 4))?, "a subdivided icosahedron"),
    };
    let lengths =
        immerse::metric::lengths_of_positions(&surface.mesh, surface.positions.as_deref().unwrap_or_default());
    Given::new(surface.mesh, lengths, words.to_owned())
}

/// Adds median and worst of some seeds to a table.
fn add(table: &mut Table, what: &str, all: Vec<Found>) -> Sorted {
    let sorted = Sorted::new(all);
    table.add(&format!("{what}, median"), sorted.median());
    if !sorted.is_single() {
        table.add(&format!("{what}, worst"), sorted.worst());
    }
    sorted
}

/// The line of a method that is not ours: what it is stuck with is no miss of this program.
fn line_of_peer(what: &str, paper: [&str; 3], sorted: &Sorted) -> Line {
    let pinches: Vec<String> = sorted.all().iter().map(|found| found.report().pinch_points.to_string()).collect();
    let state =
        format!("{}, {} (median of errors)", sorted.median().report().rims, sorted.median().report().pinch_points);
    Line {
        paper: paper.map(str::to_owned),
        state,
        miss: String::new(),
        ..line(&format!("{what}; pinch points by seed: {}", pinches.join(", ")), None, sorted, None)
    }
}

fn tile(name: &str, found: &Found, style: &Style) -> Outcome<Tile> {
    let picture = picture_of(&found.mesh, &found.positions, &found.rims, style, BESIDE)?;
    let report = found.report();
    let caption =
        format!("{name}: {}, {} pinch points, {} rims", percent(found.l2()), report.pinch_points, report.rims);
    Ok(Tile { picture, caption })
}

/// Our method from random frames of each seed: before and after polish.
fn ours(given: &Given, request: &Request) -> Outcome<Vec<Sorted>> {
    let mut stages: Vec<Vec<Found>> = Polish::ALL.map(|_| Vec::new()).into();
    for seed in request.seeds() {
        let class = Class::new(vec![false; given.mesh.betti()]);
        given
            .ours(class, Start::Random(seed))?
            .into_iter()
            .zip(&mut stages)
            .for_each(|(found, stage)| stage.push(found));
    }
    Ok(stages.into_iter().map(Sorted::new).collect())
}

pub fn figure_9(request: &Request) -> Outcome<Section> {
    let given = sphere(request)?;
    let mut table = Table::default();
    let peer = request.seeds().into_iter().map(|seed| given.membrane(seed)).collect::<Outcome<Vec<_>>>()?;
    let peer = add(&mut table, "membrane", peer);
    let ours = ours(&given, request)?;
    for (sorted, polish) in ours.iter().zip(Polish::ALL) {
        add(&mut table, &format!("quaternions, {} polish", polish.name()), sorted.all().to_vec());
    }
    let tiles =
        [tile("membrane", peer.median(), &Style::usual())?, tile("quaternions", ours[0].median(), &Style::usual())?];
    let image = save(request, "fig9", &sheet(&tiles, 2), "a sphere by a membrane and by quaternions")?;
    let words = format!(
        "The lengths of a round sphere ({}). The membrane: positions drawn at random in a ball, then squared relative strains of edges plus squared \
        mean curvature, whose weight falls from 10⁻¹ of the area to 10⁻⁶ in six stages (L-BFGS preconditioned by the quadratic part). In the paper it has an error of 1 % and 38 \
        pinch points, and quaternions 0.6 % with 2 pinch points joined by a short rim.",
        given.words
    );
    let summary = vec![
        line_of_peer("Fig. 9, membrane on a sphere", ["–", "1 %", "38 pinch points"], &peer),
        line("Fig. 9, quaternions on it", None, &ours[0], ours.get(1)),
    ];
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}

pub fn figure_10(request: &Request) -> Outcome<Section> {
    let given = torus(request)?;
    let mut table = Table::default();
    let blind = request.seeds().into_iter().map(|seed| given.rotations(seed)).collect::<Outcome<Vec<_>>>()?;
    let blind = add(&mut table, "rotations", blind);
    let membrane = request.seeds().into_iter().map(|seed| given.membrane(seed)).collect::<Outcome<Vec<_>>>()?;
    let membrane = add(&mut table, "membrane", membrane);
    let ours = ours(&given, request)?;
    for (sorted, polish) in ours.iter().zip(Polish::ALL) {
        add(&mut table, &format!("quaternions, {} polish", polish.name()), sorted.all().to_vec());
    }
    let tiles = [
        tile("rotations", blind.median(), &Style::usual())?,
        tile("membrane", membrane.median(), &Style::usual())?,
        tile("quaternions", ours[0].median(), &Style::usual())?,
    ];
    let image = save(request, "fig10", &sheet(&tiles, 3), "a flat torus by three methods")?;
    let words = format!(
        "The flat torus of Fig. 14 ({}). Rotations: frames and energy as ours with the phases of the paper's kind, but before each step the sign of τ is taken at each hinge such that \
        neighbouring frames agree, which is all that rotation matrices know; so no hinge is ever a rim. The membrane is that of Fig. 9. In the paper rotations have an \
        error of 0.9 % and the membrane 2 %, both with pinch points. Red are pinch points, and the rims that the surface has in class 00.",
        given.words
    );
    let summary = vec![
        line_of_peer("Fig. 10, rotations on a flat torus", ["–", "0.9 %", "pinched"], &blind),
        line_of_peer("Fig. 10, membrane on it", ["–", "2 %", "pinched"], &membrane),
        line("Fig. 10, quaternions on it, class 00", None, &ours[0], ours.get(1)),
    ];
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}

pub fn figure_11(request: &Request) -> Outcome<Section> {
    let given = torus(request)?;
    let pinched = given.rotations(0)?;
    let mut table = Table::default();
    table.add("start: rotations, seed 0", &pinched);
    let mut tiles = vec![tile("start", &pinched, &Style::usual())?];
    let mut summary = Vec::new();
    for number in 0..4 {
        let class = Class::of_number(number, given.mesh.betti());
        let mut made = given.ours(class.clone(), Start::at(pinched.positions.clone()))?.into_iter();
        let stages: Vec<Sorted> = made.by_ref().map(|found| Sorted::new(vec![found])).collect();
        for (sorted, polish) in stages.iter().zip(Polish::ALL) {
            table.add(&format!("to class {class}, {} polish", polish.name()), sorted.median());
        }
        tiles.push(tile(&format!("to class {class}"), stages[stages.len() - 1].median(), &Style::usual())?);
        summary.push(line(
            &format!("Fig. 11, from {} pinch points to class {class}", pinched.report().pinch_points),
            None,
            &stages[0],
            stages.get(1),
        ));
    }
    let image = save(request, "fig11", &sheet(&tiles, 3), "from a pinched torus to immersions of all classes")?;
    let words = "The pinched surface of Fig. 10 (rotations, seed 0) is where our method starts, once in each class. In a class it is an immersion with rims, \
        which end at its pinch points and are resolved by the default phases. The paper shows one class.";
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}
