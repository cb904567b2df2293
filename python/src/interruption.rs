//! The user's Ctrl-C, asked for by work that has released Python's lock.

use std::cell::RefCell;

use pyo3::prelude::*;

/// What Python raised while work was going on.
#[derive(Default)]
pub struct Interruption(RefCell<Option<PyErr>>);

impl Interruption {
    /// Whether the work is no longer wanted: Python's handlers of signals, which act in its main thread only, raised something.
    pub fn is_wanted(&self) -> bool {
        let mut raised = self.0.borrow_mut();
        if raised.is_none() {
            *raised = Python::attach(|py| py.check_signals()).err();
        }
        raised.is_some()
    }

    /// What was raised.
    pub fn raised(self) -> PyResult<()> {
        self.0.into_inner().map_or(Ok(()), Err)
    }
}
