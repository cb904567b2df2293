//! How this processor multiplies and adds.

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x4};

/// Whether this processor multiplies and adds in one rounding. Contact forces have the same bits on all processors that do, and on
/// all that do not.
///
/// ```
/// let fused = dashpot_rail::fuses_multiplication();
/// assert_eq!(fused, dashpot_rail::fuses_multiplication());
/// # #[cfg(target_arch = "x86_64")]
/// assert_eq!(fused, std::is_x86_feature_detected!("fma") && std::is_x86_feature_detected!("avx2"));
/// ```
pub fn fuses_multiplication() -> bool {
    dispatch!(Level::new(), simd => is_fused(simd))
}

#[inline(always)]
fn is_fused<S: Simd>(simd: S) -> bool {
    // Its square has a last digit that only one rounding leaves.
    let factor = f64x4::splat(simd, 1.0 + f64::EPSILON);
    let square = f64x4::splat(simd, -1.0 - 2.0 * f64::EPSILON);
    <[f64; 4]>::from(simd.mul_add_f64x4(factor, factor, square))[0] != 0.0
}
