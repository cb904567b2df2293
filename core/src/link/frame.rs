//! Frames on the wire: COBS of message and CRC-32 (ISO-HDLC, little-endian), ended by a zero byte.

use crc::{CRC_32_ISO_HDLC, Crc, Table};
use heapless::Vec;
use postcard::ser_flavors::Flavor;
use serde::Serialize;

/// Bytes of a message with its CRC-32 at most.
pub const MESSAGE_BYTES: usize = 512;
/// Bytes of a frame on the wire at most: one more for every 254, one first, the zero.
pub const FRAME_BYTES: usize = MESSAGE_BYTES + MESSAGE_BYTES / 254 + 2;
const CHECK_BYTES: usize = 4;

static CHECK: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// Why bytes between two zeros are no message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// A zero came where COBS has none.
    Framing,
    /// Longer than [`MESSAGE_BYTES`].
    TooLong,
    /// The CRC-32 is missing or not that of the message.
    Check,
}

/// What a whole frame holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message<'a> {
    /// The message in postcard.
    pub bytes: &'a [u8],
    /// Its CRC-32, which tells a repeated request from another one of the same number.
    pub check: u32,
}

/// A frame to send.
///
/// ```
/// use dashpot_core::link::Frame;
///
/// let mut frame = Frame::new();
/// assert!(frame.write(&(7_u8, 0_u8)));
/// // COBS: 7, then a zero two bytes on; the CRC-32 of 07 00 is 0x0e988438; the end.
/// assert_eq!(frame.bytes(), [2, 7, 5, 0x38, 0x84, 0x98, 0x0e, 0]);
/// ```
#[derive(Clone, Debug)]
pub struct Frame {
    plain: Vec<u8, MESSAGE_BYTES>,
    encoded: [u8; FRAME_BYTES],
    length: usize,
}

impl Default for Frame {
    fn default() -> Self {
        Self::new()
    }
}

impl Frame {
    /// An empty one.
    pub const fn new() -> Self {
        Self {
            plain: Vec::new(),
            encoded: [0; FRAME_BYTES],
            length: 0,
        }
    }

    /// Becomes the frame of `message`; false, and empty, when it is longer than [`MESSAGE_BYTES`].
    pub fn write(&mut self, message: &impl Serialize) -> bool {
        self.plain.clear();
        self.length = 0;
        if postcard::serialize_with_flavor(message, Plain(&mut self.plain)).is_err() {
            return false;
        }
        let check = CHECK.checksum(&self.plain).to_le_bytes();
        if self.plain.extend_from_slice(&check).is_err() {
            return false;
        }
        let Ok(encoded) = cobs::try_encode(&self.plain, &mut self.encoded) else {
            return false;
        };
        let Some(end) = self.encoded.get_mut(encoded) else {
            return false;
        };
        *end = 0;
        self.length = encoded + 1;
        true
    }

    /// The bytes to send, the zero at the end included.
    pub fn bytes(&self) -> &[u8] {
        self.encoded.get(..self.length).unwrap_or_default()
    }
}

/// Where postcard writes: a vector that need not be cleared first, a byte at a time, for most numbers
/// are short.
struct Plain<'a>(&'a mut Vec<u8, MESSAGE_BYTES>);

impl Flavor for Plain<'_> {
    type Output = ();

    #[inline(always)]
    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0
            .push(byte)
            .map_err(|_| postcard::Error::SerializeBufferFull)
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

/// Takes frames out of a stream of bytes. Whatever the bytes, the next zero ends the trouble.
///
/// ```
/// use dashpot_core::link::{Frame, FrameReader};
///
/// let mut frame = Frame::new();
/// assert!(frame.write(&(7_u8, 1.5_f32)));
/// let mut reader = FrameReader::new();
/// let mut messages = 0;
/// for byte in [3, 0].iter().chain(frame.bytes()) { // a broken frame first
///     if let Some(Ok(message)) = reader.push(*byte) {
///         assert_eq!(message.bytes, [7, 0, 0, 0xc0, 0x3f]);
///         messages += 1;
///     }
/// }
/// assert_eq!(messages, 1);
/// ```
#[derive(Clone, Debug)]
pub struct FrameReader {
    bytes: [u8; FRAME_BYTES],
    /// Bytes since the last zero, those that found no room too.
    length: usize,
}

impl Default for FrameReader {
    fn default() -> Self {
        Self::new()
    }
}

impl FrameReader {
    /// At the start of a frame.
    pub const fn new() -> Self {
        Self {
            bytes: [0; FRAME_BYTES],
            length: 0,
        }
    }

    /// Takes a byte; with the last one of a frame returns its message or what is wrong with it. Two
    /// zeros in a row hold nothing.
    #[inline]
    pub fn push(&mut self, byte: u8) -> Option<Result<Message<'_>, FrameError>> {
        if byte == 0 {
            return self.end();
        }
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
        }
        self.length = self.length.saturating_add(1);
        None
    }

    #[inline(never)]
    fn end(&mut self) -> Option<Result<Message<'_>, FrameError>> {
        match core::mem::take(&mut self.length) {
            0 => None,
            length => Some(message(self.bytes.get_mut(..length))),
        }
    }
}

/// The message of a frame's bytes without the zero; of a frame that had no room there are none.
fn message(frame: Option<&mut [u8]>) -> Result<Message<'_>, FrameError> {
    let frame = frame.ok_or(FrameError::TooLong)?;
    let length = cobs::decode_in_place(frame).map_err(|_| FrameError::Framing)?;
    checked(frame.get(..length).unwrap_or_default())
}

/// The message before a right CRC-32.
fn checked(bytes: &[u8]) -> Result<Message<'_>, FrameError> {
    let (bytes, stated) = bytes
        .split_last_chunk::<CHECK_BYTES>()
        .ok_or(FrameError::Check)?;
    let check = CHECK.checksum(bytes);
    if check.to_le_bytes() == *stated {
        Ok(Message { bytes, check })
    } else {
        Err(FrameError::Check)
    }
}
