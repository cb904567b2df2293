//! What C hands in: checked for null, alignment and overlap, then a reference.

use core::slice;

use crate::error::DashpotError;

/// Neither null nor misaligned.
pub(crate) fn check<T>(pointer: *const T) -> Result<(), DashpotError> {
    if pointer.is_null() {
        Err(DashpotError::NullPointer)
    } else if !pointer.is_aligned() {
        Err(DashpotError::Misaligned)
    } else {
        Ok(())
    }
}

/// What the pointer points to, to read.
///
/// # Safety
/// Not null and aligned, it points to a `T` that nothing changes during `'a`.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T) -> Result<&'a T, DashpotError> {
    check(pointer)?;
    // SAFETY: checked, and the caller's promise.
    Ok(unsafe { &*pointer })
}

/// What the pointer points to, to change.
///
/// # Safety
/// Not null and aligned, it points to a `T` that nothing else uses during `'a`.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T) -> Result<&'a mut T, DashpotError> {
    check(pointer)?;
    // SAFETY: checked, and the caller's promise.
    Ok(unsafe { &mut *pointer })
}

/// Bytes to read.
///
/// # Safety
/// Not null, it points to `length` bytes that nothing changes during `'a`.
pub(crate) unsafe fn bytes<'a>(
    pointer: *const u8,
    length: usize,
) -> Result<&'a [u8], DashpotError> {
    check(pointer)?;
    check_count::<u8>(length)?;
    // SAFETY: checked, and the caller's promise.
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// No array of more can exist.
pub(crate) fn check_count<T>(count: usize) -> Result<(), DashpotError> {
    if count <= isize::MAX as usize / size_of::<T>() {
        Ok(())
    } else {
        Err(DashpotError::Length)
    }
}

/// Memory that one call was given.
#[derive(Clone, Copy)]
pub(crate) struct Memory {
    address: usize,
    bytes: usize,
}

impl Memory {
    /// That of one `T`.
    pub(crate) fn of<T>(pointer: *const T) -> Self {
        Self::array(pointer, 1)
    }

    /// That of `count` of them, as [`check_count`] allows.
    pub(crate) fn array<T>(first: *const T, count: usize) -> Self {
        Self {
            address: first.addr(),
            bytes: count * size_of::<T>(),
        }
    }

    /// That of bytes.
    pub(crate) fn of_bytes(bytes: &[u8]) -> Self {
        Self::array(bytes.as_ptr(), bytes.len())
    }

    /// No byte belongs to both.
    pub(crate) fn check_apart(self, other: Self) -> Result<(), DashpotError> {
        // From the last byte of `other` before `self` on: one comparison for both sides.
        let ahead = other.address.wrapping_sub(self.address);
        let place = ahead.wrapping_add(other.bytes).wrapping_sub(1);
        if place < (self.bytes + other.bytes).saturating_sub(1) {
            Err(DashpotError::Overlap)
        } else {
            Ok(())
        }
    }
}
