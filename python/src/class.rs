//! Classes that are written in Python: results with attributes, tables and plots.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};

use crate::error::Outcome;

/// A class of a module of the package, imported once.
pub struct Class {
    module: &'static str,
    name: &'static str,
    class: PyOnceLock<Py<PyType>>,
}

impl Class {
    /// The class `name` of `module`.
    pub const fn new(module: &'static str, name: &'static str) -> Self {
        let class = PyOnceLock::new();
        Self {
            module,
            name,
            class,
        }
    }

    /// Creates an object from arguments by position.
    pub fn make<'py, A>(&self, py: Python<'py>, arguments: A) -> Outcome<Bound<'py, PyAny>>
    where
        A: pyo3::call::PyCallArgs<'py>,
    {
        let class = self.class.import(py, self.module, self.name)?;
        Ok(class.call1(arguments)?)
    }

    /// Creates an object from its attributes.
    pub fn make_of<'py>(&self, attributes: &Bound<'py, PyDict>) -> Outcome<Bound<'py, PyAny>> {
        let class = self.class.import(attributes.py(), self.module, self.name)?;
        Ok(class.call((), Some(attributes))?)
    }
}
