//! Pictures of frames through a moving camera with a shutter.

use glam::DVec3;

use super::{
    labels::{labels, texts},
    plan::Plan,
    quantities::Spreads,
    subject::{Beside, Subject},
};
use crate::{
    digest::Digest,
    evolve::{Frame, FrameReport},
    film::error::FilmError,
    render::{
        Camera, CameraMotion, Exposure, Extent, Legend, Look, Metadata, Output, Overlay, Picture, Plane, RenderError,
        render,
    },
};

/// Share of the width that is kept free for a legend.
const LEGEND_SHARE: f64 = 0.13;

/// Takes pictures of one size.
pub(super) struct Shots<'a> {
    plan: &'a Plan<'a>,
    subject: &'a Subject,
    camera: CameraMotion,
    look: Look,
    legend: Option<Legend>,
    ground: Plane,
    output: Output,
}

impl<'a> Shots<'a> {
    pub fn new(
        plan: &'a Plan,
        subject: &'a Subject,
        extent: &Extent,
        spreads: &Spreads,
        output: Output,
    ) -> Result<Self, RenderError> {
        let clock = &plan.scene.clock;
        let (look, legend) = subject.look(plan, spreads);
        let output = if legend.is_some() { output.reserving(LEGEND_SHARE) } else { output };
        let camera = CameraMotion::framing(&plan.view, extent, &output, [clock.start, clock.end])?;
        let (middle, radius) = camera.at(0.0, clock.start).subject();
        let cut = plan.scene.look.cut.map(|cut| {
            let normal = DVec3::from_array(cut.normal).normalize();
            Plane { normal, offset: normal.dot(middle) + cut.offset * radius }
        });
        let look = Look { cut, ..look };
        let up = camera.up();
        let ground = Plane { normal: up, offset: extent.lowest(up) };
        Ok(Self { plan, subject, camera, look, legend, ground, output })
    }

    /// A picture of a frame. While the shutter is open, vertices go straight toward the frame after it, and the camera
    /// goes on its way; layers are those of the moment when it opens. Without a next frame nothing moves.
    pub fn take(&self, frame: &Frame, beside: Beside) -> Result<Picture, FilmError> {
        let camera_section = &self.plan.scene.camera;
        let here = self.camera_at(frame.report.frame, 0.0);
        let mut moment = self.subject.moment(self.plan, frame, beside)?;
        let goals = moment.next_positions.clone();
        // Where they are going as seen from here, though the camera moves too.
        let carried = here.as_seen_by(&self.camera_at(frame.report.frame, 1.0));
        moment.next_positions.iter_mut().for_each(|place| *place = carried.transform_point3(*place));
        let picture = |positions: &[DVec3], camera: &Camera, output: &Output| {
            let scenery = self.subject.scenery(&moment, positions, self.ground);
            render(&scenery, camera, &self.plan.lights, &self.look, output)
        };
        let mut exposure = Exposure::of(picture(&moment.positions, &here, &self.output)?);
        if camera_section.shutter > 0.0 && !goals.is_empty() {
            let last = camera_section.shutter_samples.saturating_sub(1);
            for sample in 1..=last {
                let part = camera_section.shutter * sample as f64 / last as f64;
                let positions: Vec<DVec3> =
                    moment.positions.iter().zip(&goals).map(|(from, to)| from.lerp(*to, part)).collect();
                let camera = self.camera_at(frame.report.frame, part);
                exposure.add(&picture(&positions, &camera, &self.output.with_layers(false))?);
            }
        }
        let mut film = exposure.develop();
        if self.plan.scene.look.events {
            let marks = self.subject.places_of_events(frame, beside);
            film.draw_marks(&marks, &here, &self.look, &self.output);
        }
        let ink = film.ink();
        film.draw_overlay(&self.overlay(frame)?, ink);
        Ok(film)
    }

    fn overlay(&self, frame: &Frame) -> Result<Overlay, FilmError> {
        let scene = self.plan.scene;
        let corners = texts(scene).into_iter().map(|section| section.corner);
        Ok(Overlay {
            texts: corners.zip(labels(scene, &frame.report, self.subject.faces())?).collect(),
            legend: self.legend.clone(),
            text_size: scene.look.text_size.unwrap_or(1.0) as f32,
        })
    }

    /// What is known of a picture.
    pub fn metadata(&self, report: &FrameReport) -> Metadata {
        let scene = self.plan.scene;
        Metadata {
            scene: scene.name.clone(),
            frame: report.frame,
            time: report.time,
            frame_rate: scene.output.frame_rate,
            comment: labels(scene, report, self.subject.faces()).unwrap_or_default().join("\n"),
            camera: Some(self.camera_at(report.frame, 0.0)),
        }
    }

    /// All places of the camera that a picture is taken from while the shutter is open, and where it goes.
    pub fn cameras(&self, frame: usize) -> Vec<Camera> {
        let section = &self.plan.scene.camera;
        let last = section.shutter_samples.saturating_sub(1);
        let samples = (1..=last).map(|sample| section.shutter * sample as f64 / last as f64);
        samples.chain([1.0]).map(|part| self.camera_at(frame, part)).collect()
    }

    /// What holds for all pictures. The camera is told picture by picture.
    pub fn add_to(&self, digest: Digest) -> Digest {
        let Shots { plan: _, subject: _, camera: _, look, legend, ground, output } = self;
        digest.shown(look).shown(legend).shown(ground).shown(&output.with_layers(false))
    }

    pub fn plan(&self) -> &Plan<'a> {
        self.plan
    }

    pub fn subject(&self) -> &Subject {
        self.subject
    }

    /// What is up.
    pub fn up(&self) -> DVec3 {
        self.camera.up()
    }

    /// The look with the ranges of what it shows.
    pub fn look(&self) -> &Look {
        &self.look
    }

    /// The camera when this part of the time between a frame and the next one has passed.
    pub fn camera_at(&self, frame: usize, part: f64) -> Camera {
        let (clock, frames) = (&self.plan.clock, self.plan.scene.clock.frames);
        let time = clock.time(frame);
        let next = if frame < frames { clock.time(frame + 1) } else { clock.end() };
        self.camera.at(((frame - 1) as f64 + part) / frames as f64, time + (next - time) * part)
    }
}
