//! How well the tests determine the parameters.

use serde::Serialize;

/// How well the tests determine a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Determined {
    /// Standard deviation by linear theory, in the unit of the parameter.
    pub standard_deviation: f64,
    /// Variance inflation factor, at least 1, relative to independent samples of equal scatter.
    ///
    /// It is computed from the gradients of whole stretches, because the samples of a stretch are not independent: a
    /// displacement error has an effect only while the force changes fast, but then on all samples.
    pub inflation: f64,
    /// True if a change of the parameter by its tolerance changes the forces by more than the scatter.
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
