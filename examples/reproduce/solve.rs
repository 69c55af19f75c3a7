//! From what is asked for to what is measured of the surface that was found.

use super::request::Outcome;
use glam::DVec3;
use immerse::evolve::{Frame, FrameReport, Polishing, Progress};
use immerse::mesh::{Mesh, Surface};
use immerse::polish::mean_bending;
use immerse::scene::Scene;
use immerse::{Metric, Program, Simulation};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Whether positions are polished to exact lengths in the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polish {
    /// The surface as frames integrate to it.
    Before,
    /// The last frame polished, which is the one that is told of.
    After,
}

impl Polish {
    /// All that is measured.
    pub const ALL: [Polish; 2] = [Polish::Before, Polish::After];

    /// THE place where a program is asked to polish or not to.
    fn ask(self, program: Program) -> Program {
        match self {
            Polish::Before => Program { polish: Polishing::Off, ..program },
            Polish::After => Program { polish: Polishing::Last, ..program },
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Polish::Before => "before",
            Polish::After => "after",
        }
    }
}

/// Moments that are kept of a film.
pub const MOMENTS: usize = 5;

/// The last surface of a simulation.
#[derive(Clone, Debug)]
pub struct Found {
    pub mesh: Arc<Mesh>,
    pub metric: Metric,
    pub positions: Vec<DVec3>,
    /// Of all frames; there is at least one.
    pub reports: Vec<FrameReport>,
    /// Some frames evenly over all, the first and the last among them, or the only one.
    pub moments: Vec<Arc<Frame>>,
    /// Of the last frame: ends of edges where it folds over.
    pub rims: Vec<[u32; 2]>,
    pub bending_degrees: f64,
    /// In all frames.
    pub steps: usize,
    pub seconds: f64,
}

impl Found {
    /// That of the last frame.
    pub fn report(&self) -> &FrameReport {
        &self.reports[self.reports.len() - 1]
    }

    /// The frame with the largest error.
    pub fn worst(&self) -> &FrameReport {
        let worse = |a: &&FrameReport, b: &&FrameReport| a.l2_length_error.total_cmp(&b.l2_length_error);
        self.reports.iter().max_by(worse).unwrap_or_else(|| self.report())
    }

    pub fn l2(&self) -> f64 {
        self.report().l2_length_error
    }
}

/// Reads a scene, with keys set beside it, and with another mesh if there is one.
pub fn scene(path: &Path, settings: &[String], mesh: Option<&PathBuf>) -> Outcome<Scene> {
    let mut scene = Scene::read_with(path, settings)?;
    if let Some(mesh) = mesh {
        scene.mesh = immerse::scene::MeshSection::File(mesh.clone());
    }
    Ok(scene)
}

/// Simulates a scene to its end.
pub fn solve_scene(scene: &Scene, polish: Polish) -> Outcome<Found> {
    let surface = scene.surface()?;
    let program = scene.program(&surface)?;
    solve(surface, program, polish)
}

/// Simulates all frames of a program.
pub fn solve(surface: Surface, program: Program, polish: Polish) -> Outcome<Found> {
    let begin = Instant::now();
    let mut simulation = Simulation::new(surface, polish.ask(program))?;
    let mut steps = 0;
    let mut count = |_: &Progress| {
        steps += 1;
        ControlFlow::Continue(())
    };
    let mut frame = simulation.next_frame(&mut count)?;
    let mut reports = vec![frame.report.clone()];
    let mut moments = vec![frame.clone()];
    let last = simulation.clock().frames() - 1;
    for number in 1..=last {
        frame = simulation.next_frame(&mut count)?;
        reports.push(frame.report.clone());
        if number * (MOMENTS - 1) / last >= moments.len() {
            moments.push(frame.clone());
        }
    }
    let seconds = begin.elapsed().as_secs_f64();
    let mesh = simulation.mesh().clone();
    Ok(Found {
        metric: simulation.metric().clone(),
        positions: frame.positions.clone(),
        rims: rims_of(&mesh, &frame),
        bending_degrees: mean_bending(&mesh, &frame.positions).to_degrees(),
        mesh,
        reports,
        moments,
        steps,
        seconds,
    })
}

/// Ends of the edges where a frame folds over.
pub fn rims_of(mesh: &Mesh, frame: &Frame) -> Vec<[u32; 2]> {
    frame.rims.iter().map(|&e| mesh.edge_vertices(e).map(|v| v.0)).collect()
}
