//! The paper made again: figures and tables of "Shape from Metric" (Chern, Knöppel, Pinkall, Schröder 2018), measured on this
//! machine and written to REPRODUCTION.md with pictures beside it.
//!
//!     cargo run --release --example reproduce
//!     cargo run --release --example reproduce -- --only fig14 --paper-data DIR
#![allow(clippy::print_stderr, reason = "an example talks")]

mod classes;
mod convex;
mod document;
mod history;
mod ideal;
mod measure;
mod peers;
mod pictures;
mod plots;
mod refinement;
mod request;
mod rims;
mod solve;
mod table;
mod table_1;

use std::time::Instant;

use document::{Document, Section};
use request::{Outcome, Request};

/// A part of the reproduction, in the order of the page.
struct Part {
    /// What `--only` calls it.
    name: &'static str,
    title: &'static str,
    /// Whether it takes so long that it is made only if asked for by name, or with `--all`.
    is_long: bool,
    make: fn(&Request) -> Outcome<Section>,
}

const fn part(name: &'static str, title: &'static str, make: fn(&Request) -> Outcome<Section>) -> Part {
    Part { name, title, is_long: false, make }
}

const PARTS: [Part; 19] = [
    part("fig6", "Fig. 6: rims end at pinch points", rims::figure_6),
    part("fig8", "Fig. 8: length error step by step", history::figure_8),
    part("fig9", "Fig. 9: a membrane with decreasing bending", peers::figure_9),
    part("fig10", "Fig. 10: rotations in place of quaternions", peers::figure_10),
    part("fig11", "Fig. 11: from pinched surfaces to immersions", peers::figure_11),
    part("fig2", "Fig. 2: crumpled and smooth", table_1::figure_2),
    part("fig12", "Fig. 12: a deflated ball", table_1::figure_12),
    part("fig13", "Fig. 13: a soda can", table_1::figure_13),
    part("fig14", "Fig. 14: a flat torus in its four classes", table_1::figure_14),
    part("fig15", "Fig. 15: Ricci flow on a torus", table_1::figure_15),
    part("fig16", "Fig. 16: a disk in the hyperbolic plane", table_1::figure_16),
    part("fig17", "Fig. 17: a polyhedron of genus 2", table_1::figure_17),
    part("fig18", "Fig. 18: the double duck", table_1::figure_18),
    part("fig19", "Fig. 19: the double duck from random frames", table_1::figure_19),
    Part { name: "fig20", title: "Fig. 1 and 20: an eversion", is_long: true, make: history::figure_20 },
    part("refinement", "Beyond the paper: finer and finer meshes of known surfaces", refinement::section),
    part("convex", "Beyond the paper: convex metrics and Alexandrov's surface", convex::section),
    part("genus2", "Beyond the paper: the 16 classes of genus 2", classes::genus_2),
    part("genus3", "Beyond the paper: the 64 classes of genus 3", classes::genus_3),
];

fn main() -> Outcome<()> {
    let request = Request::from_command_line();
    let names: Vec<&str> = PARTS.iter().map(|part| part.name).collect();
    request.check_names(&names)?;
    let mut document = Document::open(&request)?;
    for part in &PARTS {
        if !request.wants(part.name, part.is_long) {
            continue;
        }
        eprintln!("{}", part.title);
        let begin = Instant::now();
        let section = (part.make)(&request)?;
        let seconds = begin.elapsed().as_secs_f64();
        eprintln!("  {seconds:.0} s");
        document.put(part.name, part.title, section, seconds);
        // What is there already is kept if a later part fails.
        document.write(&PARTS.map(|part| (part.name, part.title, part.is_long)))?;
    }
    Ok(())
}
