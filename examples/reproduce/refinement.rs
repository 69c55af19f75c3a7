//! Surfaces that are known, given by their lengths alone, at finer and finer resolutions.

use super::convex::hull_of_ellipsoid;
use super::document::{Line, Section};
use super::ideal::{Distance, distance, order};
use super::request::{Outcome, Request};
use super::solve::{Found, Polish, solve};
use super::table::{ours, percent};
use immerse::Program;
use immerse::evolve::{Schedule, Start};
use immerse::mesh::{Surface, shapes};
use immerse::metric::{Lengths, MetricProgram};
use std::fmt::Write;

/// A family of surfaces, by a number that doubles its resolution when it doubles.
struct Family {
    name: &'static str,
    /// How frames start, and so what the surface is known from.
    words: &'static str,
    make: fn(usize) -> Outcome<Surface>,
    sizes: [usize; 5],
    starts_there: bool,
}

fn torus(size: usize) -> Outcome<Surface> {
    Ok(shapes::torus(1.0, 0.4, 3 * size, 2 * size)?)
}

fn sphere(size: usize) -> Outcome<Surface> {
    Ok(shapes::sphere(1.0, size)?)
}

const FAMILIES: [Family; 3] = [
    Family {
        name: "sphere",
        words: "from random frames",
        make: sphere,
        sizes: [4, 8, 16, 32, 64],
        starts_there: false,
    },
    Family {
        name: "ellipsoid 1 : 0.7 : 0.5",
        words: "its convex hull, from random frames",
        make: hull_of_ellipsoid,
        sizes: [4, 8, 16, 32, 64],
        starts_there: false,
    },
    Family {
        name: "torus of revolution 1 : 0.4",
        words: "from its own frames, with the default last phase",
        make: torus,
        sizes: [8, 16, 32, 64, 128],
        starts_there: true,
    },
];

pub fn section(request: &Request) -> Outcome<Section> {
    let mut body = String::from(
        "Each surface is given by the edge lengths of its vertices alone, and compared with them after the best rigid motion and, if that \
        is nearer, reflection. Distances are shares of the diameter: the root of their mean square over the area, and the largest. The order is the \
        power of the edge length by which a number falls from the line before. All of these polyhedra are there with no error; what is measured is what the \
        method leaves, with its last bending stiffness of 1e-4 and where its steps end. A last order below 1 is a miss.\n",
    );
    let mut summary = Vec::new();
    let families = if request.quick { &FAMILIES[..1] } else { &FAMILIES[..] };
    for family in families {
        write!(body, "\n**{}**, {}:\n\n", family.name, family.words)?;
        body += "| faces | polish | distance | order | largest | L2 length error | order | rims, pinch points | seconds |\n";
        body += "|--:|---|--:|--:|--:|--:|--:|--:|--:|\n";
        let mut finest = Vec::new();
        let mut slowest = f64::INFINITY;
        for polish in Polish::ALL {
            let mut last: Option<(f64, Distance, f64)> = None;
            for size in &family.sizes[..request.size(5, 2)] {
                let surface = (family.make)(*size)?;
                let known = surface.positions.clone().unwrap_or_default();
                let found = of_lengths(surface, family.starts_there, polish)?;
                let edge = found.metric.edge_lengths().iter().sum::<f64>() / found.mesh.edge_count() as f64;
                let far = distance(&found.mesh, &found.metric, &known, &found.positions);
                let orders = last.map_or(["–".to_owned(), "–".to_owned()], |(long, before, error)| {
                    let edges = [long, edge];
                    [order([before.mean, far.mean], edges), order([error, found.l2()], edges)]
                        .map(|order| format!("{order:.1}"))
                });
                let [of_distance, of_error] = orders;
                let (mean, max, l2) = (percent(far.mean), percent(far.max), percent(found.l2()));
                let report = found.report();
                slowest = last.map_or(f64::INFINITY, |(long, before, _)| order([before.mean, far.mean], [long, edge]));
                writeln!(
                    body,
                    "| {} | {} | {mean} | {of_distance} | {max} | {l2} | {of_error} | {}, {} | {:.1} |",
                    found.mesh.face_count(),
                    polish.name(),
                    report.rims,
                    report.pinch_points,
                    found.seconds
                )?;
                if *size == family.sizes[request.size(5, 2) - 1] {
                    finest.push((found.mesh.face_count(), far, found.l2()));
                }
                last = Some((edge, far, found.l2()));
            }
        }
        summary.push(line(family, &finest, slowest));
    }
    Ok(Section { summary, body })
}

/// Distances that are rounding, of which no order can be told.
const EXACT: f64 = 1e-9;

/// The line of a family: its finest surface before and after polish, and the last order of the distance.
fn line(family: &Family, finest: &[(usize, Distance, f64)], order: f64) -> Line {
    let errors: Vec<String> = finest.iter().map(|(_, _, l2)| percent(*l2)).collect();
    let (faces, far) = finest.last().map_or((0, f64::INFINITY), |(faces, far, _)| (*faces, far.mean));
    let miss = if order < 1.0 && far > EXACT { format!("no convergence, order {order:.1}") } else { String::new() };
    Line {
        what: format!("refinement, {}", family.name),
        paper: ["–", "–", "–"].map(str::to_owned),
        ours: ours(faces, &errors),
        state: format!("{} away", percent(far)),
        miss,
    }
}

/// Solves for the lengths of a surface, from random frames or from its own.
pub fn of_lengths(mut surface: Surface, starts_there: bool, polish: Polish) -> Outcome<Found> {
    let program = Program::of(MetricProgram::of(Lengths::of_surface(&surface)?));
    // Positions are known to the comparison alone, unless frames start there.
    let known = surface.positions.take().unwrap_or_default();
    let program = match starts_there {
        true => Program { start: Start::at(known), schedule: Schedule::of_last_phase(), ..program },
        false => program,
    };
    solve(surface, program, polish)
}
