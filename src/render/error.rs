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
    /// `wireframe` is out of range.
    #[error("[look] wireframe = {0} is not between 0 and 1; write 0.3 for fine lines, 0 for none")]
    Wireframe(f64),
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
    /// The part that is asked for is not in the picture.
    #[error(
        "crop = {window:?} (x, y, width, height) is not a part of a picture of {width} x {height} pixels; choose a part that is not empty and lies inside"
    )]
    Crop {
        /// x, y, width and height as given.
        window: [usize; 4],
        /// Pixels across the whole picture.
        width: usize,
        /// Pixels down the whole picture.
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
