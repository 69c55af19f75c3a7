//! What can be wrong with a requested class.

use crate::advice::Advice;

/// Why a spin structure cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SpinError {
    #[error("{text:?} is no class, which has one digit 0 or 1 per generator; {}", self.remedy())]
    NoDigits { text: String },
    #[error("the class has {given} digits, but the surface has {generators} generators; {}", self.remedy())]
    ClassLength { given: usize, generators: usize },
    #[error("there are no vertex positions to read the class from; {}", self.remedy())]
    NoPositions,
    #[error("the given positions are no almost immersion: {pinch_points} vertex stars are figure-8; {}", self.remedy())]
    NotAnImmersion { pinch_points: usize },
    #[error("there are {given} transports for the {edges} edges of the mesh; {}", self.remedy())]
    TransportCount { given: usize, edges: usize },
    #[error("the transport of edge {edge} is not a unit complex number; {}", self.remedy())]
    NotUnit { edge: usize },
}

impl Advice for SpinError {
    fn remedy(&self) -> String {
        match self {
            SpinError::NoDigits { .. } => "write for example \"01\"".into(),
            SpinError::ClassLength { generators, .. } => {
                let only =
                    if *generators == 0 { " (a sphere or a disk has one class only: leave `class` out)" } else { "" };
                format!("write one digit 0 or 1 for each, shortest generator first{only}")
            }
            SpinError::NoPositions => "use a mesh that has them, or write the digits of the class".into(),
            SpinError::NotAnImmersion { .. } => "write the digits of the class".into(),
            SpinError::TransportCount { .. } | SpinError::NotUnit { .. } => {
                "take the transports of a spin structure on this mesh".into()
            }
        }
    }
}
