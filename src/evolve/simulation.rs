//! Algorithm 2: from a scene to frames, and from frames to a surface.

use super::acceleration::Acceleration;
use super::{Cursor, EvolveError, FrameReport, Observer, Phase, Progress, SetupError, phases_from_scene};
use crate::frames::{Shell, Stepper, energy, random_frames, spectral_frames};
use crate::immersion::*;
use crate::mesh::{self, EdgeId, Mesh, Surface, VertexId};
use crate::metric::{self, Metric};
use crate::scene::{BendingSection, MetricSection, Scene, StartSection};
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
    cursor: Cursor,
    /// What random frames are drawn with; `None` for other starts.
    seed: Option<u64>,
    /// The best attempt so far: its number of rims, and its frames.
    fewest_rims: Option<(usize, Vec<DQuat>)>,
    shell: Shell,
    poisson: Poisson,
    periods: Periods,
    pins: Vec<(VertexId, DVec3)>,
    /// The mesh's own positions where the metric is theirs: the surface is laid upon them.
    reference: Option<Vec<DVec3>>,
    stepper: Stepper,
}

/// A relaxed surface.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Vertex positions, |V|.
    pub positions: Vec<DVec3>,
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
        Simulation::new(scene, mesh::from_scene(&scene.mesh, &scene.folder)?)
    }

    /// As [`Simulation::from_scene`], with a surface from memory in place of the scene's `[mesh]`.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the scene does not fit the surface.
    pub fn new(scene: &Scene, surface: Surface) -> Result<Simulation, SetupError> {
        let metric = metric::from_scene(&scene.metric, &scene.folder, &surface)?;
        let metric_is_of_positions = scene.metric == MetricSection::OfMesh && surface.edge_lengths.is_none();
        let Surface { mesh, positions, repairs, .. } = surface;
        let reference = positions.clone().filter(|_| metric_is_of_positions);
        let positions = positions.as_deref();
        let homology = Homology::new(&mesh, &metric);
        let spin = spin_from_scene(&scene.spin, &mesh, &metric, &homology, positions)?;
        let bending = target_bending(scene.bending.as_ref(), &mesh, positions)?;
        let shell = Shell::new(&mesh, &metric, &spin, bending.as_deref());
        let pins = pins_from_scene(&scene.pins, &mesh, positions)?;
        let frames = start(scene.start, &mesh, &metric, &shell, positions)?;

        let pinned: Vec<VertexId> = pins.iter().map(|(v, _)| *v).collect();
        let poisson = Poisson::new(&mesh, &metric, &pinned)?;
        // Periods are those of the surface without its pins.
        let separate = !pins.is_empty() && homology.betti() > 0;
        let free = if separate { Some(Poisson::new(&mesh, &metric, &[])?) } else { None };
        let periods = Periods::new(&mesh, &metric, &homology, free.as_ref().unwrap_or(&poisson));
        let stepper = Stepper::new(&shell);
        let cursor = Cursor::default();
        let seed = if let StartSection::Random(seed) = scene.start { Some(seed) } else { None };
        let phases = phases_from_scene(&scene.phases);
        Ok(Simulation {
            mesh,
            repairs,
            metric,
            homology,
            spin,
            phases,
            frames,
            cursor,
            seed,
            fewest_rims: None,
            shell,
            poisson,
            periods,
            pins,
            reference,
            stepper,
        })
    }

    /// Lines 7 to 9 of Algorithm 2: relaxes the frames, through all phases or for some steps, and realizes the surface.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it or frames are no longer finite.
    pub fn relax(&mut self, steps: Option<usize>, observer: &mut dyn Observer) -> Result<Frame, EvolveError> {
        let mut acceleration = Acceleration::default();
        let mut left = steps.unwrap_or(usize::MAX);
        while left > 0
            && let Some(phase) = self.phases.get(self.cursor.phase).copied()
        {
            let before = self.frames.clone();
            let positions = self.step(&phase);
            left -= 1;
            self.cursor.step += 1;
            self.cursor.steps += 1;
            let turn = mean_turn(&self.shell, &before, &self.frames);
            if !turn.is_finite() {
                return Err(EvolveError::Diverged { steps: self.cursor.steps, phase: self.cursor.phase });
            }
            let l2_length_error = l2_length_error(&self.mesh, &self.metric, &positions);
            let settled = self.cursor.step >= phase.min_steps && turn < phase.tolerance_radians;
            let max_steps = self.patience(&phase, &positions);
            let progress =
                Progress { turn: turn.to_degrees(), max_steps, settled, l2_length_error, ..self.progress(&phase) };
            if observer.after_step(&progress).is_break() {
                return Err(EvolveError::Stopped { steps: self.cursor.steps });
            }
            if settled || self.cursor.step >= max_steps {
                self.cursor = Cursor { phase: self.cursor.phase + 1, step: 0, settled, ..self.cursor };
                acceleration = Acceleration::default();
                if steps.is_none() {
                    self.draw_anew_if_tangled(); // a film would jump
                }
            } else if phase.accelerate {
                acceleration.correct(&before, &mut self.frames);
            }
        }
        let mut positions = self.integrate();
        self.align(&mut positions);
        Ok(self.realize(positions))
    }

    /// Takes away the rigid motion that random frames leave to every component without pins: it is laid upon the
    /// mesh's own positions or, once all phases are done (on the way they would swing about), along its principal axes.
    fn align(&mut self, positions: &mut [DVec3]) {
        let relaxed = self.cursor.phase >= self.phases.len();
        let areas = self.metric.vertex_areas(&self.mesh);
        let mut motions = vec![None; positions.len()];
        for vertices in self.poisson.floating() {
            let of_component = |values: &[DVec3]| vertices.iter().map(|v| values[v.index()]).collect::<Vec<_>>();
            let (points, weights) =
                (of_component(positions), vertices.iter().map(|v| areas[v.index()]).collect::<Vec<_>>());
            let motion = match &self.reference {
                Some(reference) => RigidMotion::onto(&of_component(reference), &points, &weights),
                None if relaxed => RigidMotion::to_principal_axes(&points, &weights),
                None => continue,
            };
            vertices.iter().for_each(|v| motions[v.index()] = Some(motion));
        }
        for (position, motion) in positions.iter_mut().zip(&motions) {
            *position = motion.map_or(*position, |motion| motion.point(*position));
        }
        for (f, frame) in self.mesh.faces().zip(&mut self.frames) {
            let motion = motions[self.mesh.corners(f)[0].index()];
            *frame = motion.map_or(*frame, |motion| motion.frame(*frame));
        }
    }

    /// How many steps the phase may take, from what is known now: more while there are rims.
    fn patience(&self, phase: &Phase, positions: &[DVec3]) -> usize {
        let longer = self.cursor.step >= phase.max_steps && phase.untangle_steps > 0 && self.rims_at(positions) > 0;
        if longer { phase.max_steps + phase.untangle_steps } else { phase.max_steps }
    }

    /// Rims that are left in the end do not resolve any more; other random frames may do without them. When all
    /// attempts are used up, the one with the fewest rims is kept.
    fn draw_anew_if_tangled(&mut self) {
        let Some(seed) = self.seed else { return };
        if self.cursor.phase < self.phases.len() {
            return;
        }
        let tangles = self.rims_at(&self.integrate());
        if self.fewest_rims.as_ref().is_none_or(|(fewest, _)| tangles < *fewest) {
            self.fewest_rims = Some((tangles, self.frames.clone()));
        }
        if tangles > 0 && self.cursor.restarts < MAX_RESTARTS {
            self.cursor = Cursor { phase: 0, restarts: self.cursor.restarts + 1, ..self.cursor };
            // Seeds of restarts are far from those that users write.
            self.frames = random_frames(self.mesh.face_count(), seed ^ (self.cursor.restarts as u64) << 32);
        } else if let Some((_, frames)) = self.fewest_rims.take() {
            self.frames = frames;
        }
    }

    /// The number of rims of the surface at these positions.
    fn rims_at(&self, positions: &[DVec3]) -> usize {
        let frames = frames_of_positions(&self.mesh, &self.metric, positions, &self.frames);
        rims(&self.shell, &frames).len()
    }

    /// Goes on from frames and cursor of an earlier run of the same scene.
    pub fn resume(&mut self, frames: Vec<DQuat>, cursor: Cursor) {
        debug_assert_eq!(frames.len(), self.frames.len());
        self.frames = frames;
        self.cursor = cursor;
    }

    fn progress(&self, phase: &Phase) -> Progress {
        Progress {
            phase: self.cursor.phase,
            phases: self.phases.len(),
            restarts: self.cursor.restarts,
            step: self.cursor.step,
            max_steps: phase.max_steps,
            turn: 0.0,
            tolerance: phase.tolerance_radians.to_degrees(),
            settled: false,
            l2_length_error: 0.0,
        }
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

    /// Rims and measures of the frames as they are and the positions they integrate to.
    fn realize(&self, positions: Vec<DVec3>) -> Frame {
        let Self { mesh, metric, shell, .. } = self;
        let rims = rims(shell, &frames_of_positions(mesh, metric, &positions, &self.frames));
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
            cursor: self.cursor,
            seconds: 0.0,
            converged: self.cursor.phase >= self.phases.len() && self.cursor.settled,
        };
        Frame { positions, rims, pinch_points, report }
    }
}

/// How often frames are drawn anew at most.
const MAX_RESTARTS: usize = 4;

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
