//! A state as bytes with what it takes to refuse the wrong ones.
//!
//! `DAST`, format version and bytes of a scalar (2 each), the bytes of [`DamperState::to_bytes`], CRC-32
//! (ISO-HDLC) of all before; little-endian.

use dashpot_core::{Damper, DamperState, crc_32};

use crate::error::DashpotError;

const MAGIC: [u8; 4] = *b"DAST";
/// Changes whenever the same bytes would mean another state.
const VERSION: u16 = 1;
const SCALAR_BYTES: u16 = 4;
const STATE_BYTES: usize = DamperState::<f32>::BYTES;
pub(crate) const BYTES: usize = 8 + STATE_BYTES + 4;

/// The bytes of a state.
pub(crate) fn save(state: &DamperState<f32>) -> [u8; BYTES] {
    let mut saved = [0; BYTES];
    let bytes = MAGIC
        .into_iter()
        .chain(VERSION.to_le_bytes())
        .chain(SCALAR_BYTES.to_le_bytes())
        .chain(state.to_bytes());
    for (place, byte) in saved.iter_mut().zip(bytes) {
        *place = byte;
    }
    if let Some((checked, check)) = saved.split_last_chunk_mut::<4>() {
        *check = crc_32(checked).to_le_bytes();
    }
    saved
}

/// The state of `damper` in these bytes.
pub(crate) fn restore(
    damper: &Damper<f32>,
    saved: &[u8],
) -> Result<DamperState<f32>, DashpotError> {
    let saved: &[u8; BYTES] = saved.try_into().map_err(|_| DashpotError::Length)?;
    let parts = saved.split_last_chunk::<4>().and_then(|(checked, check)| {
        let (header, state) = checked.split_first_chunk::<8>()?;
        Some((header, state.first_chunk::<STATE_BYTES>()?, checked, check))
    });
    let (header, state, checked, check) = parts.ok_or(DashpotError::Length)?;
    let [m0, m1, m2, m3, v0, v1, s0, s1] = *header;
    if [m0, m1, m2, m3] != MAGIC {
        Err(DashpotError::Magic)
    } else if u16::from_le_bytes([v0, v1]) != VERSION {
        Err(DashpotError::Version)
    } else if u16::from_le_bytes([s0, s1]) != SCALAR_BYTES {
        Err(DashpotError::Scalar)
    } else if crc_32(checked) != u32::from_le_bytes(*check) {
        Err(DashpotError::Checksum)
    } else {
        Ok(damper.restore(state)?)
    }
}
