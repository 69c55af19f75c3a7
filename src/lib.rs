//! Shape from metric: give a surface its edge lengths, get its shape; let the metric change, get the film.
//!
//! The modules are listed in the order in which data passes through the program; each imports only
//! modules above it.

pub mod scene;

pub mod algebra;

pub mod mesh;

pub mod metric;
pub mod spin;

pub mod frames;
pub mod immersion;

pub mod evolve;

pub mod cache;
pub mod render;

pub mod cli;
