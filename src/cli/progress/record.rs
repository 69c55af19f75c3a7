//! The lines of `--log json`: what each says, and under which name.

use serde::Serialize;
use serde_json::Value as Json;

use super::standing::{Standing, doing};
use crate::evolve::FrameReport;
use crate::scene::SceneError;

/// One line of the log. What is not known is left out.
#[derive(Debug, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) struct Record<'a> {
    pub event: &'a str,
    /// Since the program began.
    pub seconds: f64,
    #[serde(flatten)]
    pub facts: Facts<'a>,
}

#[derive(Debug, Default, Serialize)]
pub(super) struct Facts<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    doing: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frames_done: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frames: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rims: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures_done: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds_left: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    remedy: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    code: Option<u8>,
}

impl<'a> Facts<'a> {
    /// How far a run is.
    pub fn of(standing: &'a Standing) -> Facts<'a> {
        let kept = standing.kept();
        let step = standing.frames.as_ref().and_then(|frames| frames.now.as_ref());
        let stage = standing.pictures.as_ref().map(|pictures| pictures.stage);
        Facts {
            scene: standing.scene.as_deref(),
            doing: step.map(doing).or(stage).or(standing.setting_up.then_some("setting up")),
            frame: standing.frame(),
            frames_done: kept.frames.map(|[done, _]| done),
            frames: kept.frames.map(|[_, of]| of),
            error: step.map(|step| step.l2_length_error.into()),
            rims: step.map(|step| step.rims),
            pictures_done: kept.pictures.map(|[done, _]| done),
            pictures: kept.pictures.map(|[_, of]| of),
            seconds_left: standing.left().map(|left| left.as_secs()),
            ..Facts::default()
        }
    }

    /// A frame that is done.
    pub fn of_frame(standing: &'a Standing, report: &FrameReport) -> Facts<'a> {
        Facts {
            frame: Some(report.frame),
            doing: None,
            error: Some(report.l2_length_error.into()),
            rims: Some(report.rims),
            ..Facts::of(standing)
        }
    }

    /// A message.
    pub fn of_text(text: &'a str) -> Facts<'a> {
        Facts { text: Some(text), ..Facts::default() }
    }

    /// A mistake of a scene.
    pub fn of_mistake(mistake: &'a SceneError) -> Facts<'a> {
        Facts {
            file: Some(mistake.path.to_string_lossy().into_owned()),
            line: Some(mistake.line),
            column: Some(mistake.column),
            remedy: Some(&mistake.remedy),
            ..Facts::of_text(&mistake.reason)
        }
    }

    /// The end of the program.
    pub fn of_end(standing: &'a Standing, code: u8) -> Facts<'a> {
        Facts {
            code: Some(code),
            frame: None,
            doing: None,
            error: None,
            rims: None,
            seconds_left: None,
            ..Facts::of(standing)
        }
    }
}
