//! What can be wrong with the parameters of a shape.

use crate::advice::Advice;

/// Why a shape cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("shape `{shape}`: {}; {}", fault.reason(self.name()), self.remedy())]
pub struct ShapeError {
    /// The name of the shape, such as `uv_sphere`.
    pub shape: &'static str,
    /// The parameter that is at fault, such as `radius`. In the tree of solids of an implicit shape it has a path, such
    /// as `parts[1].group[0].sphere.radius`.
    pub parameter: String,
    /// What is wrong with it.
    pub fault: ShapeFault,
}

/// What is wrong with a parameter of a shape.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum ShapeFault {
    /// A number that has to be finite and positive is not.
    NotPositive(f64),
    /// A number that has to be finite and negative is not.
    NotNegative(f64),
    /// One of several numbers is not finite.
    NotFinite(f64),
    /// A width is negative or not finite.
    NotAWidth(f64),
    /// A count is too small.
    TooFew { count: usize, least: usize },
    /// A count is odd, so that shifted rows do not close up.
    Odd { count: usize, remedy: &'static str },
    /// A number is not below that of another parameter.
    NotBelow { value: f64, other: &'static str, bound: f64, remedy: &'static str },
    /// The shape would have too many faces.
    TooManyFaces { faces: f64, limit: usize, remedy: &'static str },
    /// The lattice vectors of a torus span no parallelogram.
    Parallel,
    /// A direction is the zero vector.
    NoDirection,
    /// A group of solids is empty.
    EmptyGroup,
    /// There is no polyhedron of this name.
    UnknownName { name: String, known: Vec<&'static str> },
    /// A polygon has fewer than three corners.
    TooFewCorners { polygon: usize, corners: usize },
    /// A polygon names a vertex that does not exist.
    UnknownCorner { polygon: usize, vertex: usize, vertices: usize },
    /// The outline of a polygon meets itself.
    CrossesItself { polygon: usize },
    /// The grid around a solid would have too many cells.
    TooManyCells { edge_length: f64, cells: f64, limit: f64 },
    /// So many solids would have to be evaluated at too many places.
    TooManySolids { edge_length: f64, solids: usize, evaluations: f64, limit: f64 },
    /// Nothing of a solid is seen by the grid.
    NoSurface { edge_length: f64 },
    /// A radius, in units of 1/√−curvature, is out of range.
    RadiusOutOfRange(f64),
    /// So few faces would have edges too long for the curvature.
    TooCoarse { faces: usize, edge: f64, least: f64 },
}

impl ShapeError {
    /// The name of the parameter without its path.
    fn name(&self) -> &str {
        self.parameter.rsplit('.').next().unwrap_or(&self.parameter)
    }
}

impl ShapeFault {
    fn reason(&self, name: &str) -> String {
        match self {
            ShapeFault::NotPositive(value) | ShapeFault::NotNegative(value) | ShapeFault::NotAWidth(value) => {
                format!("`{name}` is {value}")
            }
            ShapeFault::NotFinite(value) => format!("`{name}` contains {value}"),
            ShapeFault::TooFew { count, .. } | ShapeFault::Odd { count, .. } => format!("`{name}` is {count}"),
            ShapeFault::NotBelow { value, other, bound, .. } => {
                format!("`{name}` {value} is not below `{other}` {bound}")
            }
            ShapeFault::TooManyFaces { faces, limit, .. } => {
                format!("it would have {faces:.0} faces, {limit} are the limit")
            }
            ShapeFault::Parallel => "`a` and `b` are parallel or zero".to_owned(),
            ShapeFault::NoDirection => format!("`{name}` is zero"),
            ShapeFault::EmptyGroup => "a group has no parts".to_owned(),
            ShapeFault::UnknownName { name, .. } => format!("`{name}` is not known"),
            ShapeFault::TooFewCorners { polygon, corners } => format!("polygon {polygon} has {corners} corners"),
            ShapeFault::UnknownCorner { polygon, vertex, vertices } => {
                format!("polygon {polygon} names vertex {vertex}, and there are only {vertices}")
            }
            ShapeFault::CrossesItself { polygon } => {
                format!("the outline of polygon {polygon} crosses or touches itself")
            }
            ShapeFault::TooManyCells { edge_length, cells, limit } => {
                format!("edges of {edge_length} need a grid of {cells:.3e} cells, {limit:.0e} are the limit")
            }
            ShapeFault::TooManySolids { edge_length, solids, evaluations, limit } => format!(
                "edges of {edge_length} on {solids} solids need {evaluations:.1e} distances, {limit:.0e} are the limit"
            ),
            ShapeFault::NoSurface { edge_length } => format!("no surface was found at edge length {edge_length}"),
            ShapeFault::RadiusOutOfRange(radius) => format!("`{name}` is {radius} times 1/√−curvature"),
            ShapeFault::TooCoarse { faces, edge, .. } => {
                format!("{faces} faces make edges {edge:.2} long in units of the curvature, more than 1")
            }
        }
    }
}

impl Advice for ShapeError {
    fn remedy(&self) -> String {
        let remedy = match &self.fault {
            ShapeFault::NotPositive(_) => "give a finite number above 0",
            ShapeFault::NotNegative(_) => "give a number below 0; the shape `disk` is flat",
            ShapeFault::NotFinite(_) => "give finite numbers",
            ShapeFault::NotAWidth(_) => "give a width of 0 or more",
            ShapeFault::TooFew { least, .. } => return format!("give at least {least}"),
            ShapeFault::Odd { remedy, .. }
            | ShapeFault::NotBelow { remedy, .. }
            | ShapeFault::TooManyFaces { remedy, .. } => remedy,
            ShapeFault::Parallel => "give two independent vectors",
            ShapeFault::NoDirection => "give a direction such as [0, 0, 1]",
            ShapeFault::EmptyGroup => "give at least one solid",
            ShapeFault::UnknownName { known, .. } => {
                return format!("choose {}, or give `vertices` and `polygons`", listed(known));
            }
            ShapeFault::TooFewCorners { .. } => "give it three or more",
            ShapeFault::UnknownCorner { .. } => "vertices count from 0",
            ShapeFault::CrossesItself { .. } => "give it an inside",
            ShapeFault::TooManyCells { .. } => "raise `edge_length` or make the solid smaller",
            ShapeFault::TooManySolids { .. } => "raise `edge_length`, use fewer solids, or blend them less widely",
            ShapeFault::NoSurface { .. } => "lower `edge_length`, or make sure that something is left of the solid",
            ShapeFault::RadiusOutOfRange(_) => "choose a radius from 1e-6 to 20 times that",
            ShapeFault::TooCoarse { least, .. } => return format!("give at least {least} faces or a smaller radius"),
        };
        remedy.to_owned()
    }
}

/// Names, with commas between them and an "or" before the last one.
fn listed(names: &[&str]) -> String {
    match names {
        [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        names => names.concat(),
    }
}
