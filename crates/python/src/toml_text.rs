//! Scenes and studies that are said in Python: tables of TOML.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

/// How deep tables may stand in tables.
const DEEPEST: usize = 32;

/// The text in TOML of a dictionary of texts, numbers, truth values, lists and dictionaries.
///
/// Raises TypeError where there is anything else.
#[pyfunction]
pub(crate) fn toml_text(keys: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = table(keys, "", 0)?;
    toml::to_string(&table).map_err(|error| PyTypeError::new_err(error.to_string()))
}

fn table(keys: &Bound<'_, PyDict>, place: &str, depth: usize) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, found) in keys {
        let Ok(key) = key.cast::<PyString>() else {
            return Err(wrong(place, &key, "a text as key"));
        };
        if found.is_none() {
            continue;
        }
        let key = key.to_string();
        let place = if place.is_empty() { key.clone() } else { format!("{place}.{key}") };
        table.insert(key, value(&found, &place, depth + 1)?);
    }
    Ok(table)
}

fn value(found: &Bound<'_, PyAny>, place: &str, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(wrong(place, found, &format!("at most {DEEPEST} levels")));
    }
    if let Ok(truth) = found.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if found.is_instance_of::<PyInt>() {
        return match found.extract::<i64>() {
            Ok(number) => Ok(Value::Integer(number)),
            Err(_) => Err(wrong(place, found, "a whole number of 64 bits")),
        };
    }
    if found.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(found.extract()?));
    }
    if let Ok(text) = found.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if let Ok(keys) = found.cast::<PyDict>() {
        return table(keys, place, depth).map(Value::Table);
    }
    if found.is_instance_of::<PyList>() || found.is_instance_of::<PyTuple>() {
        let elements = found.try_iter()?.enumerate();
        let element = |(i, element): (usize, PyResult<Bound<'_, PyAny>>)| {
            value(&element?, &format!("{place}[{}]", i + 1), depth + 1)
        };
        return elements.map(element).collect::<PyResult<_>>().map(Value::Array);
    }
    // Arrays and numbers of numpy.
    match found.call_method0("tolist") {
        Ok(listed) if !listed.is(found) => value(&listed, place, depth + 1),
        _ => Err(wrong(place, found, "a text, a number, a truth value, a list or a dictionary")),
    }
}

fn wrong(place: &str, found: &Bound<'_, PyAny>, expected: &str) -> PyErr {
    let told = found.repr().map_or_else(|_| String::new(), |text| text.to_string());
    let told: String = told.chars().take(60).collect();
    let place = if place.is_empty() { "the scene" } else { place };
    PyTypeError::new_err(format!("{place}: {told} found, {expected} expected"))
}
