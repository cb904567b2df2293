//! Codes that the functions return, with their texts.

use core::ffi::{CStr, c_char};

use dashpot_core::{ImageError, SavedStateError};

/// Result of a function: 0 on success, else the reason why it did nothing.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DashpotError {
    /// Success.
    None = 0,
    /// A pointer is null.
    NullPointer = 1,
    /// A pointer does not have the alignment of its type.
    Misaligned = 2,
    /// The storage contains no damper: call `dashpot_damper_init` first.
    NoDamper = 3,
    /// A length or count is wrong, or an image is from a library with another table.
    Length = 4,
    /// The bytes do not start like an image or a saved state.
    Magic = 5,
    /// The byte-order mark is not little-endian.
    ByteOrder = 6,
    /// The bytes are in another version of the format.
    Version = 7,
    /// The bytes are not in single precision.
    Scalar = 8,
    /// The CRC-32 does not match: the bytes are damaged.
    Checksum = 9,
    /// A constant or a value in a state is impossible.
    Values = 10,
    /// The saved state belongs to another damper, or to this one before its clearance changed.
    WrongDamper = 11,
    /// A number is outside its allowed range.
    Range = 12,
    /// The storage contains no state: call `dashpot_state_init` or `dashpot_state_restore` first.
    NoState = 13,
    /// Constants or a state were damaged in memory: use your safe output, then initialise both again.
    Corrupted = 14,
    /// An argument that the call changes shares memory with another argument.
    Overlap = 15,
    /// Header and library have different versions or different storage sizes.
    Header = 16,
    /// The revision of an image does not match its constants, so they do not come from the build of a damper.
    Revision = 17,
    /// The storage contains no health model or estimate: call `dashpot_health_model_init`, then `dashpot_health_init`.
    NoHealth = 18,
    /// The storage contains no transfer system or motion filter: call `dashpot_transfer_init` or
    /// `dashpot_motion_filter_init` first.
    NoTransfer = 19,
    /// The command is still coming to rest, so nothing was cleared: try again after `DASHPOT_PHASE_ENDING`.
    Moving = 20,
}

/// cbindgen:ignore
impl DashpotError {
    /// All codes in the order of their numbers.
    pub const ALL: [Self; 21] = [
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
        Self::NoTransfer,
        Self::Moving,
    ];

    const fn text(self) -> &'static CStr {
        match self {
            Self::None => c"success",
            Self::NullPointer => c"a pointer is null",
            Self::Misaligned => c"a pointer is not aligned for its type",
            Self::NoDamper => c"the storage contains no damper: call dashpot_damper_init first",
            Self::Length => c"a length or count is wrong",
            Self::Magic => c"the bytes are not an image or a saved state",
            Self::ByteOrder => c"the bytes are not little-endian",
            Self::Version => c"the bytes are in another version of the format",
            Self::Scalar => c"the bytes are not in single precision",
            Self::Checksum => c"the CRC-32 does not match: the bytes are damaged",
            Self::Values => c"a constant or a value in a state is impossible",
            Self::WrongDamper => c"the saved state belongs to another damper",
            Self::Range => c"a number is outside its allowed range",
            Self::NoState => c"the storage contains no state: call dashpot_state_init first",
            Self::Corrupted => c"constants or a state were damaged in memory",
            Self::Overlap => c"an argument that the call changes overlaps another argument",
            Self::Header => c"dashpot.h and the library have different versions",
            Self::Revision => c"the revision of the image does not match its constants",
            Self::NoHealth => c"the storage contains no health model or estimate",
            Self::NoTransfer => c"the storage contains no transfer system or motion filter",
            Self::Moving => c"the command is still coming to rest, so nothing was cleared",
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

/// Converts the result inside a C function to the code that the function returns.
impl From<Result<(), DashpotError>> for DashpotError {
    fn from(done: Result<(), DashpotError>) -> Self {
        done.err().unwrap_or(Self::None)
    }
}

/// Returns the English text of a code, in static storage. Also accepts unknown numbers. Never null.
#[unsafe(no_mangle)]
pub extern "C" fn dashpot_error_text(code: i32) -> *const c_char {
    let found = DashpotError::ALL
        .iter()
        .find(|error| **error as i32 == code);
    found.map_or(c"unknown code", |error| error.text()).as_ptr()
}
