//! Frames on the wire: COBS of message and CRC-32 (ISO-HDLC, little-endian), ended by a zero byte.

use cobs::{DecodeResult, DecoderState};
use crc::{CRC_32_ISO_HDLC, Crc, Table};
use heapless::Vec;
use serde::Serialize;

/// Bytes of a message with its CRC-32 at most.
pub const MESSAGE_BYTES: usize = 512;
/// Bytes of a frame on the wire at most: one more for every 254, one first, the zero.
pub const FRAME_BYTES: usize = MESSAGE_BYTES + MESSAGE_BYTES / 254 + 2;
const CHECK_BYTES: usize = 4;

static CHECK: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISO_HDLC);

/// A frame ready to send.
pub type Frame = Vec<u8, FRAME_BYTES>;

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

/// Writes `message` as a frame; false, and no frame, when it is longer than [`MESSAGE_BYTES`].
pub fn write(message: &impl Serialize, frame: &mut Frame) -> bool {
    frame.clear();
    let mut plain = [0; MESSAGE_BYTES];
    let Ok(written) = postcard::to_slice(message, &mut plain) else {
        return false;
    };
    let length = written.len();
    let check = CHECK.checksum(written).to_le_bytes();
    let Some((place, _)) = plain
        .get_mut(length..)
        .and_then(|rest| rest.split_first_chunk_mut::<CHECK_BYTES>())
    else {
        return false;
    };
    *place = check;
    let plain = plain.get(..length + CHECK_BYTES).unwrap_or_default();
    let _ = frame.resize_default(FRAME_BYTES);
    let encoded = cobs::try_encode(plain, frame).unwrap_or_default();
    frame.truncate(encoded);
    encoded > 0 && frame.push(0).is_ok()
}

/// Takes frames out of a stream of bytes. Whatever the bytes, the next zero ends the trouble.
///
/// ```
/// use dashpot_core::link::{Frame, FrameReader, write_frame};
///
/// let mut frame = Frame::new();
/// assert!(write_frame(&(7_u8, 1.5_f32), &mut frame));
/// let mut reader = FrameReader::new();
/// let mut messages = 0;
/// for byte in [3, 0].iter().chain(&frame) { // a broken frame first
///     if let Some(Ok(message)) = reader.push(*byte) {
///         assert_eq!(message.bytes, [7, 0, 0, 0xc0, 0x3f]);
///         messages += 1;
///     }
/// }
/// assert_eq!(messages, 1);
/// ```
#[derive(Debug)]
pub struct FrameReader {
    decoder: DecoderState,
    message: Vec<u8, MESSAGE_BYTES>,
    too_long: bool,
    ended: bool,
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
            decoder: DecoderState::Idle,
            message: Vec::new(),
            too_long: false,
            ended: false,
        }
    }

    /// Takes a byte; with the last one of a frame returns its message or what is wrong with it. Two
    /// zeros in a row hold nothing.
    #[inline]
    pub fn push(&mut self, byte: u8) -> Option<Result<Message<'_>, FrameError>> {
        if self.ended {
            self.message.clear();
            self.ended = false;
            self.too_long = false;
        }
        match self.decoder.feed(byte) {
            Ok(DecodeResult::NoData) => None,
            Ok(DecodeResult::DataContinue(byte)) => {
                self.too_long |= self.message.push(byte).is_err();
                None
            }
            Ok(DecodeResult::DataComplete) => {
                self.ended = true;
                Some(if self.too_long {
                    Err(FrameError::TooLong)
                } else {
                    checked(&self.message)
                })
            }
            Err(_) => {
                self.ended = true;
                Some(Err(FrameError::Framing))
            }
        }
    }
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
