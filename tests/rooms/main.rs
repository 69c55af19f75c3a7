//! Tests of the library, in folders that mirror `src`.
#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::unreachable,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "tests fail by panicking, and their closed forms need no certain bits"
)]

mod algebra;
mod architecture;
mod evolve;
mod film;
mod frames;
mod homotopy;
mod immersion;
mod mesh;
mod metric;
mod polish;
mod render;
mod scene;
mod spin;
mod timeline;

#[path = "../support/mod.rs"]
mod support;
