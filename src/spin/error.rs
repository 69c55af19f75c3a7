//! What can be wrong with a requested class.

/// Why a spin structure cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SpinError {
    #[error(
        "the class has {given} digits, but the surface has {generators} generators; write one digit 0 or 1 for each, \
         shortest generator first{}",
        if *generators == 0 { " (a sphere or a disk has one class only: leave `class` out)" } else { "" }
    )]
    ClassLength { given: usize, generators: usize },
    #[error("class = \"immersion\" needs vertex positions; use a mesh that has them, or write the digits of the class")]
    NoPositions,
    #[error(
        "the given positions are no almost immersion: {pinch_points} vertex stars are figure-8; write the digits of the class"
    )]
    NotAnImmersion { pinch_points: usize },
}
