//! Numerical tools of this crate.

pub(crate) mod dispatch;
pub(crate) mod dual;
pub(crate) mod each;
pub(crate) mod eigenvalues;
pub(crate) mod elliptic;
pub(crate) mod number;
pub(crate) mod spline;
mod vector_width;

pub use vector_width::with_narrowest_vectors;
pub(crate) use vector_width::{level, width};
