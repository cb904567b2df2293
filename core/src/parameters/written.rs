//! The value of a key in a damper file, as written or by default.

use serde::de::Error;

use super::{OilColumn, Shims};

/// A field of a damper file's table.
pub(crate) trait Written: Sized {
    /// Value if the key is omitted and has no default; `None` if the key is required.
    fn absent() -> Option<Self>;
}

impl Written for f64 {
    fn absent() -> Option<Self> {
        None
    }
}

impl Written for Option<f64> {
    fn absent() -> Option<Self> {
        Some(None)
    }
}

impl Written for Option<OilColumn> {
    fn absent() -> Option<Self> {
        Some(None)
    }
}

impl Written for Shims {
    fn absent() -> Option<Self> {
        Some(Self::EMPTY)
    }
}

/// Returns the value of `key`.
///
/// # Errors
/// A required key is missing.
pub(crate) fn written<T: Written, E: Error>(
    written: Option<T>,
    default: Option<T>,
    key: &'static str,
) -> Result<T, E> {
    written
        .or(default)
        .or_else(T::absent)
        .ok_or_else(|| E::missing_field(key))
}
