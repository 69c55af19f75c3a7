use std::path::PathBuf;

/// Why a picture cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// An index points past the list of positions.
    #[error(
        "{list} {item} uses vertex {vertex}, but there are only {vertices} positions; pass the positions this connectivity belongs to"
    )]
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
    #[error("{list} has {found} values where there must be {wanted}; pass one per triangle or vertex of this surface")]
    Length {
        /// Which list.
        list: String,
        /// How many values it has.
        found: usize,
        /// How many it must have.
        wanted: usize,
    },
    /// The view cannot be built.
    #[error("[camera] {key} = {value} {reason}; {remedy}")]
    Camera {
        /// Key in the scene file.
        key: &'static str,
        /// The value as given.
        value: String,
        /// What is wrong with it.
        reason: &'static str,
        /// What to write instead.
        remedy: &'static str,
    },
    /// The keys of the camera are unusable.
    #[error("[[camera.key]]: {0}")]
    CameraKeys(#[from] crate::timeline::TimelineError),
    /// No frame has a finite position, so there is nothing to point the camera at.
    #[error("none of the positions is finite, so there is nothing to look at; check the simulation that made them")]
    NothingToFrame,
    /// A light is unusable.
    #[error("[[light]] {index}: {key} {reason}; {remedy}")]
    Light {
        /// Place in the list of lights, from 1.
        index: usize,
        /// Key in the scene file.
        key: &'static str,
        /// What is wrong with it.
        reason: &'static str,
        /// What to write instead.
        remedy: &'static str,
    },
    /// A share of the look is out of range.
    #[error("[look] {key} = {value} is not between 0 and 1; write 0 for none, 1 for all")]
    Share {
        /// Key in the scene file.
        key: &'static str,
        /// The value as given.
        value: f64,
    },
    /// The picture of a sphere cannot be read.
    #[error("[look] matcap: {} cannot be read ({reason}); give a PNG of a lit sphere that fills the picture", path.display())]
    Matcap {
        /// The file.
        path: PathBuf,
        /// What the system or the decoder said.
        reason: String,
    },
    /// A label cannot be filled in.
    #[error("[[look.text]] text = {text:?} {reason}; {remedy}")]
    Label {
        /// The label as given.
        text: String,
        /// What is wrong with it.
        reason: String,
        /// What to write instead.
        remedy: String,
    },
    /// The picture has no pixels or too many.
    #[error("[output] size = [{width}, {height}] is not possible; each side is at least 1 and at most {limit} pixels")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// The most a side may have.
        limit: usize,
    },
    /// The part that is wanted is none of the picture.
    #[error(
        "crop {window:?} (x, y, width, height) does not lie in the picture of {width} x {height} pixels; write a part of it"
    )]
    Crop {
        /// The part.
        window: [usize; 4],
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// There is no pattern of so many samples.
    #[error("[output] samples = {0} is not available; write 1, 4, 8 or 16")]
    Samples(usize),
    /// There are more triangles or lines than ids in the visibility buffer.
    #[error("{0} primitives are too many for one picture; it takes up to 2147483646 triangles and as many lines")]
    TooManyPrimitives(usize),
    /// A picture could not be written.
    #[error("cannot write {path}: {reason}; check that the folder exists, is writable and has space left")]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        reason: String,
    },
}
