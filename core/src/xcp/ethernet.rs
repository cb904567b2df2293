//! Header of a message on UDP and TCP: length of the packet and counter, each 16 bits, little-endian. A datagram or a
//! stream contains several messages one after the other.

/// Bytes of the header.
pub const HEADER_BYTES: usize = 4;

/// Returns the header of a packet. `counter` counts the messages of a sender; it wraps around.
///
/// ```
/// use dashpot_core::xcp::ethernet::{header, split};
/// let message = [&header(2, 7)[..], &[0xFF, 0x00]].concat();
/// assert_eq!(message, [2, 0, 7, 0, 0xFF, 0x00]);
/// assert_eq!(split(&message), Some((&[0xFF, 0x00][..], &[][..])));
/// ```
pub fn header(length: u16, counter: u16) -> [u8; HEADER_BYTES] {
    let ([a, b], [c, d]) = (length.to_le_bytes(), counter.to_le_bytes());
    [a, b, c, d]
}

/// Splits the first message off `bytes`: its packet and what follows it. `None` if the message is not complete.
pub fn split(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (header, rest) = bytes.split_first_chunk::<HEADER_BYTES>()?;
    let length = u16::from_le_bytes([header[0], header[1]]);
    rest.split_at_checked(length.into())
}
