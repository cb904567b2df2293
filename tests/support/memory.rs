//! Access to dampers and states as bytes, for tests that damage them.

use dashpot_core::{Damper, DamperState};

/// Types for which every bit pattern is valid: arrays of numbers without padding.
pub trait PlainData: Copy {}
impl PlainData for Damper<f32> {}
impl PlainData for Damper<f64> {}
impl PlainData for DamperState<f32> {}
impl PlainData for DamperState<f64> {}

/// The bytes of a value.
pub fn bytes<T: PlainData>(value: &mut T) -> &mut [u8] {
    // SAFETY: plain data; the slice is as long as the value.
    unsafe { std::slice::from_raw_parts_mut(std::ptr::from_mut(value).cast(), size_of::<T>()) }
}
