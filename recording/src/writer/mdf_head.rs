//! Everything that precedes the rows of an MDF4 file with one group.
//!
//! The library can write only data that fit into memory. It is therefore used to write a file with a single row. The
//! rows then take the place of that row, and the row count is set in the two fields that contain it.

use std::io;

use falcon_mdf::{Mf4Writer, SignalValues};

/// Size of a number in bytes.
pub(super) const NUMBER: usize = 8;

/// Offset of the length in a data block.
const LENGTH: usize = 8;

/// Size of the header of a data block, which precedes the rows.
const DATA_HEADER: usize = 24;

/// Offset of the number of rows in a channel group block, where it follows the header, six links and the record number.
const CYCLE_COUNT: usize = 24 + 6 * 8 + 8;

/// Type of the channels after the time, which is a float of 64 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// Float of 32 bits.
    Single,
    /// Float of 64 bits.
    Double,
}

/// The bytes before the rows.
pub(super) struct Head {
    bytes: Vec<u8>,
    length_at: usize,
    count_at: usize,
    row_bytes: usize,
}

impl Head {
    /// The head of a file with channels of these names and units; the first is the time.
    pub(super) fn new<'a>(
        columns: impl ExactSizeIterator<Item = (&'a str, &'a str)>,
        width: Width,
    ) -> io::Result<Self> {
        let (number, values) = match width {
            Width::Single => (4, SignalValues::F32(vec![0.0])),
            Width::Double => (8, SignalValues::F64(vec![0.0])),
        };
        let row_bytes = NUMBER + columns.len().saturating_sub(1) * number;
        // The start time is unknown. The epoch makes files reproducible.
        let mut writer = Mf4Writer::with_start_time_ns(0);
        let group = writer.add_group(&[0.0]).map_err(io::Error::other)?;
        for (name, unit) in columns.skip(1) {
            group
                .add_channel_typed(name, unit, values.clone())
                .map_err(io::Error::other)?;
        }
        let mut bytes = Vec::new();
        writer.write(&mut bytes).map_err(io::Error::other)?;
        let data = bytes.len().checked_sub(row_bytes + DATA_HEADER);
        let data = data.filter(|data| bytes[*data..].starts_with(b"##DT"));
        let data = data.ok_or_else(|| unexpected("the data block is not last"))?;
        let group = bytes.windows(4).position(|bytes| bytes == b"##CG");
        let group = group.ok_or_else(|| unexpected("there is no channel group"))?;
        bytes.truncate(data + DATA_HEADER);
        let head = Self {
            bytes,
            length_at: data + LENGTH,
            count_at: group + CYCLE_COUNT,
            row_bytes,
        };
        head.with_rows(0)
    }

    /// The head for this number of rows.
    pub(super) fn with_rows(mut self, count: u64) -> io::Result<Self> {
        let [length, count] = self.fields(count);
        for (at, number) in [length, count] {
            let slot = self.bytes.get_mut(at as usize..at as usize + NUMBER);
            let slot = slot.ok_or_else(|| unexpected("the file is too short"))?;
            slot.copy_from_slice(&number.to_le_bytes());
        }
        Ok(self)
    }

    /// Positions and values of the length of the data block and of the number of rows, for this number of rows.
    pub(super) fn fields(&self, count: u64) -> [(u64, u64); 2] {
        let length = DATA_HEADER as u64 + count * self.row_bytes as u64;
        [
            (self.length_at as u64, length),
            (self.count_at as u64, count),
        ]
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Size of a row in bytes.
    pub(super) fn row_bytes(&self) -> usize {
        self.row_bytes
    }
}

fn unexpected(reason: &str) -> io::Error {
    io::Error::other(format!(
        "the MDF4 library wrote an unexpected layout: {reason}"
    ))
}
