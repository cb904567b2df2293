//! CRC-32 of images, saved states, frames and constants in memory.

use crc::{CRC_32_ISO_HDLC, Crc, Table};

/// CRC-32 algorithm that processes one byte at a time. Its table takes 1 KiB of flash and saves four fifths of the
/// instructions.
static CHECK: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// Returns the CRC-32 of bytes (ISO-HDLC, as in Ethernet and zip).
///
/// ```
/// // Check value from the catalogue of parametrised CRC algorithms.
/// assert_eq!(dashpot_core::crc_32(b"123456789"), 0xcbf4_3926);
/// ```
pub fn crc_32(bytes: &[u8]) -> u32 {
    continued(0, bytes)
}

/// Continues a CRC-32 over further bytes.
#[inline(never)] // one copy in flash
pub(crate) const fn continued(crc: u32, bytes: &[u8]) -> u32 {
    !with(!crc, bytes)
}

/// Updates the register of the algorithm, which starts as all ones. For code that receives one byte at a time.
#[inline(always)]
pub(crate) const fn with(register: u32, bytes: &[u8]) -> u32 {
    // The library takes the register with reversed bits and returns its inverse.
    let mut digest = CHECK.digest_with_initial(register.reverse_bits());
    digest.update(bytes);
    !digest.finalize()
}
