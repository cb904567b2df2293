//! Arithmetic the step is allowed to use: + - * / and square root, exact in IEEE 754.

pub(crate) mod approximate;
mod real;
mod square_root;

#[cfg(feature = "builder")]
pub(crate) mod elementary;

pub use real::Real;
