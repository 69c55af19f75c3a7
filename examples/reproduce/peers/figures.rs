//! Fig. 9, 10 and 11: what comes of a membrane, of rotations, and of quaternions.

use super::{Given, membrane, sphere, torus};
use crate::document::{Line, Section};
use crate::pictures::{BESIDE, Style, Tile, picture_of, save, sheet};
use crate::request::{Outcome, Request};
use crate::solve::{Found, Polish};
use crate::table::{Paper, Sorted, Table, count, line, percent};
use immerse::Program;
use immerse::evolve::{AskedClass, Phase, Schedule, Start, TimeStep};
use immerse::render::LookName;
use immerse::spin::Class;

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
    let by_seed = |value: fn(&Found) -> usize| -> String {
        sorted.all().iter().map(|found| value(found).to_string()).collect::<Vec<_>>().join(" ")
    };
    let pinches = by_seed(|found| found.report().pinch_points);
    let rims = by_seed(|found| found.report().rims);
    let order = if sorted.is_single() { "" } else { " from the least error to the worst" };
    let state = format!("{pinches} pinch points, {rims} rims{order}");
    Line { paper: paper.map(str::to_owned), state, miss: String::new(), ..line(what, None, sorted, None) }
}

fn tile(name: &str, found: &Found, style: &Style) -> Outcome<Tile> {
    let picture = picture_of(&found.mesh, &found.positions, &found.rims, style, BESIDE)?;
    let report = found.report();
    let [pinches, rims] = [count(report.pinch_points, "pinch point"), count(report.rims, "rim")];
    let caption = format!("{name}: {}, {pinches}, {rims}", percent(found.l2()));
    Ok(Tile { picture, caption })
}

/// Our method from random frames of each seed, in the class of zeros: before and after polish.
fn ours(given: &Given, request: &Request, table: &mut Table) -> Outcome<Vec<Sorted>> {
    let mut stages: Vec<Vec<Found>> = Polish::ALL.map(|_| Vec::new()).into();
    for seed in request.seeds() {
        let program = Program { start: Start::Random(seed), ..given.program() };
        given.ours(&program)?.into_iter().zip(&mut stages).for_each(|(found, stage)| stage.push(found));
    }
    let name = |polish: Polish| format!("quaternions, {} polish", polish.name());
    Ok(stages.into_iter().zip(Polish::ALL).map(|(stage, polish)| add(table, &name(polish), stage)).collect())
}

