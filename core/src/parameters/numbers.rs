//! The numbers of a field, for checking its range.

use super::Shims;

/// A field of a damper file's table.
pub(crate) trait Numbers {
    /// Returns every number of the field.
    fn numbers(&self) -> &[f64];
}

impl Numbers for f64 {
    fn numbers(&self) -> &[f64] {
        core::slice::from_ref(self)
    }
}

impl Numbers for Option<f64> {
    fn numbers(&self) -> &[f64] {
        self.as_slice()
    }
}

impl Numbers for Shims {
    fn numbers(&self) -> &[f64] {
        self
    }
}
