//! Converts the library's JSON reports to Python dictionaries and lists with the same names and numbers.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::Value;

use crate::error::{Outcome, refuse};

/// Converts a report to a Python object.
pub fn report<'py>(py: Python<'py>, report: &impl Serialize) -> Outcome<Bound<'py, PyAny>> {
    match serde_json::to_value(report) {
        Ok(value) => Ok(in_python(py, &value)?),
        Err(error) => refuse(error),
    }
}

/// Converts a value to a Python object.
pub fn in_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(truth) => truth.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (_, Some(whole)) => whole.into_pyobject(py)?.into_any(),
            _ => number.as_f64().into_pyobject(py)?.into_any(),
        },
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Array(values) => {
            let values = values.iter().map(|value| in_python(py, value));
            PyList::new(py, values.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Object(values) => {
            let object = PyDict::new(py);
            for (key, value) in values {
                object.set_item(key, in_python(py, value)?)?;
            }
            object.into_any()
        }
    })
}
