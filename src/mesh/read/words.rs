//! Lines and numbers of files that are texts.

use glam::DVec3;

use super::problem::Problem;

/// The lines of a text, counted from 1, without comments, blank ones left out.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(k, line)| (k + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// A number as programs write it, also with the exponent of Fortran, as in `1.5D-3`.
pub(super) fn parse_number(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| word.replace(['d', 'D'], "e").parse().ok())
}

/// A finite number.
pub(super) fn number(word: Option<&str>, line: usize, what: &str) -> Result<f64, Problem> {
    let word = word.ok_or_else(|| Problem::at(line, format!("{what} is missing"), "write a number"))?;
    match parse_number(word) {
        Some(x) if x.is_finite() => Ok(x),
        Some(_) => Err(Problem::at(line, format!("{what} `{word}` is not finite"), "every number must be finite")),
        None if parse_number(&word.replace(',', ".")).is_some() => {
            Err(Problem::at(line, format!("{what} `{word}` is not a number"), "write a decimal point, as in 0.25"))
        }
        None => Err(Problem::at(line, format!("{what} `{word}` is not a number"), "write a number such as 0.25")),
    }
}

/// The first three words as a point.
pub(super) fn point<'a>(words: &mut impl Iterator<Item = &'a str>, line: usize) -> Result<DVec3, Problem> {
    Ok(DVec3::new(
        number(words.next(), line, "coordinate x")?,
        number(words.next(), line, "coordinate y")?,
        number(words.next(), line, "coordinate z")?,
    ))
}

/// A count or an index that counts from 0.
pub(super) fn index(word: Option<&str>, line: usize, what: &str) -> Result<u32, Problem> {
    let word = word.ok_or_else(|| Problem::at(line, format!("{what} is missing"), "write a whole number"))?;
    word.parse().map_err(|_| {
        Problem::at(line, format!("{what} `{word}` is not a number from 0 to {}", u32::MAX), "write a whole number")
    })
}
