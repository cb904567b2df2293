//! The packet of forces for the actuators (docs/link.md).

use dashpot_core::link::MAX_DAMPERS;
use heapless::Vec;

/// Start of a packet. No force has this bit pattern, so a reader can synchronise to it.
pub const MARK: [u8; 4] = [0xff; 4];

/// The mark, then each force (N) in single precision, little-endian.
///
/// ```
/// let packet = dashpot_device::ForcePacket::new(&[1.0, -2.0]);
/// assert_eq!(packet.bytes(), [0xff, 0xff, 0xff, 0xff, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ForcePacket(Vec<u8, { MARK.len() + 4 * MAX_DAMPERS }>);

impl ForcePacket {
    /// A packet with the forces of a bank (N).
    pub fn new<const N: usize>(forces_n: &[f32; N]) -> Self {
        const { assert!(N <= MAX_DAMPERS, "at most MAX_DAMPERS dampers") };
        let forces = forces_n.iter().flat_map(|force_n| force_n.to_le_bytes());
        Self(MARK.into_iter().chain(forces).collect())
    }

    /// Bytes to send.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }
}
