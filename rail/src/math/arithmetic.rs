//! How this processor multiplies and adds.

use std::cell::Cell;

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x4};

thread_local! {
    /// Whether this thread computes without fused multiplication.
    static IS_SEPARATE: Cell<bool> = const { Cell::new(false) };
}

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
    dispatch!(level(), simd => is_fused(simd))
}

/// Does `work` on this thread with the arithmetic of a processor that rounds products and sums one by one; `None`,
/// and `work` not done, where the code of this processor cannot, as on Arm. What `work` builds must not be stepped
/// after it.
///
/// ```
/// let fused = dashpot_rail::without_fused_multiplication(dashpot_rail::fuses_multiplication);
/// assert_ne!(fused, Some(true));
/// # #[cfg(target_arch = "x86_64")]
/// assert_eq!(fused, Some(false));
/// ```
pub fn without_fused_multiplication<R>(work: impl FnOnce() -> R) -> Option<R> {
    /// Gives the thread its own arithmetic back, whether the work ends or panics.
    struct Back(bool);
    impl Drop for Back {
        fn drop(&mut self) {
            IS_SEPARATE.set(self.0);
        }
    }
    let _back = Back(IS_SEPARATE.replace(true));
    (!fuses_multiplication()).then(work)
}

/// The instructions that this thread computes with.
pub(crate) fn level() -> Level {
    if IS_SEPARATE.get() {
        Level::baseline()
    } else {
        Level::new()
    }
}

#[inline(always)]
fn is_fused<S: Simd>(simd: S) -> bool {
    // Its square has a last digit that only one rounding leaves.
    let factor = f64x4::splat(simd, 1.0 + f64::EPSILON);
    let square = f64x4::splat(simd, -1.0 - 2.0 * f64::EPSILON);
    <[f64; 4]>::from(simd.mul_add_f64x4(factor, factor, square))[0] != 0.0
}
