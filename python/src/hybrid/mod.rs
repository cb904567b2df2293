//! Hybrid tests: the transfer system between a simulated vehicle and an actuator, and its motion filter.

mod any;
mod compensator;
mod motion;
mod system;

pub use motion::MotionFilter;
pub use system::TransferSystem;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

use crate::error::Outcome;

/// A class of `dashpot._hybrid`, imported once.
struct Class {
    name: &'static str,
    class: PyOnceLock<Py<PyType>>,
}

impl Class {
    const fn new(name: &'static str) -> Self {
        let class = PyOnceLock::new();
        Self { name, class }
    }

    /// An object of the class.
    fn make<'py, A>(&self, py: Python<'py>, arguments: A) -> Outcome<Bound<'py, PyAny>>
    where
        A: pyo3::call::PyCallArgs<'py>,
    {
        let class = self.class.import(py, "dashpot._hybrid", self.name)?;
        Ok(class.call1(arguments)?)
    }
}