pub fn figure_9(request: &Request) -> Outcome<Section> {
    let (given, deformed) = sphere(request)?;
    let mut table = Table::default();
    let stiff = add(&mut table, "membrane, stiff at first", given.membranes(request, &membrane::FROM_STIFF)?);
    let soft = add(&mut table, "membrane, soft", given.membranes(request, &membrane::FROM_SOFT)?);
    let ours = ours(&given, request, &mut table)?;
    let near = given.membrane(&membrane::FROM_SOFT, deformed.clone())?;
    table.add("membrane, soft, from the deformed sphere", &near);
    let phase = Phase {
        stiffness: [1.0, 0.0, 1.0, 0.1],
        dt: TimeStep::FaceAreas(1.0),
        tolerance_radians: 0.001_f64.to_radians(),
        ..Phase::default()
    };
    let program = Program {
        start: Start::at(deformed.clone()),
        schedule: Schedule::new(vec![phase])?,
        is_smooth: false,
        ..given.program()
    };
    let ours_near = given.ours(&program)?;
    for (found, polish) in ours_near.iter().zip(Polish::ALL) {
        table.add(&format!("quaternions, from the deformed sphere, {} polish", polish.name()), found);
    }
    let style = Style::from([0.4, -1.0, 0.5], LookName::Studio)?;
    let start = picture_of(&given.mesh, &deformed, &[], &style, BESIDE)?;
    let tiles = [
        Tile { picture: start, caption: "the deformed sphere".into() },
        tile("membrane from it", &near, &style)?,
        tile("quaternions from it", &ours_near[ours_near.len() - 1], &style)?,
        tile("membrane at random, stiff at first", stiff.median(), &style)?,
        tile("membrane at random, soft", soft.median(), &style)?,
        tile("quaternions at random", ours[ours.len() - 1].median(), &style)?,
    ];
    let image = save(request, "fig9", &sheet(&tiles, 3), "a sphere by a membrane and by quaternions")?;
    let words = format!(
        "The lengths of a round sphere ({}), from positions or frames drawn at random, and near a deformed sphere, which is what the paper shows. The membrane has \
        squared relative strains of edges plus squared mean curvature, whose weight falls tenfold from stage to stage, from 10⁻¹ (stiff at first) or 10⁻⁶ (soft) of the area to 10⁻⁶ or 10⁻⁷; \
        it is minimized by L-BFGS, preconditioned by its quadratic part. In the paper the membrane has an error of 1 % and 38 pinch points, and quaternions 0.6 % with 2 \
        pinch points joined by a short rim. Here the soft membrane crumples from random positions, at an error as small as that of an immersion; but stiff at first it finds the round sphere from \
        every seed, and even the soft one from this deformed sphere, which the paper's does not. On the torus of Fig. 10 stiffness at first does not help.",
        given.words
    );
    let near_line = Sorted::new(vec![near]);
    let ours_near: Vec<Sorted> = ours_near.into_iter().map(|found| Sorted::new(vec![found])).collect();
    let summary = vec![
        line_of_peer("Fig. 9, membrane near a deformed sphere", ["–", "1 %", "38 pinch points"], &near_line),
        line(
            "Fig. 9, quaternions near it",
            Some(Paper { faces: given.mesh.face_count(), l2_percent: 0.6, rims: 1 }),
            &ours_near[0],
            ours_near.get(1),
        ),
        line_of_peer("Fig. 9, membrane at random, stiff at first", ["–", "–", "–"], &stiff),
        line_of_peer("Fig. 9, membrane at random, soft", ["–", "–", "–"], &soft),
        line("Fig. 9, quaternions at random", None, &ours[0], ours.get(1)),
    ];
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}

pub fn figure_10(request: &Request) -> Outcome<Section> {
    let given = torus(request)?;
    let mut table = Table::default();
    let blind = request.seeds().into_iter().map(|seed| given.rotations(seed)).collect::<Outcome<Vec<_>>>()?;
    let blind = add(&mut table, "rotations", blind);
    let membrane = add(&mut table, "membrane", given.membranes(request, &membrane::FROM_STIFF)?);
    let ours = ours(&given, request, &mut table)?;
    let tiles = [
        tile("rotations", blind.median(), &Style::usual())?,
        tile("membrane", membrane.median(), &Style::usual())?,
        tile("quaternions", ours[ours.len() - 1].median(), &Style::usual())?,
    ];
    let image = save(request, "fig10", &sheet(&tiles, 3), "a flat torus by three methods")?;
    let words = format!(
        "The flat torus of Fig. 14 ({}). Rotations: frames, energy and phases as ours, without the stiffness of creases and without acceleration, but before each step the sign of τ is taken at each hinge such that \
        neighbouring frames agree, which is all that rotation matrices know; so no hinge is ever a rim. The membrane is that of Fig. 9, stiff at first. In the paper rotations have an \
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

const FIRST_PHASE: usize = 1;

pub fn figure_11(request: &Request) -> Outcome<Section> {
    let given = torus(request)?;
    let pinched = given.rotations(0)?;
    let mut table = Table::default();
    table.add("start: rotations, seed 0", &pinched);
    let mut tiles = vec![tile("start", &pinched, &Style::usual())?];
    let mut summary = Vec::new();
    // Without the first phase, whose stiffness would forget the start.
    let schedule = Schedule::new(Schedule::default().phases()[FIRST_PHASE..].to_vec())?;
    for number in 0..4 {
        let class = Class::of_number(number, given.mesh.betti());
        let start = Start::at(pinched.positions.clone());
        let program =
            Program { class: AskedClass::Of(class.clone()), start, schedule: schedule.clone(), ..given.program() };
        let stages: Vec<Sorted> = given.ours(&program)?.into_iter().map(|found| Sorted::new(vec![found])).collect();
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
        which end at its pinch points. The default phases but the first resolve them. The paper shows one class.";
    Ok(Section { summary, body: format!("{words}\n\n{table}\n{image}") })
}
