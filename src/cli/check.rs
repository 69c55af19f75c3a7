//! What is worth saying of a scene before anything is computed.

use super::failure::PipelineError;
use super::progress::Log;
use super::selections::selection_notes;
use super::set_up::{SetUp, contradictions, frame_keys};
use crate::evolve::Simulation;
use crate::film::Plan;
use crate::mesh::{longest_loops, outer_loops};
use crate::scene::{Scene, SpinSection, clock_of, phases_as_text};
use crate::spin::{Class, SpinError};

/// Validates everything the scene names, without writing. Returns what is worth saying: sizes, generators, repairs.
pub(super) fn check(scene: &Scene, log: &Log) -> Result<Vec<String>, PipelineError> {
    let SetUp { mut simulation, places, notes: of_mesh } = SetUp::of(scene)?;
    frame_keys(scene, &mut simulation)?;
    contradictions(scene, &simulation)?.iter().for_each(|warning| log.warning(warning));
    let plan = Plan::of(scene)?;
    let [width, height] = plan.size();
    let mesh = simulation.mesh();
    let mut notes = vec![format!(
        "{} vertices, {} edges, {} faces, genus {}, {} boundary loops, {} components",
        mesh.vertex_count(),
        mesh.edge_count(),
        mesh.face_count(),
        mesh.genus(),
        mesh.boundary_loops().len(),
        mesh.components().len()
    )];
    if scene.spin == SpinSection::All {
        let frames = clock_of(scene, mesh).map_or(1, |clock| clock.frames);
        let betti = mesh.betti();
        let which = if betti < 20 && frames == 1 << betti { "each of" } else { "the first of" };
        notes.push(format!("{frames} frames, one for {which} the 2^{betti} classes"));
    }
    let class = simulation.class();
    for (k, (generator, &q)) in simulation.homology().generators().iter().zip(class.digits()).enumerate() {
        notes.push(format!(
            "generator {} of length {:.4} through {} faces: q = {}",
            k + 1,
            generator.length,
            generator.strip.exits().len(),
            u8::from(q)
        ));
    }
    let (loops, places) = (mesh.boundary_loops(), places.as_deref());
    let (outer, longest) = (outer_loops(mesh, places), longest_loops(mesh, places));
    for (k, cycle) in loops.iter().enumerate() {
        let length: f64 = cycle.iter().map(|&h| simulation.metric().length(mesh.edge(h))).sum();
        let names = if loops.len() == 1 { String::new() } else { names_of_loop(k, &outer, &longest) };
        notes.push(format!("boundary loop {k} of length {length:.4} with {} vertices{names}", cycle.len()));
    }
    notes.extend(selection_notes(scene, mesh, places));
    notes.extend(simulation.class_of_start().map(|start| start_and_target(start, &simulation)));
    notes.extend(of_mesh);
    notes.push(format!("pictures of {width} x {height} pixels"));
    notes.extend(plan.notes());
    Ok(notes)
}

/// What a boundary loop is called beside its number.
fn names_of_loop(k: usize, outer: &[usize], longest: &[usize]) -> String {
    match (outer.contains(&k), longest.contains(&k)) {
        (true, true) => " (outer, longest)".to_owned(),
        (true, false) => " (outer)".to_owned(),
        (false, true) => " (longest)".to_owned(),
        (false, false) => String::new(),
    }
}

/// The phases of a scene as they can be pasted into one, where they replace the default ones and change nothing.
pub(super) fn phases(scene: &Scene) -> Result<String, PipelineError> {
    let SetUp { simulation, .. } = SetUp::of(scene)?;
    let phases = simulation.phases();
    let count = phases.len();
    let mut text = format!("# The {count} phases of {}.", scene.name);
    if scene.clock.frames > 1 {
        text += " Frames that follow in a film take the last one, with the tolerance and\n# max_steps of [clock].";
    }
    text.push('\n');
    text += &phases_as_text(phases, simulation.mesh().face_count());
    Ok(text)
}

/// Whether what frames start from and what they go to are in one class. A film cannot pass from one to another.
fn start_and_target(start: Result<Class, SpinError>, simulation: &Simulation) -> String {
    let target = simulation.class();
    match start {
        Ok(start) if start != target => format!(
            "start and target are not in one class: the start is in {}, the target in {}, so rims or pinch points will \
             stay; write class = {:?}, or start from another shape",
            start,
            target,
            start.to_string()
        ),
        Ok(_) if target.digits().is_empty() => "start and target are in one class, there is no other".to_owned(),
        Ok(_) => format!("start and target are in one class, {}", target),
        Err(SpinError::NotAnImmersion { pinch_points }) => format!(
            "the start is in no class: {pinch_points} of its vertex stars are figure-8, so it is no immersion; start \
             from a shape without, or expect that rims resolve on the way"
        ),
        Err(error) => error.to_string(),
    }
}
