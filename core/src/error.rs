//! Errors of building a damper and of changing it. The step itself has no errors.

use core::fmt;

use crate::parameters::Mount;
#[cfg(feature = "builder")]
use crate::parameters::{Numbers, Range};

/// A parameter that cannot be built, with the field's name and what is allowed.
///
/// ```
/// use dashpot_core::BuildError;
/// let error = BuildError {
///     section: "mount",
///     field: "stiffness_n_per_m",
///     value: -1.0,
///     allowed: "above 0",
///     bound: None,
/// };
/// assert_eq!(error.to_string(), "mount.stiffness_n_per_m = -1 is not allowed: must be above 0");
/// let error = BuildError { bound: Some(0.5), ..error };
/// assert!(error.to_string().ends_with("must be above 0; here the bound is 0.5"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{section}.{field} = {value} is not allowed: must be {allowed}{}", Bound(*bound))]
pub struct BuildError {
    /// Table of the damper file that holds the field.
    pub section: &'static str,
    /// Name of the field as a damper file spells it.
    pub field: &'static str,
    /// The value found there, in the field's unit.
    pub value: f64,
    /// The allowed range, in the field's unit.
    pub allowed: &'static str,
    /// The bound that other parameters set, in the field's unit; `None` where the allowed range says it all.
    pub bound: Option<f64>,
}

/// The bound of a [`BuildError`] in words.
struct Bound(Option<f64>);

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .map_or(Ok(()), |bound| write!(f, "; here the bound is {bound}"))
    }
}

/// A clearance that is not 0 to 0.1 m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("mount.clearance_m must be {}", Mount::RANGES.clearance_m.allowed)]
pub struct ClearanceError;

/// `Ok` when a value is in its range and keeps its relation to others, else the error that names the field.
#[cfg(feature = "builder")]
pub(crate) fn require(
    section: &'static str,
    range: &Range,
    value: f64,
    keeps_relation: bool,
) -> Result<(), BuildError> {
    if range.contains(value) && keeps_relation {
        Ok(())
    } else {
        Err(BuildError {
            section,
            field: range.key,
            value,
            allowed: range.allowed,
            bound: None,
        })
    }
}

/// As [`require`], of every number of a field.
#[cfg(feature = "builder")]
pub(crate) fn require_range(
    section: &'static str,
    range: &Range,
    field: &impl Numbers,
) -> Result<(), BuildError> {
    let mut numbers = field.numbers().iter();
    numbers.try_for_each(|value| require(section, range, *value, true))
}
