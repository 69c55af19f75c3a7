//! Why a picture cannot be made, and what to do about it.

use std::{fmt, path::PathBuf};

use glam::{DVec3, Vec3};

use crate::advice::Advice;

/// Why a picture cannot be made. As a text it says the reason and, behind a semicolon, what to do.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// An index points past the list of positions.
    #[error("{list} {item} uses vertex {vertex}, but there are only {vertices} positions; {}", self.remedy())]
    MissingVertex {
        /// Which list of the scenery.
        list: &'static str,
        /// Place in that list.
        item: usize,
        /// The vertex asked for.
        vertex: u32,
        /// How many positions there are.
        vertices: usize,
    },
    /// A list of the scenery does not fit the surface.
    #[error("{list} has {found} values where there must be {wanted}; {}", self.remedy())]
    Length {
        /// Which list.
        list: String,
        /// How many values it has.
        found: usize,
        /// How many it must have.
        wanted: usize,
    },
    /// A vector of the view has no direction.
    #[error("{element} = {} has no direction; {}", list(*vector), self.remedy())]
    NoDirection {
        /// Which vector.
        element: ViewElement,
        /// The vector as given.
        vector: DVec3,
    },
    /// What is to be upward in the picture points to the eye, or away from it.
    #[error("up = {} is parallel to the direction of view; {}", list(*up), self.remedy())]
    UpAlongView {
        /// The upward direction, with length 1.
        up: DVec3,
    },
    /// A number of the view is out of range.
    #[error("{element} = {value} is out of range; {}", self.remedy())]
    ViewRange {
        /// Which number.
        element: ViewElement,
        /// The number as given; angles are in degrees.
        value: f64,
        /// The least and the greatest number that is possible, in the same unit.
        range: [f64; 2],
    },
    /// A number of the view is infinite or not a number.
    #[error("{element} is not finite; {}", self.remedy())]
    ViewNotFinite {
        /// Which number.
        element: ViewElement,
    },
    /// The times of the keys of a view do not grow.
    #[error("the key at time {later} comes after the one at {earlier}; {}", self.remedy())]
    ViewKeyOrder {
        /// Time of the first key of a pair.
        earlier: f64,
        /// Time of the second one, which is not later.
        later: f64,
    },
    /// No frame has a finite position, so there is nothing to point the camera at.
    #[error("none of the positions is finite, so there is nothing to look at; {}", self.remedy())]
    NothingToFrame,
    /// The direction of a light has no length.
    #[error("direction = {} has no direction; {}", list(direction.as_dvec3()), self.remedy())]
    LightDirection {
        /// The direction as given.
        direction: Vec3,
    },
    /// The colour of a light is negative or not finite.
    #[error("color = {} has a negative or non-finite part; {}", list(color.as_dvec3()), self.remedy())]
    LightColor {
        /// The colour as given.
        color: Vec3,
    },
    /// A share of the look is out of range.
    #[error("{element} = {value} is not between 0 and 1; {}", self.remedy())]
    Share {
        /// Which share.
        element: LookElement,
        /// The value as given.
        value: f32,
    },
    /// The width of a line is negative or not finite.
    #[error("the width {width} of {element} is not a length; {}", self.remedy())]
    LineWidth {
        /// Which line.
        element: LookElement,
        /// The width as given.
        width: f32,
    },
    /// The periods of a pattern are not finite.
    #[error("the periods {} and {} of the pattern are not finite; {}", periods[0], periods[1], self.remedy())]
    Periods {
        /// The periods as given.
        periods: [f32; 2],
    },
    /// What the surface is cut with is no plane.
    #[error("the cut has the normal {} and the offset {offset}; {}", list(*normal), self.remedy())]
    Cut {
        /// The normal as given, which does not have length 1.
        normal: DVec3,
        /// Its distance from the origin.
        offset: f64,
    },
    /// The picture of a sphere cannot be read.
    #[error("matcap: {} cannot be read ({reason}); {}", path.display(), self.remedy())]
    Matcap {
        /// The file.
        path: PathBuf,
        /// What the system or the decoder said.
        reason: String,
    },
    /// A label cannot be filled in.
    #[error("text = {text:?} {fault}; {}", self.remedy())]
    Label {
        /// The label as given.
        text: String,
        /// What is wrong with it.
        fault: LabelFault,
    },
    /// The picture has no pixels or too many.
    #[error("size = [{width}, {height}] is not possible; {}", self.remedy())]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// The most a side may have.
        limit: usize,
    },
    /// The part of the picture that is wanted does not lie in it.
    #[error(
        "crop {window:?} (x, y, width, height) does not lie in the picture of {width} x {height} pixels; {}",
        self.remedy()
    )]
    Crop {
        /// The part.
        window: [usize; 4],
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// There is no pattern with this number of samples.
    #[error("samples = {samples} is not available; {}", self.remedy())]
    Samples {
        /// Samples per pixel as given.
        samples: usize,
    },
    /// There are more triangles or lines than ids in the visibility buffer.
    #[error("{count} primitives are too many for one picture; {}", self.remedy())]
    TooManyPrimitives {
        /// How many triangles or lines there are.
        count: usize,
        /// How many a picture takes of each.
        limit: usize,
    },
    /// A picture could not be written.
    #[error("cannot write {}: {reason}; {}", path.display(), self.remedy())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        reason: String,
    },
}

