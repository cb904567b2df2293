//! Python integers of any size and sign; those out of range are refused with the package's messages.

use std::ops::RangeInclusive;

use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;

use crate::error::{Outcome, refuse};

/// A Python integer.
pub enum Whole {
    /// A valid count.
    Count(u64),
    /// An integer that is negative or too large, as Python writes it.
    Beyond(String),
}

impl Whole {
    /// Returns the number if it is in range; errors call the argument `name`.
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
                // Python refuses to print integers of thousands of digits.
                let text = number.str().map(|text| text.to_string());
                Ok(Self::Beyond(text.unwrap_or_else(|_| {
                    "a number with thousands of digits".into()
                })))
            }
            Err(error) => Err(error),
        }
    }
}
