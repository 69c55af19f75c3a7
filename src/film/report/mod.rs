//! A film as one page: `report.html`, which needs nothing else, neither files nor network.
//!
//! `measure` finds out all that the page shows of a frame, `records` keeps that in a temporary file while the ranges of the
//! whole film are not known, and `pack` puts it into streams of small numbers, as few frames and fields of them as a page
//! has room for. `facts` is what is told in words and numbers. `page` puts both into the page, whose markup, style and
//! scripts are files of their own in the folder `page`. `films` is the page of several films.

mod chains;
mod facts;
mod films;
mod findings;
mod look;
mod measure;
mod pack;
mod page;
mod places;
mod records;
mod streams;
mod work;

pub use films::{FilmRow, FilmTable, report_films};
pub use findings::{Finding, Findings};
pub use work::{REPORT, REPORTER, Reported, report};
