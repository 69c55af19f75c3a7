//! Regular homotopy classes by their digits.

use std::fmt;
use std::str::FromStr;

use super::SpinError;

/// A regular homotopy class: q on every generator, the shortest first; 1 for a figure-8 strip. Written as digits, as in
/// `"01"`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Class(Vec<bool>);

impl Class {
    /// With these values of q.
    pub fn new(q: Vec<bool>) -> Class {
        Class(q)
    }

    /// The class of all zeros on so many generators.
    pub fn zeros(generators: usize) -> Class {
        Class(vec![false; generators])
    }

    /// The class of this number in binary digits, the last generator being the last digit.
    pub fn of_number(number: usize, generators: usize) -> Class {
        Class((0..generators).map(|k| digit(number, generators - 1 - k)).collect())
    }

    /// q on every generator.
    pub fn digits(&self) -> &[bool] {
        &self.0
    }
}

/// The binary digit of a number at a place, 0 beyond all that it has.
fn digit(number: usize, place: usize) -> bool {
    u32::try_from(place).ok().and_then(|place| number.checked_shr(place)).is_some_and(|rest| rest & 1 == 1)
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&super::class_digits(&self.0))
    }
}

impl FromStr for Class {
    type Err = SpinError;

    fn from_str(text: &str) -> Result<Class, SpinError> {
        let digit = |c| match c {
            '0' => Ok(false),
            '1' => Ok(true),
            _ => Err(SpinError::NoDigits { text: text.to_owned() }),
        };
        text.chars().map(digit).collect::<Result<_, _>>().map(Class)
    }
}
