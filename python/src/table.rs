//! Tables of reports: columns as arrays and lists.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::Value;

use crate::error::{Outcome, refuse};

/// Converts rows to columns in the order of the names: arrays of numbers, with NaN for missing ones, and lists of
/// everything else.
pub fn columns<'py>(
    py: Python<'py>,
    names: &[&str],
    rows: &[impl Serialize],
) -> Outcome<Bound<'py, PyDict>> {
    let rows: Result<Vec<Value>, _> = rows.iter().map(serde_json::to_value).collect();
    let rows = match rows {
        Ok(rows) => rows,
        Err(error) => return refuse(error),
    };
    let columns = PyDict::new(py);
    for name in names {
        let cells: Vec<&Value> = rows.iter().map(|row| &row[*name]).collect();
        let is_number = |cell: &&Value| cell.is_number() || cell.is_null();
        if cells.iter().all(is_number) {
            let numbers = cells.iter().map(|cell| cell.as_f64().unwrap_or(f64::NAN));
            columns.set_item(name, PyArray1::from_iter(py, numbers))?;
        } else {
            let cells = cells
                .into_iter()
                .map(|cell| crate::json::in_python(py, cell));
            columns.set_item(name, PyList::new(py, cells.collect::<PyResult<Vec<_>>>()?)?)?;
        }
    }
    Ok(columns)
}
