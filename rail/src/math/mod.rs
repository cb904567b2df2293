//! Numerical tools of this crate.

pub(crate) mod dual;
pub(crate) mod each;
pub(crate) mod elliptic;
pub(crate) mod number;
pub(crate) mod spline;
