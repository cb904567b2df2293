//! Ranges and defaults. Each is written once, next to its field; checks, error texts and documentation come from there.

#[cfg(feature = "builder")]
use super::Numbers;
#[cfg(feature = "builder")]
use crate::error::BuildError;

/// Range and default of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Range {
    /// Key in a damper file. It ends with the unit.
    pub key: &'static str,
    /// Smallest allowed value, in the key's unit.
    pub min: f64,
    /// Largest allowed value, in the key's unit.
    pub max: f64,
    /// The range in words, with any relation to other parameters.
    pub allowed: &'static str,
    /// Value used when a damper file omits the key; `None` if the key is required.
    pub default: Option<f64>,
}

impl Range {
    /// True if the value is in the range. False for NaN.
    pub fn contains(&self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }
}

/// Checks that a value is in its range and keeps its relation to other parameters.
///
/// # Errors
/// The field, if the value is out of range or `keeps_relation` is false.
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
        Err(BuildError::new(section, range.key, value, range.allowed))
    }
}

/// Checks every number of a field against its range.
#[cfg(feature = "builder")]
pub(crate) fn require_range(
    section: &'static str,
    range: &Range,
    field: &impl Numbers,
) -> Result<(), BuildError> {
    let mut numbers = field.numbers().iter();
    numbers.try_for_each(|value| require(section, range, *value, true))
}

/// `Some` with the literal, or `None` if there is none.
macro_rules! optional {
    () => {
        None
    };
    ($value:literal) => {
        Some($value as f64)
    };
}
pub(crate) use optional;

/// A range in words: bounds and unit, or the given text.
macro_rules! allowed {
    ($min:literal $max:literal) => {
        concat!($min, " to ", $max)
    };
    ($min:literal $max:literal $unit:literal) => {
        concat!($min, " to ", $max, " ", $unit)
    };
    ($min:literal $max:literal => $allowed:literal) => {
        $allowed
    };
}
pub(crate) use allowed;

/// Declares one table of a damper file: for each field its type, optional default and range. The range is followed by
/// its unit, or by `=>` and a text if it depends on other fields.
///
/// Generates the struct with its documentation, a setter for each field with a default, `RANGES`, `check_ranges` and
/// `serde::Deserialize`.
macro_rules! parameters {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident, $ranges:ident {
            $(
                $(#[$field_attribute:meta])*
                $field:ident: $type:ty $(= $default:literal)?,
                $min:literal to $max:literal $($unit:literal)? $(=> $allowed:literal)?;
            )+
        }
        $(tables {
            $(
                $(#[$table_attribute:meta])*
                $table:ident: $table_type:ty;
            )+
        })?
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        #[non_exhaustive]
        pub struct $name {
            $(
                $(#[$field_attribute])*
                ///
                #[doc = concat!("Allowed: ", allowed!($min $max $($unit)? $(=> $allowed)?), ".")]
                $(#[doc = concat!("Default: ", $default, ".")])?
                pub $field: $type,
            )+
            $($(
                $(#[$table_attribute])*
                pub $table: $table_type,
            )+)?
        }

        #[doc = concat!("Range and default of each parameter of [`", stringify!($name), "`].")]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub struct $ranges {
            $(
                #[doc = concat!("Range of `", stringify!($name), "::", stringify!($field), "`.")]
                pub $field: $crate::parameters::Range,
            )+
        }

        impl $ranges {
            /// Iterates over the ranges in order of declaration.
            pub fn all(&self) -> impl Iterator<Item = $crate::parameters::Range> {
                [$(self.$field),+].into_iter()
            }
        }

        #[allow(clippy::unnecessary_cast)] // literals with and without a decimal point
        impl $name {
            /// Range and default of each parameter.
            pub const RANGES: $ranges = $ranges {
                $(
                    $field: $crate::parameters::Range {
                        key: stringify!($field),
                        min: $min as f64,
                        max: $max as f64,
                        allowed: allowed!($min $max $($unit)? $(=> $allowed)?),
                        default: $crate::parameters::range::optional!($($default)?),
                    },
                )+
            };

            $($(
                #[doc = concat!("Sets `", stringify!($field), "`; the default is ", $default, ".")]
                #[must_use]
                pub const fn $field(mut self, $field: $type) -> Self {
                    self.$field = $field;
                    self
                }
            )?)+

            /// Checks every parameter against its range.
            ///
            /// # Errors
            /// The first parameter that is out of range, as a field of `table`.
            #[cfg(feature = "builder")]
            pub(crate) fn check_ranges(
                &self,
                table: &'static str,
            ) -> Result<(), $crate::error::BuildError> {
                $($crate::parameters::range::require_range(table, &Self::RANGES.$field, &self.$field)?;)+
                Ok(())
            }
        }

        #[cfg(feature = "serde")]
        #[allow(clippy::unnecessary_cast)] // literals with and without a decimal point
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                /// The keys of a damper file.
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct $name {
                    $($field: Option<$type>,)+
                    $($($table: Option<$table_type>,)+)?
                }
                use $crate::parameters::{range::optional, written::written};
                let file = $name::deserialize(deserializer)?;
                Ok(Self {
                    $($field: written(file.$field, optional!($($default)?), stringify!($field))?,)+
                    $($($table: written(file.$table, None, stringify!($table))?,)+)?
                })
            }
        }
    };
}
pub(crate) use parameters;
