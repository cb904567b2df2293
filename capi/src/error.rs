//! Codes that the functions return, and their text.

use core::ffi::{CStr, c_char};

use dashpot_core::{ImageError, SavedStateError};

/// Why a function did nothing; 0 when it did what it says.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DashpotError {
    /// Done.
    None = 0,
    /// A pointer is null.
    NullPointer = 1,
    /// A pointer is not aligned as its type asks.
    Misaligned = 2,
    /// The storage holds no damper: call `dashpot_damper_init` first.
    NoDamper = 3,
    /// A length or count is not what is asked for, or an image is of a library with another table.
    Length = 4,
    /// The bytes do not start as an image or a saved state does.
    Magic = 5,
    /// The bytes say that their numbers are not little-endian.
    ByteOrder = 6,
    /// The bytes are of another version of their format.
    Version = 7,
    /// The bytes are of another scalar than single precision.
    Scalar = 8,
    /// The CRC-32 does not match: the bytes are damaged.
    Checksum = 9,
    /// Constants or a state with values that no build and no step leaves behind.
    Values = 10,
    /// The saved state is of another damper, or of this one before its clearance changed.
    WrongDamper = 11,
    /// A number is not in the range allowed.
    Range = 12,
    /// The storage holds no state: call `dashpot_state_init` or `dashpot_state_restore` first.
    NoState = 13,
    /// Constants or a state were damaged in memory: take your safe output, then make both anew.
    Corrupted = 14,
    /// What the call changes shares memory with something else that it was given.
    Overlap = 15,
    /// The header is of another version than the library, or gives its storage another size.
    Header = 16,
    /// The revision of an image is not that of its constants: no build made them.
    Revision = 17,
    /// The storage holds no model or estimate of health: call `dashpot_health_model_init`, then `dashpot_health_init`.
    NoHealth = 18,
}

/// cbindgen:ignore
impl DashpotError {
    /// Every code, in the order of their numbers.
    pub const ALL: [Self; 19] = [
        Self::None,
        Self::NullPointer,
        Self::Misaligned,
        Self::NoDamper,
        Self::Length,
        Self::Magic,
        Self::ByteOrder,
        Self::Version,
        Self::Scalar,
        Self::Checksum,
        Self::Values,
        Self::WrongDamper,
        Self::Range,
        Self::NoState,
        Self::Corrupted,
        Self::Overlap,
        Self::Header,
        Self::Revision,
        Self::NoHealth,
    ];

    const fn text(self) -> &'static CStr {
        match self {
            Self::None => c"done",
            Self::NullPointer => c"a pointer is null",
            Self::Misaligned => c"a pointer is not aligned as its type asks",
            Self::NoDamper => c"the storage holds no damper: call dashpot_damper_init first",
            Self::Length => c"a length or count is not the one asked for",
            Self::Magic => c"the bytes are not an image or a saved state",
            Self::ByteOrder => c"the bytes are not little-endian",
            Self::Version => c"the bytes are of another version of their format",
            Self::Scalar => c"the bytes are not of single precision",
            Self::Checksum => c"the CRC-32 does not match: the bytes are damaged",
            Self::Values => c"values that no build and no step leaves behind",
            Self::WrongDamper => c"the saved state is of another damper",
            Self::Range => c"a number is not in the range allowed",
            Self::NoState => c"the storage holds no state: call dashpot_state_init first",
            Self::Corrupted => c"constants or a state were damaged in memory",
            Self::Overlap => c"what the call changes overlaps something else it was given",
            Self::Header => c"dashpot.h is of another version than the library",
            Self::Revision => c"the revision of the image is not that of its constants",
            Self::NoHealth => c"the storage holds no model or estimate of health",
        }
    }
}

impl From<ImageError> for DashpotError {
    fn from(error: ImageError) -> Self {
        match error {
            ImageError::Length { .. } => Self::Length,
            ImageError::Magic => Self::Magic,
            ImageError::ByteOrder => Self::ByteOrder,
            ImageError::Version(_) => Self::Version,
            ImageError::Scalar(_) => Self::Scalar,
            ImageError::Checksum => Self::Checksum,
            ImageError::Revision => Self::Revision,
            _ => Self::Values,
        }
    }
}

impl From<SavedStateError> for DashpotError {
    fn from(error: SavedStateError) -> Self {
        match error {
            SavedStateError::Revision { .. } => Self::WrongDamper,
            SavedStateError::Length { .. } => Self::Length,
            SavedStateError::Magic => Self::Magic,
            SavedStateError::Version(_) => Self::Version,
            SavedStateError::Scalar(_) => Self::Scalar,
            SavedStateError::Checksum => Self::Checksum,
            _ => Self::Values,
        }
    }
}

/// Code of what a function's body came to.
impl From<Result<(), DashpotError>> for DashpotError {
    fn from(done: Result<(), DashpotError>) -> Self {
        done.err().unwrap_or(Self::None)
    }
}

/// English text of a code, in static storage; of any other number too. Never null.
#[unsafe(no_mangle)]
pub extern "C" fn dashpot_error_text(code: i32) -> *const c_char {
    let found = DashpotError::ALL
        .iter()
        .find(|error| **error as i32 == code);
    found
        .map_or(c"no code of this library", |error| error.text())
        .as_ptr()
}
