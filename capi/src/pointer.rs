//! Checks pointers from C for null, alignment and overlap, and converts them to references.

use core::slice;

use crate::error::DashpotError;

/// Checks that a pointer is neither null nor misaligned.
pub(crate) fn check<T>(pointer: *const T) -> Result<(), DashpotError> {
    if pointer.is_null() {
        Err(DashpotError::NullPointer)
    } else if !pointer.is_aligned() {
        Err(DashpotError::Misaligned)
    } else {
        Ok(())
    }
}

/// Returns a reference for reading.
///
/// # Safety
/// A pointer that is neither null nor misaligned must point to a `T` that nothing changes during `'a`.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T) -> Result<&'a T, DashpotError> {
    check(pointer)?;
    // SAFETY: the pointer is checked, and the caller keeps the contract.
    Ok(unsafe { &*pointer })
}

/// Returns a reference for writing.
///
/// # Safety
/// A pointer that is neither null nor misaligned must point to a `T` that nothing else uses during `'a`.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T) -> Result<&'a mut T, DashpotError> {
    check(pointer)?;
    // SAFETY: the pointer is checked, and the caller keeps the contract.
    Ok(unsafe { &mut *pointer })
}

/// Returns bytes for reading.
///
/// # Safety
/// A pointer that is not null must point to `length` bytes that nothing changes during `'a`.
pub(crate) unsafe fn bytes<'a>(
    pointer: *const u8,
    length: usize,
) -> Result<&'a [u8], DashpotError> {
    check(pointer)?;
    check_count::<u8>(length)?;
    // SAFETY: the pointer is checked, and the caller keeps the contract.
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// Checks that an array of `count` elements can exist.
pub(crate) fn check_count<T>(count: usize) -> Result<(), DashpotError> {
    if count <= isize::MAX as usize / size_of::<T>() {
        Ok(())
    } else {
        Err(DashpotError::Length)
    }
}

/// Memory that an argument occupies.
#[derive(Clone, Copy)]
pub(crate) struct Memory {
    address: usize,
    bytes: usize,
}

impl Memory {
    /// Memory of one `T` at a pointer.
    pub(crate) fn of<T>(pointer: *const T) -> Self {
        Self::array(pointer, 1)
    }

    /// Memory of `count` elements, which [`check_count`] allows.
    pub(crate) fn array<T>(first: *const T, count: usize) -> Self {
        Self {
            address: first.addr(),
            bytes: count * size_of::<T>(),
        }
    }

    /// Memory of bytes.
    pub(crate) fn of_bytes(bytes: &[u8]) -> Self {
        Self::array(bytes.as_ptr(), bytes.len())
    }

    /// Checks that no byte belongs to both ranges.
    pub(crate) fn check_apart(self, other: Self) -> Result<(), DashpotError> {
        // `last` is the offset of the last byte of `other` from the start of `self`. It wraps, so one comparison is
        // enough for an `other` on either side.
        let ahead = other.address.wrapping_sub(self.address);
        let last = ahead.wrapping_add(other.bytes).wrapping_sub(1);
        if last < (self.bytes + other.bytes).saturating_sub(1) {
            Err(DashpotError::Overlap)
        } else {
            Ok(())
        }
    }
}
