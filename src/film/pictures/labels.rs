//! Texts with facts of a frame filled in.

use crate::film::error::FilmError;
use crate::{
    evolve::FrameReport,
    render::{Corner, LookName, fill_in},
    scene::{Scene, TextSection},
};

/// The texts of a scene; pictures of a field say which frame they are of and what it is worth, unless it says else.
pub(super) fn texts(scene: &Scene) -> Vec<TextSection> {
    if scene.look.texts.is_empty() && scene.look.preset == LookName::Error {
        let text = "length error {error}, largest {max_error}".into();
        return vec![TextSection { text, corner: Corner::BottomLeft }];
    }
    scene.look.texts.clone()
}

/// The texts of a scene as they stand on a frame of a surface with so many faces.
///
/// # Errors
/// [`FilmError::Scene`] if one asks for what is not known.
pub(super) fn labels(scene: &Scene, report: &FrameReport, faces: usize) -> Result<Vec<String>, FilmError> {
    let facts = [
        ("scene", scene.name.clone()),
        ("frame", report.frame.to_string()),
        ("frames", scene.clock.frames.to_string()),
        ("time", format!("{:.2}", report.time)),
        ("error", percent(report.l2_length_error)),
        ("max_error", percent(report.max_length_error)),
        ("class", report.spin_class.clone()),
        ("rims", report.rims.to_string()),
        ("faces", faces.to_string()),
    ];
    let fill = |(index, section): (usize, &TextSection)| {
        fill_in(&section.text, &facts)
            .map_err(|error| scene.complain_about(&format!("look.text[{index}].text"), &error))
    };
    Ok(texts(scene).iter().enumerate().map(fill).collect::<Result<_, _>>()?)
}

/// As many digits as say something.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 10.0 { format!("{percent:.1} %") } else { format!("{percent:.2} %") }
}
