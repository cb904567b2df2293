//! Blocks that store records: plain or compressed.

use std::io::{self, Read};

use falcon_mdf::Mf4File;
use flate2::bufread::ZlibDecoder;

/// Maximum number of bytes in a compressed block. Writers make blocks of a few megabytes.
pub(super) const MAX_INFLATED: u64 = 1 << 30;

/// A block of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stored {
    /// Records from an offset of the file.
    Plain {
        /// Offset of the first record.
        at: u64,
        /// Number of bytes.
        length: u64,
    },
    /// Compressed records.
    Compressed(Compressed),
}

/// A compressed block of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Compressed {
    /// Offset of the compressed bytes.
    pub(super) at: u64,
    /// Number of compressed bytes.
    pub(super) length: u64,
    /// Number of bytes without compression.
    pub(super) inflated: u64,
    /// Number of columns of the transposed bytes; `None` if they are not transposed.
    pub(super) columns: Option<u32>,
}

impl Stored {
    /// Number of bytes of its records.
    pub(super) fn length(&self) -> u64 {
        match self {
            Self::Plain { length, .. } => *length,
            Self::Compressed(block) => block.inflated,
        }
    }
}

/// Returns the contents of a compressed block.
///
/// # Errors
/// The bytes are damaged, or their number differs from the one that the block states.
pub(super) fn inflate(block: &Compressed, bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut inflated = Vec::new();
    // One byte more than stated, so that too many are noticed.
    let mut decoder = ZlibDecoder::new(bytes).take(block.inflated.min(MAX_INFLATED) + 1);
    decoder.read_to_end(&mut inflated)?;
    if inflated.len() as u64 != block.inflated {
        let reason = format!(
            "a compressed block has {} bytes, but states {}",
            inflated.len(),
            block.inflated
        );
        return Err(io::Error::new(io::ErrorKind::InvalidData, reason));
    }
    match block.columns {
        None => Ok(inflated),
        Some(columns) => Mf4File::un_transpose(&inflated, columns as usize)
            .map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error)),
    }
}
