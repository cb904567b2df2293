//! Data for Python's `pickle`: a function and its arguments.

use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

use crate::error::Outcome;

/// A function and its arguments.
pub type Pickled<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);

/// Returns `make` with the tuple of `arguments`.
pub fn pickled<'py>(
    make: Bound<'py, PyAny>,
    arguments: impl IntoPyObject<'py>,
) -> Outcome<Pickled<'py>> {
    let arguments = arguments.into_bound_py_any(make.py())?;
    Ok((make, arguments))
}
