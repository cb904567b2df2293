//! Width of the processor's vectors.

use std::cell::Cell;

use dashpot_core::VectorWidth;
use fearless_simd::Level;

thread_local! {
    /// True if this thread uses only the vectors that every processor of this architecture has.
    static IS_BASELINE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `work` on this thread with the vectors that every processor of this architecture has: 128 bits on x86-64.
///
/// Results have the same bits for every width, since no operation is fused and every sum has one order. Tests compare
/// them. Objects built by `work` must not be stepped afterwards.
///
/// ```
/// use dashpot_rail::with_narrowest_vectors;
/// assert_eq!(with_narrowest_vectors(|| 2.0_f64.sqrt()), 2.0_f64.sqrt());
/// ```
pub fn with_narrowest_vectors<R>(work: impl FnOnce() -> R) -> R {
    /// Restores the width of the thread when `work` returns or panics.
    struct Restore(bool);
    impl Drop for Restore {
        fn drop(&mut self) {
            IS_BASELINE.set(self.0);
        }
    }
    let _restore = Restore(IS_BASELINE.replace(true));
    work()
}

/// The vectors with which this thread steps dampers.
pub(crate) fn width() -> VectorWidth {
    if IS_BASELINE.get() {
        VectorWidth::baseline()
    } else {
        VectorWidth::detect()
    }
}

/// The instruction set that this thread uses.
pub(crate) fn level() -> Level {
    if IS_BASELINE.get() {
        Level::baseline()
    } else {
        Level::new()
    }
}
