//! Names of a list as arguments.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Takes the names of a list, as scene files have them.
pub(super) fn one_of<T: Copy + Send + Sync + 'static>(
    all: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    let named = |name: String| all.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
    PossibleValuesParser::new(all.iter().map(|(name, _)| *name))
        .try_map(move |name| named(name).ok_or("there is no such name"))
}