impl Advice for RenderError {
    fn remedy(&self) -> String {
        match self {
            RenderError::MissingVertex { .. } => "pass the positions this connectivity belongs to".into(),
            RenderError::Length { .. } => "pass one per triangle or vertex of this surface".into(),
            RenderError::NoDirection { .. } => "write a finite vector that is not zero, like [0, 0, 1]".into(),
            RenderError::UpAlongView { .. } => "turn one of them, or leave `up` out".into(),
            RenderError::ViewRange { element: ViewElement::Key(_), .. } => "write a factor above 0".into(),
            RenderError::ViewRange { range: [low, high], .. } => format!("{low} to {high}"),
            RenderError::ViewNotFinite { .. } => "write a finite number".into(),
            RenderError::ViewKeyOrder { .. } => "write keys in the order of their times".into(),
            RenderError::NothingToFrame => "check the simulation that made them".into(),
            RenderError::LightDirection { .. } => {
                "write a vector toward the light in view space, like [-0.5, 0.6, 0.6]".into()
            }
            RenderError::LightColor { .. } => "write linear red, green and blue like [0.8, 0.78, 0.74]".into(),
            RenderError::Share { .. } => "write 0 for none, 1 for all".into(),
            RenderError::LineWidth { .. } => "write a number of pixels, 0 for no line".into(),
            RenderError::Periods { .. } => "give widths in the units of the fields that the pattern runs along".into(),
            RenderError::Cut { .. } => "give a normal of length 1 and a finite offset".into(),
            RenderError::Matcap { .. } => "give a PNG of a lit sphere that fills the picture".into(),
            RenderError::Label { fault, .. } => fault.remedy(),
            RenderError::Size { limit, .. } => format!("each side is at least 1 and at most {limit} pixels"),
            RenderError::Crop { .. } => "write a part of it".into(),
            RenderError::Samples { .. } => "write 1, 4, 8 or 16".into(),
            RenderError::TooManyPrimitives { limit, .. } => {
                format!("it takes up to {limit} triangles and as many lines")
            }
            RenderError::Write { .. } => "check that the folder exists, is writable and has space left".into(),
        }
    }
}

/// What a view is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewElement {
    /// The direction from the surface to the eye.
    Direction,
    /// The direction that is upward in the picture.
    Up,
    /// The vertical field of view.
    FieldOfView,
    /// The share of the picture that the surface fills.
    Fill,
    /// What is in the middle of the picture.
    Target,
    /// The angle by which the turntable goes on.
    Turntable,
    /// The key with this place in the list, counted from 0.
    Key(usize),
}

impl fmt::Display for ViewElement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ViewElement::Direction => write!(f, "direction"),
            ViewElement::Up => write!(f, "up"),
            ViewElement::FieldOfView => write!(f, "the field of view"),
            ViewElement::Fill => write!(f, "the share of the picture to fill"),
            ViewElement::Target => write!(f, "the target"),
            ViewElement::Turntable => write!(f, "the angle of the turntable"),
            ViewElement::Key(index) => write!(f, "a number of key {}", index + 1),
        }
    }
}

/// Numbers of a look that have a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the names are those of the fields of a look
pub enum LookElement {
    FrontOpacity,
    BackOpacity,
    EdgeOpacity,
    Occlusion,
    GroundShadow,
    Wireframe,
    Gap,
    Roughness,
    Metallic,
    Silhouette,
    Crease,
    Boundary,
    Intersection,
    Rim,
    PinchPoint,
    Pin,
}

impl fmt::Display for LookElement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            LookElement::FrontOpacity => "the opacity of the front",
            LookElement::BackOpacity => "the opacity of the back",
            LookElement::EdgeOpacity => "the opacity seen edge-on",
            LookElement::Occlusion => "the strength of the ambient occlusion",
            LookElement::GroundShadow => "the strength of the shadow on the ground",
            LookElement::Wireframe => "the strength of the wireframe",
            LookElement::Gap => "the gap of the pattern",
            LookElement::Roughness => "the roughness",
            LookElement::Metallic => "the share of metal",
            LookElement::Silhouette => "silhouettes",
            LookElement::Crease => "creases",
            LookElement::Boundary => "the boundary",
            LookElement::Intersection => "self-intersections",
            LookElement::Rim => "rims",
            LookElement::PinchPoint => "pinch points",
            LookElement::Pin => "pins",
        })
    }
}

/// Why a label cannot be filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LabelFault {
    /// A brace has no partner.
    LoneBrace(char),
    /// A place has a name that stands for nothing.
    UnknownName {
        /// The name as given.
        name: String,
        /// The names that stand for something.
        known: Vec<String>,
    },
}

impl fmt::Display for LabelFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LabelFault::LoneBrace(brace) => write!(f, "has a `{brace}` without its partner"),
            LabelFault::UnknownName { name, .. } => write!(f, "asks for `{{{name}}}`"),
        }
    }
}

impl LabelFault {
    fn remedy(&self) -> String {
        match self {
            LabelFault::LoneBrace(brace) => format!("write `{brace}{brace}` for a brace"),
            LabelFault::UnknownName { known, .. } => {
                let known: Vec<String> = known.iter().map(|known| format!("{{{known}}}")).collect();
                format!("there are {}", known.join(", "))
            }
        }
    }
}

/// A vector as it is written in a list.
fn list(vector: DVec3) -> String {
    format!("[{}, {}, {}]", vector.x, vector.y, vector.z)
}
