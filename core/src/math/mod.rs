//! Arithmetic of the step: + - * / only, which IEEE 754 defines exactly.

pub(crate) mod approximate;
#[cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64")),
    path = "single.rs"
)]
pub(crate) mod group;
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
