//! The page of a sweep.

use std::collections::BTreeSet;
use std::path::Path;

use super::kept::Kept;
use super::results::{Row, key_of, value_of};
use crate::cli::failure::PipelineError;
use crate::cli::process::Session;
use crate::film::{FilmRow, FilmTable, report_films};

/// Writes the page of a sweep in its folder.
pub(super) fn write_page(folder: &Path, kept: &Kept, rows: &[Row], session: &Session) -> Result<(), PipelineError> {
    let settings: Vec<&[String]> = rows.iter().map(|row| row.run.settings.as_slice()).collect();
    let count = settings.first().map_or(0, |first| first.len());
    let varies = |k: &usize| settings.iter().filter_map(|of| of.get(*k)).collect::<BTreeSet<_>>().len() > 1;
    let (varied, common): (Vec<usize>, Vec<usize>) = (0..count).partition(varies);
    let of_first = |k: &usize| settings.first().and_then(|first| first.get(*k)).map_or("", |text| text.as_str());
    let film_row = |row: &Row| FilmRow {
        name: row.run.name.clone(),
        values: varied.iter().filter_map(|&k| row.run.settings.get(k)).map(|text| value_of(text).to_owned()).collect(),
        last: row.last().cloned(),
        checks: row.checks(),
        is_whole: row.is_whole(),
    };
    let table = FilmTable {
        scene: kept.scene.clone(),
        keys: varied.iter().map(|k| key_of(of_first(k)).to_owned()).collect(),
        common: common.iter().map(|k| of_first(k).replacen('=', " = ", 1)).collect(),
        command: kept.command.clone(),
        rows: rows.iter().map(film_row).collect(),
    };
    Ok(report_films(folder, &table, &mut |event| session.log.pictures(event))?)
}
