//! A scene as a simulation.

use super::clock::clock_of;
use crate::evolve::{AskedClass, Polishing, Program, Simulation};
use crate::immersion::TargetBending;
use crate::mesh::Surface;
use crate::scene::{ClockSection, Scene, SceneError, SpinSection};
use crate::tuning::MOST_FACES_TO_POLISH;

impl Scene {
    /// The simulation of the scene.
    ///
    /// # Errors
    /// At the key that is at fault.
    pub fn simulation(&self) -> Result<Simulation, SceneError> {
        self.simulation_of(self.surface()?)
    }

    /// As [`Scene::simulation`], with a surface from memory in place of the scene's `[mesh]`.
    ///
    /// # Errors
    /// At the key that is at fault.
    pub fn simulation_of(&self, surface: Surface) -> Result<Simulation, SceneError> {
        let program = self.program(&surface)?;
        Simulation::new(surface, program).map_err(|error| self.setup_fault(&error))
    }

    /// What the scene asks of a surface.
    ///
    /// # Errors
    /// At the key that is at fault.
    pub fn program(&self, surface: &Surface) -> Result<Program, SceneError> {
        let parameters = self.parameters()?;
        let section = clock_of(self, &surface.mesh)?;
        let clock = self.times(&section)?;
        let metric = self.metric_program(surface, &parameters)?;
        let start = self.start_of(surface, &parameters, clock.start())?;
        let bending = self.target_bending(surface, start.positions(), &parameters)?;
        let pins = self.pins(surface, &parameters)?;
        let changes = metric.changes() || pins.changes() || bending.as_ref().is_some_and(TargetBending::changes);
        Ok(Program {
            metric,
            bending,
            pins,
            class: self.asked_class()?,
            start,
            orientation: self.start.orientation,
            schedule: self.schedule()?,
            accuracy: section.accuracy,
            is_smooth: self.is_smooth(),
            clock,
            pace: self.pace(&section, changes)?,
            fold: section.fold,
            polish: self.polishing(&section, surface.mesh.face_count()),
            max_bending_growth: self.polish.max_bending_growth,
        })
    }

    /// Which frames are polished. What takes long for what it gains has to be asked for.
    fn polishing(&self, clock: &ClockSection, faces: usize) -> Polishing {
        let is_usual = clock.frames == 1 || self.spin == SpinSection::All;
        let usual = if is_usual && clock.accuracy.is_none() && faces <= MOST_FACES_TO_POLISH {
            Polishing::Last
        } else {
            Polishing::Off
        };
        self.polish.enabled.unwrap_or(usual)
    }

    fn asked_class(&self) -> Result<AskedClass, SceneError> {
        Ok(match &self.spin {
            SpinSection::Automatic => AskedClass::OfMesh,
            SpinSection::Immersion => AskedClass::OfPositions,
            SpinSection::All => AskedClass::All,
            SpinSection::Digits(digits) => {
                AskedClass::Of(digits.parse().map_err(|error| self.complain_about("spin.class", &error))?)
            }
        })
    }
}
