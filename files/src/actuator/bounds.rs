//! Allowed values of an actuator file.

use std::fmt;

/// A value with its allowed range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// Table of the file.
    pub table: &'static str,
    /// Key in the table, with the unit.
    pub key: &'static str,
    /// The value.
    pub value: f64,
    /// Least allowed value.
    pub least: f64,
    /// Greatest allowed value.
    pub greatest: f64,
}

impl Bound {
    /// True if the value is allowed.
    pub fn is_kept(&self) -> bool {
        self.value >= self.least && self.value <= self.greatest
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}.{}: {}, allowed: {} to {}",
            self.table, self.key, self.value, self.least, self.greatest
        )
    }
}

/// Bounds of the keys of one table.
pub(super) fn of_table<const N: usize>(
    table: &'static str,
    keys: [(&'static str, f64, f64, f64); N],
) -> Vec<Bound> {
    let bound = |(key, value, least, greatest)| Bound {
        table,
        key,
        value,
        least,
        greatest,
    };
    keys.map(bound).into()
}
