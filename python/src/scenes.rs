//! Scenes from paths, texts and dicts.

use std::path::{Path, PathBuf};

use immerse::Scene;
use immerse::scene::clock_of;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use super::errors::{of_mistake, of_scene, refused};

/// The name of a scene that has no file.
const NAME: &str = "scene";

/// The scene of a path, of a text with line breaks, or of a dict; relative paths in the latter two start at `base`.
pub fn scene_of(given: &Bound<'_, PyAny>, base: PathBuf) -> PyResult<Scene> {
    let py = given.py();
    let scene = if let Ok(dict) = given.cast::<PyDict>() {
        let text = toml::to_string(&table(dict, "")?).map_err(|error| {
            refused(py, format!("the dict is no scene ({error})"), "write what a scene file would say")
        })?;
        Scene::parse(&text, NAME, &base)
    } else if let Ok(text) = given.cast::<PyString>()
        && text.to_cow()?.contains('\n')
    {
        Scene::parse(&text.to_cow()?, NAME, &base)
    } else if let Ok(path) = given.extract::<PathBuf>() {
        py.detach(|| Scene::read(&path))
    } else {
        let reason = format!("the scene is of type {}", given.get_type().name()?);
        return Err(refused(py, reason, "give a path, the text of a scene, or a dict"));
    };
    let mut scene = scene.map_err(|errors| of_scene(py, &errors))?;
    if scene.clock.a_frame_for_each_class {
        let counted = scene.surface().and_then(|surface| clock_of(&scene, &surface.mesh));
        scene.clock = counted.map_err(|mistake| of_mistake(py, &mistake))?;
    }
    Ok(scene)
}

fn table(dict: &Bound<'_, PyDict>, place: &str) -> PyResult<Table> {
    dict.iter()
        .map(|(key, value)| {
            let Ok(name) = key.cast::<PyString>() else {
                let reason = format!("{} has a key {}", called(place), key.repr()?);
                return Err(refused(dict.py(), reason, "keys of a scene are strings"));
            };
            let name = name.to_cow()?.into_owned();
            let place = if place.is_empty() { name.clone() } else { format!("{place}.{name}") };
            Ok((name, value_of(&value, &place)?))
        })
        .collect()
}

fn value_of(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Value> {
    let py = value.py();
    let list = |items: Vec<Bound<'_, PyAny>>| {
        let item = |(k, item): (usize, &Bound<'_, PyAny>)| value_of(item, &format!("{place}[{k}]"));
        items.iter().enumerate().map(item).collect::<PyResult<Vec<_>>>().map(Value::Array)
    };
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(table(dict, place)?));
    }
    if let Ok(truth) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        return match value.extract::<i64>() {
            Ok(number) => Ok(Value::Integer(number)),
            Err(_) => {
                Err(refused(py, format!("{} is {}", called(place), value.repr()?), "give a number of at most 64 bits"))
            }
        };
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_cow()?.into_owned()));
    }
    if let Ok(items) = value.cast::<PyList>() {
        return list(items.iter().collect());
    }
    if let Ok(items) = value.cast::<PyTuple>() {
        return list(items.iter().collect());
    }
    // Arrays and numbers of NumPy.
    if value.hasattr("dtype")? && value.hasattr("tolist")? {
        return value_of(&value.call_method0("tolist")?, place);
    }
    if value.hasattr("__fspath__")? {
        return Ok(Value::String(value.extract::<PathBuf>()?.to_string_lossy().into_owned()));
    }
    let reason = format!("{} is of type {}", called(place), value.get_type().name()?);
    Err(refused(py, reason, "give a number, a text, True or False, a list or a dict; leave out what is to be as usual"))
}

fn called(place: &str) -> String {
    if place.is_empty() { "the dict".to_owned() } else { format!("`{place}`") }
}

/// The path of a folder, absolute, so that it stays the same wherever a program goes.
pub fn absolute(path: &Path) -> PyResult<PathBuf> {
    Ok(std::path::absolute(path)?)
}
