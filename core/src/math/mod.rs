//! Arithmetic the step is allowed to use: + - * /, exact in IEEE 754.

pub(crate) mod approximate;
#[cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64")),
    path = "single.rs"
)]
pub(crate) mod group;
mod lanes;
mod real;

#[cfg(feature = "builder")]
pub(crate) mod elementary;

pub(crate) use lanes::Lanes;
pub use real::Real;
