//! Errors of building a damper. The step itself cannot fail.

use core::fmt;

/// An invalid parameter: the name of the field, its value and the allowed range.
///
/// ```
/// use dashpot_core::BuildError;
///
/// let error = BuildError::new("mount", "stiffness_n_per_m", -1.0, "above 0");
/// assert_eq!(error.to_string(), "mount.stiffness_n_per_m = -1 is not allowed: must be above 0");
/// let error = error.bound(0.5);
/// assert!(error.to_string().ends_with("must be above 0; here the bound is 0.5"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[error("{section}.{field} = {value} is not allowed: must be {allowed}{}", Bound(*bound))]
pub struct BuildError {
    /// Table of the damper file that contains the field.
    pub section: &'static str,
    /// Name of the field in a damper file.
    pub field: &'static str,
    /// The invalid value, in the field's unit.
    pub value: f64,
    /// The allowed range, in the field's unit.
    pub allowed: &'static str,
    /// The violated bound, in the field's unit, if other parameters determine it.
    pub bound: Option<f64>,
}

impl BuildError {
    /// Creates the error for a field whose value is outside the allowed range.
    pub const fn new(
        section: &'static str,
        field: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Self {
        Self {
            section,
            field,
            value,
            allowed,
            bound: None,
        }
    }

    /// Sets the bound that other parameters determine.
    #[must_use]
    pub const fn bound(mut self, bound: f64) -> Self {
        self.bound = Some(bound);
        self
    }
}

/// Formats the bound of a [`BuildError`].
struct Bound(Option<f64>);

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .map_or(Ok(()), |bound| write!(f, "; here the bound is {bound}"))
    }
}
