//! Algorithm 2: from a scene to frames, and from frames to a surface.

use super::{EvolveError, FrameReport, Observer, Phase, Progress, SetupError, phases_from_scene};
use crate::frames::{Shell, Stepper, energy, random_frames, spectral_frames};
use crate::immersion::*;
use crate::mesh::{self, EdgeId, Mesh, VertexId};
use crate::metric::{self, Metric};
use crate::scene::{BendingSection, Scene, StartSection};
use crate::spin::{Homology, SpinStructure, class_digits};
use glam::{DQuat, DVec3};

/// Everything that stays the same while the metric does, and the frames, which do not.
#[derive(Debug)]
pub struct Simulation {
    /// Connectivity.
    pub mesh: Mesh,
    /// What had to be repaired in the mesh, in words.
    pub repairs: Vec<String>,
    /// Edge lengths and what they determine.
    pub metric: Metric,
    /// Generators of the homology.
    pub homology: Homology,
    /// The regular homotopy class, as signs of τ.
    pub spin: SpinStructure,
    /// Stages of the relaxation.
    pub phases: Vec<Phase>,
    /// The state: one unit quaternion per face.
    pub frames: Vec<DQuat>,
    shell: Shell,
    poisson: Poisson,
    periods: Periods,
    pins: Vec<(VertexId, DVec3)>,
    stepper: Stepper,
}

/// A relaxed surface.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Vertex positions, |V|.
    pub positions: Vec<DVec3>,
    /// λ* of the positions with signs of the state, |F|.
    pub frames: Vec<DQuat>,
    /// Edges with rim bit 1.
    pub rims: Vec<EdgeId>,
    /// Interior vertices with figure-8 star.
    pub pinch_points: Vec<VertexId>,
    /// Measures.
    pub report: FrameReport,
}

impl Simulation {
    /// Lines 1 to 6 of Algorithm 2.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the scene is at fault.
    pub fn from_scene(scene: &Scene) -> Result<Simulation, SetupError> {
        let surface = mesh::from_scene(&scene.mesh, &scene.folder)?;
        let metric = metric::from_scene(&scene.metric, &scene.folder, &surface)?;
        let mesh::Surface { mesh, positions, repairs, .. } = surface;
        let positions = positions.as_deref();
        let homology = Homology::new(&mesh, &metric);
        let spin = spin_from_scene(&scene.spin, &mesh, &metric, &homology, positions)?;
        let bending = target_bending(scene.bending.as_ref(), &mesh, positions)?;
        let shell = Shell::new(&mesh, &metric, &spin, bending.as_deref());
        let pins = pins_from_scene(&scene.pins, &mesh, positions)?;
        let frames = start(scene.start, &mesh, &metric, &shell, positions)?;

        let pinned: Vec<VertexId> = pins.iter().map(|(v, _)| *v).collect();
        let poisson = Poisson::new(&mesh, &metric, &pinned)?;
        let free = if pins.is_empty() { None } else { Some(Poisson::new(&mesh, &metric, &[])?) };
        let periods = Periods::new(&mesh, &metric, &homology, free.as_ref().unwrap_or(&poisson));
        let stepper = Stepper::new(&shell);
        let phases = phases_from_scene(&scene.phases);
        Ok(Simulation { mesh, repairs, metric, homology, spin, phases, frames, shell, poisson, periods, pins, stepper })
    }

    /// Lines 7 to 9 of Algorithm 2: relaxes the frames through all phases and realizes the surface.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it or frames are no longer finite.
    pub fn relax(&mut self, observer: &mut dyn Observer) -> Result<Frame, EvolveError> {
        let phases = self.phases.clone();
        let (mut steps, mut converged) = (0, true);
        for (index, phase) in phases.iter().enumerate() {
            converged = false;
            for step in 1..=phase.max_steps {
                let before = self.frames.clone();
                let positions = self.step(phase);
                steps += 1;
                let turn = mean_turn(&self.shell, &before, &self.frames);
                if !turn.is_finite() {
                    return Err(EvolveError::Diverged { steps, phase: index });
                }
                let progress = Progress {
                    phase: index,
                    phases: phases.len(),
                    step,
                    max_steps: phase.max_steps,
                    turn: turn.to_degrees(),
                    tolerance: phase.tolerance_radians.to_degrees(),
                    l2_length_error: length_error(&self.mesh, &self.metric, &positions).l2,
                };
                if observer.after_step(&progress).is_break() {
                    return Err(EvolveError::Stopped { steps });
                }
                if step >= phase.min_steps && turn < phase.tolerance_radians {
                    converged = true;
                    break;
                }
            }
        }
        Ok(self.realize(steps, converged))
    }

