//! The checksum of images, and of the C library's saved states.

use crc::{CRC_32_ISO_HDLC, Crc, NoTable};

/// Bit by bit: such bytes are read once, a table would stay in flash.
const CHECK: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);

/// CRC-32 of bytes (ISO-HDLC, that of Ethernet and zip).
///
/// ```
/// // The check value of the catalogue of parametrised CRC algorithms.
/// assert_eq!(dashpot_core::crc_32(b"123456789"), 0xcbf4_3926);
/// ```
#[inline(never)] // one copy in flash
pub fn crc_32(bytes: &[u8]) -> u32 {
    CHECK.checksum(bytes)
}
