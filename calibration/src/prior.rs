//! Prior knowledge of a parameter.

use serde::Serialize;

/// Prior of a parameter: a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Prior {
    /// Mean, in the unit of the parameter.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
}
