//! Conversion of Python names, paths and overrides to the text form of the files.

use std::path::PathBuf;

use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyMapping, PyString};

use crate::error::{Outcome, refuse};

/// Converts a name or a path-like object to text.
pub fn path(name: &Bound<'_, PyAny>) -> Outcome<String> {
    match path_of_file(name)?.into_os_string().into_string() {
        Ok(path) => Ok(path),
        Err(path) => refuse(format!(
            "{}: allowed: a name or a path in UTF-8",
            path.display()
        )),
    }
}

/// Converts a path-like object, which may contain any bytes that the system allows.
pub fn path_of_file(path: &Bound<'_, PyAny>) -> Outcome<PathBuf> {
    let os = path.py().import("os")?;
    Ok(os.call_method1("fsdecode", (path,))?.extract()?)
}

/// Converts a mapping of keys and values to `table.key=value`; empty by default.
pub fn assignments(overrides: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<String>> {
    let Some(overrides) = overrides.filter(|overrides| !overrides.is_none()) else {
        return Ok(Vec::new());
    };
    let Ok(overrides) = overrides.cast::<PyMapping>() else {
        return refuse(format!(
            "overrides: {}, allowed: a dictionary such as {{\"mount.clearance_m\": 1e-3}}",
            overrides.get_type().name()?
        ));
    };
    let one = |item: Bound<'_, PyAny>| {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        Ok(format!("{}={}", key.str()?, written(&key, &value)?))
    };
    overrides.items()?.iter().map(one).collect()
}

/// Writes a value as TOML.
pub fn written(key: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>) -> Outcome<String> {
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(value.is_true().to_string());
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(quoted(&text.to_cow()?));
    }
    // Numbers of numpy are usually not Python floats, but they convert to them.
    let is_number = value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>();
    if is_number || value.hasattr("__float__")? {
        let number = match value.extract::<f64>() {
            Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => {
                return refuse(format!(
                    "override {key}: a number beyond the range of float64, allowed: finite numbers"
                ));
            }
            number => number?,
        };
        return Ok(match number.is_nan() {
            true => "nan".into(),
            false => format!("{number:?}"),
        });
    }
    refuse(format!(
        "override {key}: {}, allowed: a number, a string or a bool",
        value.get_type().name()?
    ))
}

/// Quotes a text in the syntax that TOML and JSON share.
pub fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
