//! The checksum of images, saved states, frames, and constants in memory.

use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// A byte at a time: 1 KiB of flash for a fifth of the instructions.
static CHECK: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// CRC-32 of bytes (ISO-HDLC, that of Ethernet and zip).
///
/// ```
/// // The check value of the catalogue of parametrised CRC algorithms.
/// assert_eq!(dashpot_core::crc_32(b"123456789"), 0xcbf4_3926);
/// ```
pub fn crc_32(bytes: &[u8]) -> u32 {
    continued(0, bytes)
}

/// CRC-32 of the bytes of `crc` and these after them.
#[inline(never)] // one copy in flash
pub(crate) const fn continued(crc: u32, bytes: &[u8]) -> u32 {
    !with(!crc, bytes)
}

/// The register of the algorithm, all ones before the first byte, after these bytes. For a byte at a time.
#[inline(always)]
pub(crate) const fn with(register: u32, bytes: &[u8]) -> u32 {
    // The library takes a register before bits are reversed, and gives it inverted.
    let mut digest = CHECK.digest_with_initial(register.reverse_bits());
    digest.update(bytes);
    !digest.finalize()
}
