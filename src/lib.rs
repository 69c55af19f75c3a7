//! Shape from metric: give a surface its edge lengths, get its shape; let the metric change, get the film.
//!
//! ```
//! use immerse::evolve::{Simulation, Unobserved};
//! use immerse::scene::Scene;
//!
//! let text = "[mesh]\nshape = 'flat_torus'\ncolumns = 24\nrows = 20\n[spin]\nclass = '10'";
//! let scene = Scene::parse(text, "torus", "".as_ref())?;
//! let mut simulation = Simulation::from_scene(&scene)?;
//! let surface = simulation.relax(None, &mut Unobserved)?;
//! assert_eq!(surface.positions.len(), simulation.mesh.vertex_count());
//! assert!(surface.report.l2_length_error < 0.1 && surface.report.spin_class == "10");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! An [`evolve::Observer`] in place of `Unobserved` is told of every step and may stop. Surfaces from memory go in
//! through [`evolve::Simulation::new`], a changed scene through the public fields of [`scene::Scene`].
//!
//! The modules are listed in the order in which data passes through the program; each imports only
//! modules above it.

pub mod advice;
pub mod text;

pub mod mesh;
pub mod scene;

pub mod algebra;
pub mod timeline;

pub mod metric;
pub mod spin;

pub mod frames;
pub mod immersion;

pub mod evolve;

pub mod cache;
pub mod render;

pub mod movie;

pub mod cli;
