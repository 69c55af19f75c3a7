//! Tests of the library, in folders that mirror `src`.

mod algebra;
mod architecture;
mod evolve;
mod film;
mod frames;
mod immersion;
mod mesh;
mod metric;
mod render;
mod scene;
mod spin;
mod timeline;

#[path = "../support/mod.rs"]
mod support;
