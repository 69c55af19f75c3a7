//! NumPy arrays in and out. What comes in is looked at where it lies if its type and order allow, and copied once if not.
//! What goes out is handed over with its memory, and is read-only: nobody else has a copy that could disagree.

use bytemuck::{AnyBitPattern, NoUninit};
use glam::{DQuat, DVec3};
use numpy::ndarray::{Array2, Dimension};
use numpy::{
    Element, IntoPyArray, PyArray, PyArray1, PyArray2, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods,
    PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::errors::refused;

/// An array argument: contiguous, of the type that is asked for.
pub struct Given<'py, T: Element>(PyReadonlyArrayDyn<'py, T>);

impl<T: Element> Given<'_, T> {
    /// Sides.
    pub fn shape(&self) -> &[usize] {
        self.0.shape()
    }

    /// All entries, row by row.
    pub fn entries(&self) -> PyResult<&[T]> {
        Ok(self.0.as_slice()?)
    }
}

/// Rows of so many numbers as values that are laid out alike.
pub fn rows<T: NoUninit, R: AnyBitPattern>(entries: &[T]) -> &[R] {
    bytemuck::cast_slice(entries)
}

/// Numbers as an array of doubles. `what` names the argument in messages.
pub fn doubles<'py>(what: &str, given: &Bound<'py, PyAny>) -> PyResult<Given<'py, f64>> {
    let py = given.py();
    let array = untyped(what, given)?;
    let kind = kind_of(&array)?;
    if !matches!(kind, 'f' | 'i' | 'u') {
        let reason = format!("{what} is an array of type {}", array.dtype());
        return Err(refused(py, reason, "give real numbers, as of type float64"));
    }
    contiguous(&array, "float64")
}

/// Whole numbers from 0 as an array of 32 bits without a sign. `what` names the argument in messages.
pub fn indices<'py>(what: &str, given: &Bound<'py, PyAny>) -> PyResult<Given<'py, u32>> {
    let py = given.py();
    let array = untyped(what, given)?;
    let kind = kind_of(&array)?;
    if !matches!(kind, 'i' | 'u') && array.len() > 0 {
        let reason = format!("{what} is an array of type {}", array.dtype());
        return Err(refused(py, reason, "give whole numbers, as of type int64 or uint32"));
    }
    if kind == 'i' || array.dtype().itemsize() > 4 {
        let wide = contiguous::<i64>(&array, "int64")?;
        let bad = wide.entries()?.iter().find(|&&index| u32::try_from(index).is_err());
        if let Some(index) = bad {
            let reason = format!("{what} has an entry {index}");
            return Err(refused(py, reason, "entries are numbers of vertices, counted from 0"));
        }
    }
    contiguous(&array, "uint32")
}

/// That an array has this shape; `None` stands for any length of a side.
pub fn shaped<T: Element>(py: Python<'_>, what: &str, array: &Given<'_, T>, sides: &[Option<usize>]) -> PyResult<()> {
    let fits = |(found, wanted): (&usize, &Option<usize>)| wanted.is_none_or(|wanted| wanted == *found);
    if array.shape().len() == sides.len() && array.shape().iter().zip(sides).all(fits) {
        return Ok(());
    }
    let wanted: Vec<_> = sides.iter().map(|side| side.map_or("n".to_owned(), |side| side.to_string())).collect();
    let reason = format!("{what} has shape {}", tuple(array.shape()));
    Err(refused(py, reason, format!("give one of shape {}", tuple(&wanted))))
}

/// Numbers one of which is not finite are refused.
pub fn finite(py: Python<'_>, what: &str, entries: &[f64]) -> PyResult<()> {
    match entries.iter().position(|entry| !entry.is_finite()) {
        None => Ok(()),
        Some(place) => {
            let reason = format!("{what} has an entry {}, at place {place} of all", entries[place]);
            Err(refused(py, reason, "every number must be finite"))
        }
    }
}

/// One point per vertex.
pub fn points(py: Python<'_>, what: &str, array: &Given<'_, f64>, vertices: usize) -> PyResult<()> {
    shaped(py, what, array, &[Some(vertices), Some(3)])
}

/// As Python writes a shape.
pub fn tuple(sides: &[impl std::fmt::Display]) -> String {
    let sides: Vec<String> = sides.iter().map(ToString::to_string).collect();
    if let [only] = sides.as_slice() { format!("({only},)") } else { format!("({})", sides.join(", ")) }
}

fn untyped<'py>(what: &str, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = given.py();
    let array = py.import("numpy")?.call_method1("asarray", (given,)).map_err(|error| {
        refused(py, format!("{what} is no array ({error})"), "give a NumPy array, or lists of equal length")
    })?;
    Ok(array.cast_into::<PyUntypedArray>()?)
}

fn kind_of(array: &Bound<'_, PyUntypedArray>) -> PyResult<char> {
    array.dtype().getattr("kind")?.extract()
}

/// The array itself if it is of the type and row by row, else a copy.
fn contiguous<'py, T: Element>(array: &Bound<'py, PyUntypedArray>, dtype: &str) -> PyResult<Given<'py, T>> {
    let py = array.py();
    let options = PyDict::new(py);
    options.set_item("dtype", dtype)?;
    let array = py.import("numpy")?.call_method("ascontiguousarray", (array,), Some(&options))?;
    Ok(Given(array.cast_into::<PyArrayDyn<T>>()?.try_readonly()?))
}

/// Numbers of a kind, handed over with their memory.
pub fn vector<T: Element>(py: Python<'_>, entries: Vec<T>) -> Bound<'_, PyArray1<T>> {
    frozen(entries.into_pyarray(py))
}

/// Points, handed over with their memory: a row of x, y and z each.
pub fn of_points(py: Python<'_>, points: Vec<DVec3>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    table(py, bytemuck::cast_vec::<DVec3, [f64; 3]>(points))
}

/// Quaternions, handed over with their memory: a row of w, x, y and z each.
pub fn of_quaternions(py: Python<'_>, quaternions: Vec<DQuat>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let mut rows = bytemuck::cast_vec::<DQuat, [f64; 4]>(quaternions);
    rows.iter_mut().for_each(|row| row.rotate_right(1));
    table(py, rows)
}

/// Rows, handed over with their memory.
pub fn table<T: Element, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Bound<'_, PyArray2<T>>> {
    let shape = (rows.len(), N);
    let array = Array2::from_shape_vec(shape, rows.into_flattened())
        .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))?;
    Ok(frozen(array.into_pyarray(py)))
}

/// The same array, read-only.
pub fn frozen<T: Element, D: Dimension>(array: Bound<'_, PyArray<T, D>>) -> Bound<'_, PyArray<T, D>> {
    // It is new, so that nobody has borrowed it.
    if let Ok(writable) = array.try_readwrite() {
        writable.make_nonwriteable();
    }
    array
}
