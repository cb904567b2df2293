//! Names, paths and overrides as Python gives them, in the words of the files.

use std::path::PathBuf;

use dashpot_core::DamperParameters;
use dashpot_files::vehicle::Replacement;
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyDictMethods, PyFloat, PyInt, PyString};

use crate::damper::Damper;
use crate::error::{Outcome, refuse};

/// A name, or a path of any kind, as text.
pub fn path(name: &Bound<'_, PyAny>) -> Outcome<String> {
    match path_of_file(name)?.into_os_string().into_string() {
        Ok(path) => Ok(path),
        Err(path) => refuse(format!(
            "{}: allowed: a name or a path in UTF-8",
            path.display()
        )),
    }
}

/// A path of any kind, of any bytes that the system allows.
pub fn path_of_file(path: &Bound<'_, PyAny>) -> Outcome<PathBuf> {
    let os = path.py().import("os")?;
    Ok(os.call_method1("fsdecode", (path,))?.extract()?)
}

/// A dictionary from keys to values as `table.key=value`; none where there is none.
pub fn assignments(overrides: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<String>> {
    let Some(overrides) = overrides.filter(|overrides| !overrides.is_none()) else {
        return Ok(Vec::new());
    };
    let Ok(overrides) = overrides.cast::<PyDict>() else {
        return refuse(format!(
            "overrides: {}, allowed: a dictionary such as {{\"mount.clearance_m\": 1e-3}}",
            overrides.get_type().name()?
        ));
    };
    let one = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        Ok(format!("{}={}", key.str()?, written(&key, &value)?))
    };
    overrides.iter().map(one).collect()
}

/// A value as TOML writes it.
fn written(key: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>) -> Outcome<String> {
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(value.is_true().to_string());
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(quoted(&text.to_cow()?));
    }
    // Numbers of numpy are no floats, but are read as such.
    let is_number = value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>();
    if is_number || value.hasattr("__float__")? {
        let number = match value.extract::<f64>() {
            Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => {
                return refuse(format!(
                    "override {key}: a number beyond all of float64, allowed: finite numbers"
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
        "override {key}: {}, allowed: a number, a text or a truth value",
        value.get_type().name()?
    ))
}

/// A text in quotes, as TOML and JSON have it alike.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A dictionary from dampers of a vehicle to what replaces them, a name, a path or a `Damper`; none where there is none.
pub fn replacements(given: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<Replacement>> {
    let Some(given) = given else {
        return Ok(Vec::new());
    };
    let Ok(given) = given.cast::<PyDict>() else {
        return refuse(format!(
            "dampers: {}, allowed: a dictionary such as {{\"vertical\": \"in-service\"}}",
            given.get_type().name()?
        ));
    };
    let one = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let dampers = key.str()?.to_string();
        let Ok(made) = value.cast::<Damper>() else {
            return Ok(Replacement::named(dampers, path(&value)?));
        };
        let parameters = DamperParameters::clone(&made.get().parameters);
        Ok(Replacement {
            dampers,
            damper: value.repr()?.to_string(),
            parameters: Some(Box::new(parameters)),
        })
    };
    given.iter().map(one).collect()
}
