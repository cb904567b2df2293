//! Errors of building a damper. The step itself has none.

use core::fmt;

/// A parameter that cannot be built, with the field's name and what is allowed.
///
/// ```
/// use dashpot_core::BuildError;
/// let error = BuildError {
///     section: "mount",
///     field: "stiffness_n_per_m",
///     value: -1.0,
///     allowed: "above 0",
/// };
/// assert_eq!(error.to_string(), "mount.stiffness_n_per_m = -1 is not allowed: must be above 0");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildError {
    /// Table of the damper file that holds the field.
    pub section: &'static str,
    /// Name of the field as a damper file spells it.
    pub field: &'static str,
    /// The value found there, in the field's unit.
    pub value: f64,
    /// The allowed range, in the field's unit.
    pub allowed: &'static str,
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}.{} = {} is not allowed: must be {}",
            self.section, self.field, self.value, self.allowed
        )
    }
}

impl core::error::Error for BuildError {}

/// `Ok` when `valid`, else the error that names the field. NaN and infinity never pass.
#[cfg(feature = "builder")]
pub(crate) fn require(
    section: &'static str,
    field: &'static str,
    value: f64,
    valid: bool,
    allowed: &'static str,
) -> Result<(), BuildError> {
    if valid && value.is_finite() {
        Ok(())
    } else {
        Err(BuildError {
            section,
            field,
            value,
            allowed,
        })
    }
}

/// Requires fields of one table of the damper file to lie in their ranges, each told in words with its unit.
#[cfg(feature = "builder")]
macro_rules! require_ranges {
    ($section:expr, $of:expr; $($field:ident in $range:expr, $allowed:literal;)+) => {
        [$((stringify!($field), $of.$field, $range, $allowed)),+]
            .into_iter()
            .try_for_each(|(field, value, range, allowed)| {
                $crate::error::require($section, field, value, range.contains(&value), allowed)
            })
    };
}
#[cfg(feature = "builder")]
pub(crate) use require_ranges;