    /// THE step (Alg. 8): frames along the gradient, the surface they integrate to, frames toward its own.
    /// Returns the positions of that surface.
    fn step(&mut self, phase: &Phase) -> Vec<DVec3> {
        self.stepper.advance(&self.shell, &phase.step, &mut self.frames);
        self.remove_periods(phase.periods);
        let positions = self.integrate();
        let target = frames_of_positions(&self.mesh, &self.metric, &positions, &self.frames);
        blend(&self.shell, &mut self.frames, &target, phase.feedback);
        positions
    }

    /// Moves frames toward those of their own edge vectors without the harmonic part.
    fn remove_periods(&mut self, amount: f64) {
        if amount > 0.0 && !self.periods.is_empty() {
            let mut vectors = edge_vectors(&self.mesh, &self.metric, &self.frames);
            let harmonic = self.periods.harmonic_part(&self.mesh, &self.metric, &vectors);
            vectors.iter_mut().zip(harmonic).for_each(|(v, h)| *v -= h);
            let target = frames_of_edge_vectors(&self.mesh, &self.metric, &vectors, &self.frames);
            blend(&self.shell, &mut self.frames, &target, amount);
        }
    }

    /// Algorithm 7: positions from the averaged edge vectors.
    fn integrate(&self) -> Vec<DVec3> {
        let vectors = edge_vectors(&self.mesh, &self.metric, &self.frames);
        self.poisson.solve(&self.mesh, &self.metric, &vectors, &self.pins)
    }

    /// Positions, rims and measures of the frames as they are.
    fn realize(&self, steps: usize, converged: bool) -> Frame {
        let Self { mesh, metric, shell, .. } = self;
        let positions = self.integrate();
        let frames = frames_of_positions(mesh, metric, &positions, &self.frames);
        let rims = rims(shell, &frames);
        let pinch_points = pinch_points(mesh, &positions);
        let error = length_error(mesh, metric, &positions);
        let class: Vec<bool> =
            self.homology.generators().iter().map(|g| is_figure_8(mesh, &positions, &g.strip)).collect();
        let stiffness = self.phases.last().map_or([1.0; 4], |phase| phase.step.stiffness);
        let vectors = edge_vectors(mesh, metric, &self.frames);
        let report = FrameReport {
            frame: 1,
            time: 0.0,
            l2_length_error: error.l2,
            max_length_error: error.max,
            median_length_error: error.median,
            p95_length_error: error.p95,
            rims: rims.len(),
            rim_length: rims.iter().map(|&e| metric.length(e)).sum(),
            pinch_points: pinch_points.len(),
            spin_class: class_digits(&class),
            energy: energy(shell, stiffness, &self.frames),
            period_error: self.periods.relative_error(mesh, metric, &vectors),
            steps,
            seconds: 0.0,
            converged,
        };
        Frame { positions, frames, rims, pinch_points, report }
    }
}

/// λ ← normalize((1 − t) λ + t λ*) with t = 1 − (1 − amount)^(Ā/A), which is `1 − exp(−Δt/(a A))` of Alg. 8 with
/// a chosen such that a face of mean area Ā moves by `amount`.
fn blend(shell: &Shell, frames: &mut [DQuat], target: &[DQuat], amount: f64) {
    let mean = shell.mean_face_area();
    for ((frame, target), area) in frames.iter_mut().zip(target).zip(&shell.face_areas) {
        let t = 1.0 - libm::pow(1.0 - amount, mean / area);
        *frame = (*frame * (1.0 - t) + *target * t).normalize();
    }
}

fn start(
    section: StartSection,
    mesh: &Mesh,
    metric: &Metric,
    shell: &Shell,
    positions: Option<&[DVec3]>,
) -> Result<Vec<DQuat>, SetupError> {
    let positions = || positions.ok_or(SetupError::StartWithoutPositions);
    Ok(match section {
        StartSection::Random(seed) => random_frames(mesh.face_count(), seed),
        StartSection::Spectral => spectral_frames(shell),
        StartSection::Mesh => rimless_frames(mesh, metric, shell, positions()?),
        StartSection::Mirror => {
            let mirrored: Vec<DVec3> = positions()?.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
            rimless_frames(mesh, metric, shell, &mirrored)
        }
    })
}

/// Target bending angles of `[bending]`, |E|, in radians.
fn target_bending(
    section: Option<&BendingSection>,
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Option<Vec<f64>>, SetupError> {
    let Some(section) = section else { return Ok(None) };
    let angles = bending_angles(mesh, positions.ok_or(SetupError::BendingWithoutPositions)?);
    Ok(Some(match section {
        BendingSection::Mesh => angles,
        // A reflection keeps the surface's orientation and turns every fold around.
        BendingSection::Mirror => angles.into_iter().map(|angle| -angle).collect(),
    }))
}
