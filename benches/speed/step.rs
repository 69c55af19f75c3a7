//! One gradient step at every Δt of the default phases, and the same systems for others to solve.

use std::{error::Error, fs, path::Path, time::Instant};

use glam::DQuat;
use immerse::{
    evolve::{Phase, Simulation},
    frames::{Shell, StepOptions, Stepper},
};
use serde_json::{Value, json};

use super::{npy, scenes::scene};

/// Steps that each phase takes before its systems are measured, so that they are those of a relaxation under way.
const STEPS: usize = 5;
/// Besides that of the phases. At 1 the start is good enough, and what is left is assembly and factorization.
const TOLERANCES: [f64; 2] = [1e-3, 1.0];

/// Writes what `paper_method.py` reads: triangles |F| × 3, the halfedges 3 f + k on the two sides of each edge (the second
/// −1 on the boundary), edge lengths |E|, transports |E| × 2 (real, imaginary), frames |F| × 4 (w, x, y, z).
pub fn write_problem(simulation: &Simulation, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mesh = simulation.mesh();
    let (faces, edges) = (mesh.face_count(), mesh.edge_count());
    fs::create_dir_all(folder)?;
    npy::integers(folder, "triangles", &[faces, 3], mesh.triangles().into_iter().flatten().map(i64::from))?;
    let sides = mesh.edges().flat_map(|edge| {
        let named = mesh.edge_halfedge(edge);
        [named.index() as i64, mesh.twin(named).map_or(-1, |twin| twin.index() as i64)]
    });
    npy::integers(folder, "edge_sides", &[edges, 2], sides)?;
    npy::doubles(folder, "edge_lengths", &[edges], simulation.metric().edge_lengths().iter().copied())?;
    let spin = simulation.spin();
    let transports = spin.transports().iter().flat_map(|tau| [tau.re, tau.im]);
    npy::doubles(folder, "transports", &[edges, 2], transports)?;
    write_frames(folder, "frames", &simulation.face_frames())?;
    Ok(())
}

fn write_frames(folder: &Path, name: &str, frames: &[DQuat]) -> std::io::Result<()> {
    npy::doubles(folder, name, &[frames.len(), 4], frames.iter().flat_map(|q| [q.w, q.x, q.y, q.z]))
}

/// Bytes per face that an iteration of the inner solve reads and writes, faces with three neighbours each: in each of the
/// two sweeps 1.5 blocks of the factor, 16 singles each, with their columns, the start of a row and a flag; of vectors of
/// four singles, backward: residual read, direction and spread read and written; forward: direction read, gathered
/// written, spread, solution and residual read and written. What a sweep has just touched counts as being in a cache.
pub const BYTES_PER_ITERATION: f64 = {
    let sweep = 1.5 * (64.0 + 4.0) + 4.0 + 1.0;
    let vector = 16.0;
    2.0 * sweep + (1.0 + 2.0 + 2.0) * vector + (1.0 + 1.0 + 2.0 + 2.0 + 2.0) * vector
};

/// Times whole steps (assembly, factorization, solve), `repeats` times each, and if a folder is given writes the problem
/// and the frames of each state there.
pub fn run(name: &str, repeats: usize, folder: Option<&Path>) -> Result<Value, Box<dyn Error>> {
    let simulation = scene(name)?.simulation()?;
    let shell = Shell::new(simulation.mesh(), simulation.metric(), &simulation.spin(), None)?;
    if let Some(folder) = folder {
        write_problem(&simulation, folder)?;
    }
    let options = |phase: &Phase| StepOptions {
        method: phase.method,
        stiffness: phase.stiffness,
        crease: 0.0,
        dt: phase.dt.in_face_areas(shell.face_count()),
        solver_tolerance: phase.solver_tolerance,
    };
    let phases: Vec<StepOptions> = simulation.phases().iter().map(options).collect();
    let mut frames = simulation.face_frames();
    drop(simulation);
    let mut stepper = Stepper::new(&shell);
    let mut states = Vec::new();
    for (number, options) in phases.iter().enumerate() {
        for _ in 0..STEPS {
            stepper.advance(&shell, options, &mut frames);
        }
        if phases[number + 1..].iter().any(|later| later.dt == options.dt) {
            continue; // the last phase of each Δt has the least bending stiffness and is the hardest
        }
        let mut solves = Vec::new();
        for tolerance in [&[options.solver_tolerance][..], &TOLERANCES].concat() {
            let options = StepOptions { solver_tolerance: tolerance, ..*options };
            let mut seconds = Vec::new();
            let mut iterations = 0;
            for _ in 0..repeats {
                let mut after = frames.clone();
                let begin = Instant::now();
                iterations = stepper.advance(&shell, &options, &mut after).iterations;
                seconds.push(begin.elapsed().as_secs_f64());
            }
            solves.push(json!({ "tolerance": tolerance, "iterations": iterations, "seconds": seconds }));
        }
        let state = format!("frames_phase{}", number + 1);
        if let Some(folder) = folder {
            write_frames(folder, &state, &frames)?;
            let mut solved = frames.clone();
            stepper.advance(&shell, &StepOptions { solver_tolerance: 1e-10, ..*options }, &mut solved);
            write_frames(folder, &format!("solved_phase{}", number + 1), &solved)?;
        }
        states.push(json!({
            "phase": number + 1, "dt": options.dt, "stiffness": options.stiffness, "frames": state, "solves": solves,
        }));
    }
    Ok(json!({ "faces": shell.face_count(), "bytes_per_iteration": BYTES_PER_ITERATION, "states": states }))
}
