//! Arithmetic of the step: + - * / only, which IEEE 754 defines exactly.

pub(crate) mod approximate;
mod lanes;

#[cfg(feature = "builder")]
pub(crate) mod elementary;
#[cfg(feature = "builder")]
pub(crate) mod root;
#[cfg(feature = "builder")]
pub(crate) mod roots;
#[cfg(feature = "builder")]
pub(crate) mod square_roots;

pub(crate) use lanes::Lanes;
