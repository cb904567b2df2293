//! The value of a key of a damper file: what is written, else its default.

use heapless::Vec;
use serde::de::Error;

use super::OilColumn;

/// A field of a table.
pub(crate) trait Written: Sized {
    /// Its value where nothing is written and there is no default; `None` where it must be written.
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

impl<const N: usize> Written for Vec<f64, N> {
    fn absent() -> Option<Self> {
        Some(Self::new())
    }
}

/// The value of `key`.
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
