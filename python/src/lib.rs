//! The native half of the Python package `immerse`: a thin binding of the library's front door, in the same words. What
//! Python sees is documented in `immerse/_immerse.pyi` and in the doc comments here, which are its docstrings.

mod arrays;
mod errors;
mod film;
mod frames;
mod immersion;
mod mesh;
mod metric;
mod picture;
mod ricci_flow;
mod scenes;
mod shape;
mod watching;

use pyo3::prelude::*;

/// The native half of `immerse`.
#[pymodule]
fn _immerse(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    errors::add_to(module)?;
    module.add_class::<mesh::Mesh>()?;
    module.add_class::<metric::Metric>()?;
    module.add_class::<immersion::Immersion>()?;
    module.add_class::<shape::ImmersedSurface>()?;
    module.add_class::<shape::Frame>()?;
    module.add_class::<watching::Progress>()?;
    module.add_class::<ricci_flow::RicciFlow>()?;
    module.add_class::<film::Film>()?;
    module.add_class::<frames::Frames>()?;
    module.add_function(wrap_pyfunction!(ricci_flow::ricci_flow, module)?)?;
    module.add_function(wrap_pyfunction!(picture::render, module)?)?;
    Ok(())
}
