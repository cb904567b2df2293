//! A saved state, which a host or a C program stores and later restores for the same damper.
//!
//! | offset | bytes | holds |
//! |---|---|---|
//! | 0 | 4 | `DAST` |
//! | 4 | 2 | version of this format |
//! | 6 | 2 | bytes of a scalar, 4 or 8 |
//! | 8 | 24 or 40 | [`DamperState::to_bytes`](crate::DamperState) |
//! | end - 4 | 4 | CRC-32 (ISO-HDLC) of all bytes before |
//!
//! All numbers are little-endian.

use zerocopy::little_endian::{U16, U32};
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use crate::checksum::crc_32;
use crate::damper::Damper;
use crate::state::DamperState;

const MAGIC: [u8; 4] = *b"DAST";
/// Version of the format. It changes whenever the meaning of the bytes changes.
const VERSION: u16 = 1;
/// Number of bytes of the CRC-32.
const CHECK_BYTES: usize = 4;

/// Errors of a saved state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SavedStateError {
    /// The bytes are truncated or too long.
    #[error("{found} bytes, but a saved state has {expected}")]
    Length {
        /// Number of bytes of a saved state.
        expected: usize,
        /// Number of bytes found.
        found: usize,
    },
    /// The first four bytes are not `DAST`.
    #[error("not a saved state: must start with DAST")]
    Magic,
    /// The bytes have a different format version, given here.
    #[error("format version {0}, must be {VERSION}")]
    Version(u16),
    /// The bytes are for a scalar of another size, which has this many bytes.
    #[error("wrong precision: each number has {0} bytes")]
    Scalar(u16),
    /// The CRC-32 does not match: the bytes are damaged.
    #[error("CRC-32 does not match: the bytes are damaged")]
    Checksum,
    /// Another damper stepped the state last.
    #[error("the state belongs to damper {found:#010x}, but this is damper {expected:#010x}")]
    Revision {
        /// Revision of this damper.
        expected: u32,
        /// Revision in the bytes.
        found: u32,
    },
    /// A number cannot result from a step of this damper.
    #[error("the state has values that no step produces")]
    Values,
}

/// Layout of a saved state. The state itself takes `BYTES` bytes.
#[derive(FromBytes, IntoBytes, Immutable, KnownLayout, Unaligned)]
#[repr(C)]
struct Saved<const BYTES: usize> {
    magic: [u8; 4],
    version: U16,
    scalar_bytes: U16,
    state: [u8; BYTES],
    check: U32,
}

macro_rules! saved_state {
    ($float:ident) => {
        impl DamperState<$float> {
            /// Number of bytes of a saved state.
            pub const SAVED_BYTES: usize = size_of::<Saved<{ Self::BYTES }>>();

            /// Returns this state as bytes with a checksum, for [`Damper::restore`]. The bytes are the same in Rust and
            /// in C.
            pub fn save(&self) -> [u8; Self::SAVED_BYTES] {
                let mut saved = Saved {
                    magic: MAGIC,
                    version: VERSION.into(),
                    scalar_bytes: (size_of::<$float>() as u16).into(),
                    state: self.to_bytes(),
                    check: U32::ZERO,
                };
                saved.check = check(saved.as_bytes()).into();
                zerocopy::transmute!(saved)
            }
        }

        impl Damper<$float> {
            /// Restores the state of [`DamperState::save`] bit for bit.
            ///
            /// # Errors
            /// The bytes are damaged or not a saved state, the state belongs to another damper, or a number cannot
            /// result from a step of this damper.
            ///
            /// ```
            /// # #[cfg(feature = "builder")] {
            /// use dashpot_core::parameters::{DamperParameters, Mount};
            /// use dashpot_core::{Damper, SavedStateError};
            ///
            /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
            #[doc = concat!("let damper: Damper<", stringify!($float), "> = parameters.build(1e-3)?;")]
            /// let mut saved = damper.at_rest(0.25).save();
            /// assert_eq!(damper.restore(&saved).unwrap().displacement_m(), 0.25);
            /// saved[10] ^= 1;
            /// assert_eq!(damper.restore(&saved), Err(SavedStateError::Checksum));
            /// # }
            /// # Ok::<(), dashpot_core::BuildError>(())
            /// ```
            pub fn restore(&self, saved: &[u8]) -> Result<DamperState<$float>, SavedStateError> {
                const STATE_BYTES: usize = DamperState::<$float>::BYTES;
                let length = SavedStateError::Length {
                    expected: DamperState::<$float>::SAVED_BYTES,
                    found: saved.len(),
                };
                let found = Saved::<STATE_BYTES>::ref_from_bytes(saved).map_err(|_| length)?;
                if found.magic != MAGIC {
                    Err(SavedStateError::Magic)
                } else if found.version != VERSION {
                    Err(SavedStateError::Version(found.version.get()))
                } else if usize::from(found.scalar_bytes.get()) != size_of::<$float>() {
                    Err(SavedStateError::Scalar(found.scalar_bytes.get()))
                } else if found.check != check(saved) {
                    Err(SavedStateError::Checksum)
                } else {
                    self.state_from_bytes(&found.state)
                }
            }
        }
    };
}

saved_state!(f32);
saved_state!(f64);

/// CRC-32 of a saved state without the CRC-32 at its end.
fn check(saved: &[u8]) -> u32 {
    let (checked, _) = saved
        .split_at_checked(saved.len().wrapping_sub(CHECK_BYTES))
        .unwrap_or_default();
    crc_32(checked)
}
