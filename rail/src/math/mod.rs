//! Numerical tools of this crate.

pub mod elliptic;
pub mod spline;
