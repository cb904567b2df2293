//! How well the tests determine the parameters.

use serde::Serialize;

/// How well the tests determine a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Determined {
    /// Standard deviation by linear theory, in the unit of the parameter.
    pub standard_deviation: f64,
    /// Variance inflation factor, at least 1, relative to independent samples of equal scatter.
    ///
    /// It is computed from the gradients of whole stretches, because displacement errors have an effect only while the
    /// force changes fast, and for all that time.
    pub inflation: f64,
    /// True if the parameter changes a force by more than the scatter.
    #[serde(rename = "is_felt")]
    pub has_effect: bool,
    /// Keys of the parameters that could compensate for this one.
    #[serde(rename = "together_with")]
    pub confounded_with: Vec<String>,
}

/// How well the tests determine all parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Determination {
    /// One entry per parameter.
    #[serde(rename = "numbers")]
    pub parameters: Vec<Determined>,
    /// Correlation matrix, including the priors.
    pub correlation: Vec<Vec<f64>>,
}
