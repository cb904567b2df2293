//! Whole numbers as Python gives them: of any size and sign, and refused in the package's words.

use std::ops::RangeInclusive;

use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;

use crate::error::{Outcome, refuse};

/// A whole number of Python.
pub enum Whole {
    /// One that counts something.
    Count(u64),
    /// One below zero or too large, as Python writes it.
    Beyond(String),
}

impl Whole {
    /// The number, called `name` in errors, where it is allowed.
    pub fn within(self, name: &str, allowed: RangeInclusive<u64>) -> Outcome<u64> {
        match self {
            Self::Count(count) if allowed.contains(&count) => Ok(count),
            other => refuse(format!(
                "{name}: {other}, allowed: {} to {}",
                allowed.start(),
                allowed.end()
            )),
        }
    }
}

impl std::fmt::Display for Whole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count}"),
            Self::Beyond(text) => write!(f, "{text}"),
        }
    }
}

impl<'py> FromPyObject<'_, 'py> for Whole {
    type Error = PyErr;

    fn extract(number: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match number.extract::<u64>() {
            Ok(count) => Ok(Self::Count(count)),
            Err(error) if error.is_instance_of::<PyOverflowError>(number.py()) => {
                // Python refuses to write numbers of thousands of digits.
                let text = number.str().map(|text| text.to_string());
                Ok(Self::Beyond(text.unwrap_or_else(|_| {
                    "a number of thousands of digits".into()
                })))
            }
            Err(error) => Err(error),
        }
    }
}
