//! Aligned columns of text.

use crate::text::four_digits;
use std::io::{self, Write};

/// Writes rows, the first of which is the heading, with columns as wide as they need to be. Columns are
/// flush right, but for those of the heading's names in `left`.
pub(in crate::cli) fn write_table(out: &mut impl Write, rows: &[Vec<String>], left: &[&str]) -> io::Result<()> {
    let Some(heading) = rows.first() else { return Ok(()) };
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..heading.len()).map(width).collect();
    for row in rows {
        let mut line = String::new();
        for ((cell, &width), title) in row.iter().zip(&widths).zip(heading) {
            let cell =
                if left.contains(&title.as_str()) { format!("{cell:<width$}") } else { format!("{cell:>width$}") };
            line.push_str(&cell);
            line.push_str("  ");
        }
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

/// A quantity of unknown size in a few characters.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 || (1e-3..1e6).contains(&x.abs()) { four_digits(x) } else { format!("{x:.2e}") }
}

/// A ratio as a percentage.
pub(in crate::cli) fn percent(x: f64) -> String {
    let percent = 100.0 * x;
    if percent == 0.0 || percent.abs() >= 1e-3 {
        format!("{} %", four_digits(percent))
    } else {
        format!("{percent:.1e} %")
    }
}
