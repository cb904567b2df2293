//! Width of the vectors of a bank.

#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
use fearless_simd::Level;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Simd, x86::Avx2};

use super::Bank;
use crate::real::Real;

/// Vector instructions with which a bank is stepped: a token that proves that the processor has them.
///
/// The bits of forces and states are the same for every width. Make the token once and keep it.
///
/// ```
/// # #[cfg(feature = "builder")] {
/// use dashpot_core::parameters::{DamperParameters, Mount};
/// use dashpot_core::{Damper, VectorWidth, step_bank_with};
///
/// # #[cfg(feature = "std")]
/// let width = VectorWidth::detect();
/// # #[cfg(not(feature = "std"))]
/// # let width = VectorWidth::baseline();
/// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
/// let damper: Damper<f32> = parameters.build(1e-3)?;
/// let mut states = [damper.at_rest(0.0); 16];
/// let mut forces = [0.0; 16];
/// step_bank_with(width, &[&damper; 16], &mut states, &[1e-4; 16], &mut forces);
/// assert_eq!(forces[15], damper.step(&mut damper.at_rest(0.0), 1e-4));
/// # }
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct VectorWidth(Width);

#[derive(Clone, Copy, Debug)]
enum Width {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
}

impl VectorWidth {
    /// Vectors that every processor for which the program is compiled has: SSE2 on x86-64, NEON on 64-bit Arm, SIMD128
    /// in WebAssembly if the compiler may use it, AVX2 if it may use that everywhere. On other processors dampers are
    /// stepped one by one.
    #[inline]
    pub fn baseline() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Level::baseline().as_avx2() {
            return Self(Width::Avx2(avx2));
        }
        Self(Width::Baseline)
    }

    /// Finds the widest vectors of this processor.
    #[cfg(feature = "std")]
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Level::new().as_avx2() {
            return Self(Width::Avx2(avx2));
        }
        Self::baseline()
    }

    /// Name of the instruction set: `AVX2`, `SSE2`, `NEON`, `SIMD128` or `none`.
    ///
    /// ```
    /// use dashpot_core::VectorWidth;
    ///
    /// assert!(["AVX2", "SSE2", "NEON", "SIMD128", "none"].contains(&VectorWidth::baseline().name()));
    /// ```
    pub const fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Width::Avx2(_) => "AVX2",
            Width::Baseline if cfg!(target_arch = "x86_64") => "SSE2",
            Width::Baseline if cfg!(target_arch = "aarch64") => "NEON",
            Width::Baseline if cfg!(all(target_arch = "wasm32", target_feature = "simd128")) => {
                "SIMD128"
            }
            Width::Baseline => "none",
        }
    }
}

impl Default for VectorWidth {
    /// [`VectorWidth::baseline`].
    fn default() -> Self {
        Self::baseline()
    }
}

impl VectorWidth {
    /// Steps the dampers in whole groups; returns the other dampers.
    #[inline(always)]
    pub(super) fn step<T: Real>(self, bank: Bank<'_, T>) -> Bank<'_, T> {
        match self.0 {
            #[cfg(not(any(
                target_arch = "x86_64",
                target_arch = "aarch64",
                all(target_arch = "wasm32", target_feature = "simd128")
            )))]
            Width::Baseline => bank,
            #[cfg(any(
                target_arch = "x86_64",
                target_arch = "aarch64",
                all(target_arch = "wasm32", target_feature = "simd128")
            ))]
            Width::Baseline => T::in_groups(baseline(), bank),
            #[cfg(target_arch = "x86_64")]
            Width::Avx2(avx2) => wide(avx2, bank),
        }
    }
}

/// A separate function, which enables the instructions.
#[cfg(target_arch = "x86_64")]
#[inline(never)]
fn wide<T: Real>(avx2: Avx2, bank: Bank<'_, T>) -> Bank<'_, T> {
    avx2.vectorize(
        #[inline(always)]
        || T::in_groups(avx2, bank),
    )
}

/// Returns the token of the baseline; the compiler removes the check for its instructions.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn baseline() -> fearless_simd::x86::Sse2 {
    Level::baseline()
        .as_sse2()
        .expect("the baseline of the processor")
}

/// Returns the token of the baseline; the compiler removes the check for its instructions.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
fn baseline() -> fearless_simd::aarch64::Neon {
    Level::baseline()
        .as_neon()
        .expect("the baseline of the processor")
}

/// Returns the token of the baseline, with which the module is compiled.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
fn baseline() -> fearless_simd::wasm32::WasmSimd128 {
    Level::baseline()
        .as_wasm_simd128()
        .expect("the baseline of the module")
}
