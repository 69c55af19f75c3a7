//! Texts with facts of a frame filled in.

use crate::{
    cache::FrameReport,
    scene::{Corner, LookName, Scene, TextSection},
};

/// What stands for facts in texts of a scene.
const NAMES: [&str; 9] = ["scene", "frame", "frames", "time", "error", "max_error", "class", "rims", "faces"];

/// The first name in braces that stands for nothing.
pub(super) fn unknown_name(text: &str) -> Option<&str> {
    let names = text.split('{').skip(1).filter_map(|rest| rest.split_once('}').map(|(name, _)| name));
    names.into_iter().find(|name| !NAMES.contains(name))
}

/// The texts of a scene; pictures of a field say which frame they are of and what it is worth, unless it says else.
pub(super) fn texts(scene: &Scene) -> Vec<TextSection> {
    if scene.look.texts.is_empty() && scene.look.preset == LookName::Error {
        let text = "length error {error}, largest {max_error}".into();
        return vec![TextSection { text, corner: Corner::BottomLeft }];
    }
    scene.look.texts.clone()
}

/// The texts of a scene as they stand on a frame of a surface with so many faces.
pub(super) fn labels(scene: &Scene, report: &FrameReport, faces: usize) -> Vec<String> {
    let facts = [
        scene.name.clone(),
        report.frame.to_string(),
        scene.clock.frames.to_string(),
        format!("{:.2}", report.time),
        percent(report.l2_length_error),
        percent(report.max_length_error),
        report.spin_class.clone(),
        report.rims.to_string(),
        faces.to_string(),
    ];
    let filled = |text: &str| {
        NAMES.iter().zip(&facts).fold(text.to_owned(), |text, (name, fact)| text.replace(&format!("{{{name}}}"), fact))
    };
    texts(scene).iter().map(|section| filled(&section.text)).collect()
}

/// As many digits as say something.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 10.0 { format!("{percent:.1} %") } else { format!("{percent:.2} %") }
}
