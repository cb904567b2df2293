//! Arithmetic the step is allowed to use: + - * / and square root, exact in IEEE 754.

pub(crate) mod approximate;
mod lanes;
mod real;
mod square_root;

#[cfg(feature = "builder")]
pub(crate) mod elementary;

pub(crate) use lanes::Lanes;
pub use real::Real;
