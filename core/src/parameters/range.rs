//! Ranges and defaults: written once, beside the field; checks, error texts and documentation come from there.

/// Range and default of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Range {
    /// Key in a damper file; it ends with the unit.
    pub key: &'static str,
    /// Least value, in the key's unit.
    pub least: f64,
    /// Greatest value, in the key's unit.
    pub greatest: f64,
    /// The range in words, and what else the value must keep.
    pub allowed: &'static str,
    /// Value where a damper file gives none.
    pub default: Option<f64>,
}

impl Range {
    /// Whether a value lies in the range; false for NaN.
    pub fn contains(&self, value: f64) -> bool {
        (self.least..=self.greatest).contains(&value)
    }
}

/// `None`, or `Some` of what is given.
macro_rules! optional {
    () => {
        None
    };
    ($value:literal) => {
        Some($value as f64)
    };
}
pub(crate) use optional;

/// A range in words: its bounds and its unit, or the words given instead.
macro_rules! allowed {
    ($least:literal $greatest:literal) => {
        concat!($least, " to ", $greatest)
    };
    ($least:literal $greatest:literal $unit:literal) => {
        concat!($least, " to ", $greatest, " ", $unit)
    };
    ($least:literal $greatest:literal => $allowed:literal) => {
        $allowed
    };
}
pub(crate) use allowed;

/// A table of a damper file: each field with its type, its default, and its range with the unit, or with `=>` and
/// words where it depends on other fields.
///
/// Makes the structure, its documentation, its `RANGES`, `check_ranges` by them, and what reads it by serde.
macro_rules! parameters {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident, $ranges:ident {
            $(
                $(#[$field_attribute:meta])*
                $field:ident: $type:ty $(= $default:literal)?,
                $least:literal to $greatest:literal $($unit:literal)? $(=> $allowed:literal)?;
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
        pub struct $name {
            $(
                $(#[$field_attribute])*
                ///
                #[doc = concat!("Allowed: ", allowed!($least $greatest $($unit)? $(=> $allowed)?), ".")]
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
        pub struct $ranges {
            $(
                #[doc = concat!("Of [`", stringify!($name), "::", stringify!($field), "`].")]
                pub $field: $crate::parameters::Range,
            )+
        }

        impl $ranges {
            /// The ranges in order of declaration.
            pub fn all(&self) -> impl Iterator<Item = $crate::parameters::Range> {
                [$(self.$field),+].into_iter()
            }
        }

        #[allow(clippy::unnecessary_cast)] // literals with and without a point
        impl $name {
            /// Range and default of each parameter.
            pub const RANGES: $ranges = $ranges {
                $(
                    $field: $crate::parameters::Range {
                        key: stringify!($field),
                        least: $least as f64,
                        greatest: $greatest as f64,
                        allowed: allowed!($least $greatest $($unit)? $(=> $allowed)?),
                        default: $crate::parameters::range::optional!($($default)?),
                    },
                )+
            };

            /// The first parameter out of its range, as an error that names it in `table`.
            #[cfg(feature = "builder")]
            pub(crate) fn check_ranges(
                &self,
                table: &'static str,
            ) -> Result<(), $crate::error::BuildError> {
                $($crate::error::require_range(table, &Self::RANGES.$field, &self.$field)?;)+
                Ok(())
            }
        }

        #[cfg(feature = "serde")]
        #[allow(clippy::unnecessary_cast)] // literals with and without a point
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                /// What a damper file gives.
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
