//! Frames on the wire: a message and its CRC-32 (ISO-HDLC, little-endian), encoded with COBS and ended by a zero byte.

use cobs::{DecodeResult, DecoderState};
use heapless::Vec;
use postcard::ser_flavors::Flavor;
use serde::Serialize;

use super::message::{Header, Request};
use crate::checksum;
use crate::damper::Damper;

/// Largest request with header and CRC-32 (bytes): a whole image and its header.
pub const REQUEST_BYTES: usize = Damper::<f32>::IMAGE_BYTES + 32;
/// Largest response with header and CRC-32 (bytes).
pub const RESPONSE_BYTES: usize = 512;
/// Largest frame of a request (bytes). COBS adds one byte for every 254, one at the start and the final zero.
pub const REQUEST_FRAME_BYTES: usize = frame_bytes(REQUEST_BYTES);
/// Largest frame of a response (bytes).
pub const RESPONSE_FRAME_BYTES: usize = frame_bytes(RESPONSE_BYTES);
const CHECK_BYTES: usize = 4;

/// CRC-32 of any bytes followed by their own CRC-32.
const RESIDUE: u32 = 0x2144_df1c;

const fn frame_bytes(message_bytes: usize) -> usize {
    message_bytes + message_bytes / 254 + 2
}

/// Errors of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameError {
    /// The frame has a zero byte inside a COBS block.
    Framing,
    /// The frame is longer than the reader's buffer.
    TooLong,
    /// The CRC-32 is missing or does not match the message.
    Check,
}

/// Message of an intact frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Message<'a> {
    /// The message, encoded with postcard.
    pub bytes: &'a [u8],
    /// CRC-32 of the message, which distinguishes a repeated request from another one with the same sequence number.
    pub check: u32,
}

/// A frame to send, of at most `BYTES` bytes.
///
/// ```
/// use dashpot_core::link::Frame;
///
/// let mut frame = Frame::<16>::new();
/// assert!(frame.write(&(7_u8, 0_u8)));
/// // COBS: 2 and 5 are the distances to the next zero byte. The CRC-32 of 07 00 is 0x0e988438.
/// assert_eq!(frame.bytes(), [2, 7, 5, 0x38, 0x84, 0x98, 0x0e, 0]);
/// ```
#[derive(Clone, Debug)]
pub struct Frame<const BYTES: usize> {
    plain: Vec<u8, BYTES>,
    encoded: [u8; BYTES],
    length: usize,
}

/// A frame large enough for every request.
pub type RequestFrame = Frame<REQUEST_FRAME_BYTES>;
/// A frame large enough for every response.
pub type ResponseFrame = Frame<RESPONSE_FRAME_BYTES>;

impl<const BYTES: usize> Default for Frame<BYTES> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const BYTES: usize> Frame<BYTES> {
    /// An empty frame.
    pub const fn new() -> Self {
        Self {
            plain: Vec::new(),
            encoded: [0; BYTES],
            length: 0,
        }
    }

    /// Encodes `message`. If it does not fit, the frame is empty and the result is false.
    pub fn write(&mut self, message: &impl Serialize) -> bool {
        self.length = self.encode(message).unwrap_or(0);
        self.length > 0
    }

    fn encode(&mut self, message: &impl Serialize) -> Option<usize> {
        self.plain.clear();
        postcard::serialize_with_flavor(message, Plain(&mut self.plain)).ok()?;
        let check = checksum::crc_32(&self.plain).to_le_bytes();
        self.plain.extend_from_slice(&check).ok()?;
        let end = cobs::try_encode(&self.plain, &mut self.encoded).ok()?;
        *self.encoded.get_mut(end)? = 0;
        Some(end + 1)
    }

    /// Bytes to send, including the final zero.
    pub fn bytes(&self) -> &[u8] {
        self.encoded.get(..self.length).unwrap_or_default()
    }
}

/// Encodes a request as a frame. The frame is empty if the request is too long for a device.
///
/// ```
/// use dashpot_core::link::{Header, PROTOCOL, Request, request_frame};
///
/// let header = Header { session: 7, sequence: 1 };
/// let hello = request_frame(header, &Request::Hello { protocol: PROTOCOL });
/// assert_eq!(hello.bytes().len(), 10);
/// ```
pub fn request_frame(header: Header, request: &Request<'_>) -> RequestFrame {
    let mut frame = Frame::new();
    frame.write(&(header, request));
    frame
}

