//! The numbers of a field, which its range is checked for.

use heapless::Vec;

/// A field of a table.
pub(crate) trait Numbers {
    /// Its numbers.
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

impl<const N: usize> Numbers for Vec<f64, N> {
    fn numbers(&self) -> &[f64] {
        self
    }
}
