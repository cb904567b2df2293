//! Detection of fused multiply-add.

use std::cell::Cell;

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x4};

thread_local! {
    /// True if this thread computes without fused multiply-add.
    static IS_SEPARATE: Cell<bool> = const { Cell::new(false) };
}

/// True if this processor uses fused multiply-add (one rounding for a product and a sum).
///
/// Contact forces are bit-identical among all processors that use it, and among all processors that do not.
///
/// ```
/// let fused = dashpot_rail::fuses_multiplication();
/// assert_eq!(fused, dashpot_rail::fuses_multiplication());
/// # #[cfg(target_arch = "x86_64")]
/// assert_eq!(fused, std::is_x86_feature_detected!("fma") && std::is_x86_feature_detected!("avx2"));
/// ```
pub fn fuses_multiplication() -> bool {
    dispatch!(level(), simd => is_fused(simd))
}

/// Runs `work` on this thread with the arithmetic of a processor without fused multiply-add.
///
/// Returns `None`, without running `work`, if the instruction set always includes fused multiply-add, as on Arm.
/// Objects built by `work` must not be stepped afterwards.
///
/// ```
/// let fused = dashpot_rail::without_fused_multiplication(dashpot_rail::fuses_multiplication);
/// assert_ne!(fused, Some(true));
/// # #[cfg(target_arch = "x86_64")]
/// assert_eq!(fused, Some(false));
/// ```
pub fn without_fused_multiplication<R>(work: impl FnOnce() -> R) -> Option<R> {
    /// Restores the arithmetic of the thread when `work` returns or panics.
    struct Restore(bool);
    impl Drop for Restore {
        fn drop(&mut self) {
            IS_SEPARATE.set(self.0);
        }
    }
    let _restore = Restore(IS_SEPARATE.replace(true));
    (!fuses_multiplication()).then(work)
}

/// The instruction set that this thread uses.
pub(crate) fn level() -> Level {
    if IS_SEPARATE.get() {
        Level::baseline()
    } else {
        Level::new()
    }
}

#[inline(always)]
fn is_fused<S: Simd>(simd: S) -> bool {
    // Fused multiply-add leaves a residual of the square that separate rounding loses.
    let factor = f64x4::splat(simd, 1.0 + f64::EPSILON);
    let square = f64x4::splat(simd, -1.0 - 2.0 * f64::EPSILON);
    <[f64; 4]>::from(simd.mul_add_f64x4(factor, factor, square))[0] != 0.0
}