/// Buffer for postcard that need not be initialised.
struct Plain<'a, const BYTES: usize>(&'a mut Vec<u8, BYTES>);

impl<const BYTES: usize> Flavor for Plain<'_, BYTES> {
    type Output = ();

    #[inline(always)]
    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0
            .push(byte)
            .map_err(|_| postcard::Error::SerializeBufferFull)
    }

    #[inline(always)]
    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.0
            .extend_from_slice(bytes)
            .map_err(|_| postcard::Error::SerializeBufferFull)
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

/// Reads frames from a stream of bytes at a constant cost for each byte.
///
/// Resynchronises at the next zero byte, whatever came before.
///
/// ```
/// use dashpot_core::link::{Frame, FrameReader};
///
/// let mut frame = Frame::<32>::new();
/// assert!(frame.write(&(7_u8, 1.5_f32)));
/// let mut reader = FrameReader::<32>::new();
/// let mut messages = 0;
/// for byte in [3, 0].iter().chain(frame.bytes()) { // starts with a corrupt frame
///     if let Some(Ok(message)) = reader.push(*byte) {
///         assert_eq!(message.bytes, [7, 0, 0, 0xc0, 0x3f]);
///         messages += 1;
///     }
/// }
/// assert_eq!(messages, 1);
/// ```
#[derive(Debug)]
#[repr(C)] // the fields used for every byte come first, where one instruction can address them
pub struct FrameReader<const BYTES: usize> {
    /// Number of bytes of the message so far.
    length: usize,
    /// Register of the CRC-32: the inverse of the CRC-32 so far.
    register: u32,
    cobs: DecoderState,
    error: Option<FrameError>,
    message: [u8; BYTES],
}

impl<const BYTES: usize> Default for FrameReader<BYTES> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const BYTES: usize> FrameReader<BYTES> {
    /// A reader at the start of a frame.
    pub const fn new() -> Self {
        Self {
            length: 0,
            register: 0,
            cobs: DecoderState::Idle,
            // All bits of this error are zero. The first byte of a frame replaces it.
            error: Some(FrameError::Framing),
            message: [0; BYTES],
        }
    }

    /// Takes a byte. At the end of a frame, returns its message or its error. Ignores repeated zeros.
    pub fn push(&mut self, byte: u8) -> Option<Result<Message<'_>, FrameError>> {
        self.take(byte).then(|| self.message())
    }

    /// Takes a byte. Returns true at the end of a frame.
    #[inline(always)]
    pub(crate) fn take(&mut self, byte: u8) -> bool {
        let starts = matches!(self.cobs, DecoderState::Idle);
        match self.cobs.feed(byte) {
            Ok(DecodeResult::DataContinue(decoded)) => {
                if let Some(byte) = self.message.get_mut(self.length) {
                    *byte = decoded;
                    self.length += 1;
                } else {
                    self.error = Some(FrameError::TooLong);
                }
                self.register = checksum::with(self.register, &[decoded]);
                false
            }
            Ok(DecodeResult::NoData) => {
                if starts {
                    (self.length, self.register, self.error) = (0, !0, None);
                }
                false
            }
            Ok(DecodeResult::DataComplete) => true,
            Err(_) => {
                self.error = Some(FrameError::Framing);
                true
            }
        }
    }

    /// Returns the message or the error of the last frame.
    pub(crate) fn message(&self) -> Result<Message<'_>, FrameError> {
        if let Some(error) = self.error {
            return Err(error);
        }
        let message = self.message.get(..self.length).unwrap_or_default();
        let (bytes, stated) = message
            .split_last_chunk::<CHECK_BYTES>()
            .ok_or(FrameError::Check)?;
        if !self.register == RESIDUE {
            let check = u32::from_le_bytes(*stated);
            Ok(Message { bytes, check })
        } else {
            Err(FrameError::Check)
        }
    }

    /// Returns bytes of the last message. They stay valid until the next byte is taken.
    pub(crate) fn last_message(&self, bytes: core::ops::Range<usize>) -> &[u8] {
        self.message.get(bytes).unwrap_or_default()
    }
}
