//! Numerical tools of this crate.

mod arithmetic;
pub(crate) mod dual;
pub(crate) mod each;
pub(crate) mod eigenvalues;
pub(crate) mod elliptic;
pub(crate) mod number;
pub(crate) mod spline;

pub(crate) use arithmetic::level;
pub use arithmetic::{fuses_multiplication, without_fused_multiplication};
