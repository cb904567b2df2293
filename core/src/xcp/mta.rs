//! The memory transfer address.

use super::packet::Parameters;
use super::{Address, ErrorCode, Memory, Text};

/// Memory transfer address: where the next transfer begins.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mta {
    Memory(Address),
    /// A text, from this byte on.
    Text(Text, u32),
}

impl Mta {
    pub fn read(self, memory: &impl Memory, into: &mut [u8]) -> Result<(), ErrorCode> {
        match self {
            Self::Memory(address) => memory.read(address, into),
            Self::Text(text, start) => {
                let start = start as usize;
                let bytes = memory.text(text).get(start..start + into.len());
                into.copy_from_slice(bytes.ok_or(ErrorCode::AccessDenied)?);
                Ok(())
            }
        }
    }

    pub fn plus(self, bytes: usize) -> Self {
        match self {
            Self::Memory(address) => Self::Memory(address.plus(bytes)),
            Self::Text(text, start) => Self::Text(text, start.saturating_add(bytes as u32)),
        }
    }
}

/// Address extension and address.
pub(super) fn address(parameters: &mut Parameters) -> Result<Address, ErrorCode> {
    Ok(Address {
        extension: parameters.byte()?,
        offset: parameters.double_word()?,
    })
}
