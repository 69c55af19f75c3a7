//! How pictures see a film, for those who take it elsewhere.

use std::path::Path;

use glam::DVec3;

use super::passes::{Arrivals, Survey, Watch, survey};
use super::plan::Plan;
use super::shots::Shots;
use crate::digest::Key;
use crate::film::error::FilmError;
use crate::immersion::FieldName;
use crate::render::{Camera, Lights, Look};

/// Camera, lights and colours of a film.
#[derive(Debug)]
pub(in crate::film) struct Views {
    /// Of each frame that was asked for.
    pub cameras: Vec<Camera>,
    /// What is up.
    pub up: DVec3,
    pub lights: Lights,
    /// With the range of what it shows.
    pub look: Look,
    /// What it shows as colour.
    pub field: Option<FieldName>,
    /// Of all this but the cameras.
    pub key: Key,
}

impl Views {
    /// Those of some frames, given by number in order.
    ///
    /// # Errors
    /// [`FilmError::NoSuchFrame`] if one is not there, [`FilmError::Render`] if there is no such camera.
    pub fn of(
        plan: &Plan,
        folder: &Path,
        frames: &[usize],
        arrivals: &Arrivals,
        watch: &mut Watch,
    ) -> Result<Views, FilmError> {
        let Survey { reel, subject, extent, spreads } = survey(plan, folder, frames, arrivals, watch)?;
        let shots = Shots::new(plan, &subject, &extent, &spreads, plan.output)?;
        Ok(Views {
            cameras: frames.iter().map(|&frame| shots.camera_at(frame, 0.0)).collect(),
            up: shots.up(),
            lights: plan.lights.clone(),
            look: shots.look().clone(),
            field: subject.color(),
            key: shots.key_of_film(reel.film())?,
        })
    }
}
