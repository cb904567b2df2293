//! Arithmetic of the step: + - * / only, which IEEE 754 defines exactly.

pub(crate) mod approximate;
mod lanes;
#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) mod vectors;

#[cfg(feature = "builder")]
pub(crate) mod elementary;
#[cfg(feature = "builder")]
pub(crate) mod root;
#[cfg(feature = "builder")]
pub(crate) mod roots;
#[cfg(feature = "builder")]
pub(crate) mod square_roots;

pub(crate) use lanes::Lanes;
#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) use vectors::Groups;

/// Scalars that fill vectors; this processor has none.
#[cfg(not(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
pub(crate) trait Groups {}
#[cfg(not(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
impl Groups for f32 {}
#[cfg(not(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
impl Groups for f64 {}
