//! Class, start, bending and pins.

use super::{FilesSection, NumberSection};
use crate::evolve::Orientation;
use crate::immersion::Noise;
use crate::mesh::{EdgeSelection, Selection};
use crate::timeline::Ease;
use std::path::PathBuf;

/// `[spin]`
#[derive(Clone, Debug, PartialEq, Default)]
pub enum SpinSection {
    /// Left out: as "immersion" where the mesh has positions and no lengths were decreed, else zeros.
    #[default]
    Automatic,
    /// `class = "immersion"`: read off the mesh's positions (Sec. 4.1.2).
    Immersion,
    /// `class = "all"`: every class in turn, one a frame, each relaxed from the start.
    All,
    /// `class = "01"`: one digit of q per generator, shortest generator first.
    Digits(String),
}

/// `[start]`
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StartSection {
    /// Which frames.
    pub from: StartFrom,
    /// Where each vertex of those positions is moved: formulas of x, y, z and the parameters.
    pub formula: Option<[String; 3]>,
    /// What is added to them.
    pub noise: Option<Noise>,
    /// Which of two mirror images random and spectral frames end in.
    pub orientation: Orientation,
}

impl From<StartFrom> for StartSection {
    fn from(from: StartFrom) -> Self {
        StartSection { from, ..StartSection::default() }
    }
}

/// Where frames start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StartFrom {
    /// `random = 7`: independent uniform frames from this seed.
    Random(u64),
    /// `from = "spectral"`: lowest modes of the connection Laplacian.
    Spectral,
    /// `from = "mesh"`: frames of the mesh's positions or, with a formula, of its coordinates.
    Mesh,
    /// `from = "mirror"`: frames of the mirror image of the mesh's positions.
    Mirror,
    /// `halfway = 2`: frames of the halfway model of a sphere eversion, with so many lobes.
    Halfway(usize),
    /// `from = "figure eight"`: frames of the halfway model of a torus eversion.
    FigureEight,
    /// `file = "…"`: frames of another mesh with the same connectivity.
    File(PathBuf),
}

impl Default for StartFrom {
    fn default() -> Self {
        StartFrom::Random(0)
    }
}

/// `[bending]`: target bending angles (Sec. 6.3).
#[derive(Clone, Debug, PartialEq)]
pub struct BendingSection {
    /// The shape whose angles they are; left out, all are 0 where no region says otherwise.
    pub from: Option<BendingFrom>,
    /// What the angles of the shape are multiplied with: 1 that shape, 0 flat, −1 its mirror image.
    pub amount: NumberSection,
    /// `[[bending.region]]`: constant angles.
    pub regions: Vec<BendingRegionSection>,
}

/// Shapes that bending angles are taken from.
#[derive(Clone, Debug, PartialEq)]
pub enum BendingFrom {
    /// `from = "mesh"`: the fold angles of the mesh's file, if it is a FOLD file that has them, else those of its positions.
    Mesh,
    /// `from = "mirror"`: their mirror image.
    Mirror,
    /// `from = "start"`: the positions that frames start from.
    Start,
    /// `file = "…"`: another mesh with the same connectivity, or the fold angles of a FOLD file.
    File(PathBuf),
    /// `files = "pose*.obj"`: several of them, at their times.
    Files(FilesSection),
}

/// `[[bending.region]]`: one angle for several edges.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingRegionSection {
    /// Which edges.
    pub edges: EdgeSelection,
    /// In degrees; positive as on a sphere whose normals point outward.
    pub angle: NumberSection,
}

/// `[[pin]]`: vertices held in place or led along (Sec. 5.4.1).
#[derive(Clone, Debug, PartialEq)]
pub struct PinSection {
    /// Which.
    pub vertices: Selection,
    /// Where they belong at rest, in order of `vertices`; empty means where the mesh's positions are.
    pub positions: Vec<[f64; 3]>,
    /// Where each goes from there: formulas of x, y, z of that place, time and the parameters.
    pub formula: Option<[String; 3]>,
    /// Keyframed rigid motion of all of them, after the formula.
    pub motion: Option<MotionSection>,
}

/// Keyframed rigid motion about the centroid of what moves.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSection {
    /// Increasing.
    pub times: Vec<f64>,
    /// Displacement, one per time.
    pub translations: Vec<[f64; 3]>,
    /// Degrees about x, then y, then z, one per time.
    pub rotations: Vec<[f64; 3]>,
    /// Between the keyframes.
    pub ease: Ease,
}
