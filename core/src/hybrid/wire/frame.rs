//! One datagram: 40 bytes, little-endian.

use crate::checksum::crc_32;

/// Size of a datagram.
pub const FRAME_BYTES: usize = 40;

/// First bytes of each datagram: protocol and version.
const MAGIC: [u8; 4] = *b"DSH1";

/// Direction of a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameKind {
    /// From the vehicle to the rig: command (m) and its rate (m/s).
    Command,
    /// From the rig to the vehicle: measured displacement (m) and force (N).
    Measurement,
}

bitflags::bitflags! {
    /// Flags of a datagram. Unknown bits are ignored.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct FrameFlags: u8 {
        /// Command: a session starts, and its sequence numbers with it.
        const START = 1;
        /// Command: the session is over; the rig comes to rest.
        const STOP = 1 << 1;
        /// Measurement: the rig holds its displacement and follows no command until the next session.
        const HELD = 1 << 2;
        /// Measurement: the actuator is at a limit.
        const SATURATED = 1 << 3;
    }
}

/// A datagram.
///
/// ```
/// use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind};
///
/// let frame = Frame {
///     kind: FrameKind::Command,
///     flags: FrameFlags::START,
///     session: 7,
///     sequence: 1,
///     answers: 0,
///     time_s: 0.001,
///     displacement_m: 0.01,
///     other: 0.5,
/// };
/// let bytes = frame.to_bytes();
/// assert_eq!(bytes[..8], *b"DSH1\x01\x01\0\0");
/// assert_eq!(Frame::from_bytes(&bytes), Ok(frame));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Direction.
    pub kind: FrameKind,
    /// Flags.
    pub flags: FrameFlags,
    /// Number of the session, chosen by the vehicle.
    pub session: u32,
    /// Number of this datagram in its direction, from 1; it wraps around.
    pub sequence: u32,
    /// Number of the newest datagram of the other direction when this one was sent; 0 for none.
    pub answers: u32,
    /// Time of the sender (s).
    pub time_s: f64,
    /// Commanded or measured displacement (m), positive in extension.
    pub displacement_m: f32,
    /// Rate of the command (m/s), or the measured force (N), positive when it resists extension.
    pub other: f32,
}

/// Reason why bytes are no datagram of this protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// Not 40 bytes.
    Size,
    /// Other first bytes.
    Magic,
    /// Wrong checksum.
    Checksum,
    /// Neither a command nor a measurement.
    Kind,
    /// A number is not finite.
    Number,
}

impl Frame {
    /// The bytes to send.
    pub fn to_bytes(&self) -> [u8; FRAME_BYTES] {
        let mut bytes = [0; FRAME_BYTES];
        let kind = match self.kind {
            FrameKind::Command => 1,
            FrameKind::Measurement => 2,
        };
        bytes[..4].copy_from_slice(&MAGIC);
        bytes[4..8].copy_from_slice(&[kind, self.flags.bits(), 0, 0]);
        bytes[8..12].copy_from_slice(&self.session.to_le_bytes());
        bytes[12..16].copy_from_slice(&self.sequence.to_le_bytes());
        bytes[16..24].copy_from_slice(&self.time_s.to_le_bytes());
        bytes[24..28].copy_from_slice(&self.displacement_m.to_le_bytes());
        bytes[28..32].copy_from_slice(&self.other.to_le_bytes());
        bytes[32..36].copy_from_slice(&self.answers.to_le_bytes());
        let check = crc_32(&bytes[..36]);
        bytes[36..].copy_from_slice(&check.to_le_bytes());
        bytes
    }

    /// Reads a datagram.
    ///
    /// # Errors
    /// The bytes are no datagram of this protocol, are damaged, or contain a number that is not finite.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FrameError> {
        let bytes: &[u8; FRAME_BYTES] = bytes.try_into().map_err(|_| FrameError::Size)?;
        if bytes[..4] != MAGIC {
            return Err(FrameError::Magic);
        }
        let four = |at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
        let whole = |at| u32::from_le_bytes(four(at));
        let real = |at| f32::from_le_bytes(four(at));
        if whole(36) != crc_32(&bytes[..36]) {
            return Err(FrameError::Checksum);
        }
        let frame = Self {
            kind: match bytes[4] {
                1 => FrameKind::Command,
                2 => FrameKind::Measurement,
                _ => return Err(FrameError::Kind),
            },
            flags: FrameFlags::from_bits_truncate(bytes[5]),
            session: whole(8),
            sequence: whole(12),
            answers: whole(32),
            time_s: f64::from_bits(u64::from(whole(16)) | u64::from(whole(20)) << 32),
            displacement_m: real(24),
            other: real(28),
        };
        let is_finite =
            frame.time_s.is_finite() && frame.displacement_m.is_finite() && frame.other.is_finite();
        if is_finite {
            Ok(frame)
        } else {
            Err(FrameError::Number)
        }
    }
}
