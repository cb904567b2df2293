//! Writes rows as MDF4: one group with the time as its master channel.
//!
//! The library can write only data that fit into memory. It therefore writes a file with one row; this module then
//! replaces that row by all rows, and sets the row count in the two fields that contain it. Because the count precedes
//! the rows, a temporary file keeps the rows until the count is known.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Seek, Write};
use std::path::Path;

use falcon_mdf::Mf4Writer;

use super::Column;
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Buffer size for the temporary file in bytes.
const PART: usize = 1 << 16;

/// Size of a number in bytes.
const NUMBER: usize = 8;

/// Offset of the length in a data block.
const LENGTH: usize = 8;

/// Size of the header of a data block, which precedes the rows.
const DATA_HEADER: usize = 24;

/// Offset of the number of rows in a channel group block, where it follows the header, six links and the record number.
const CYCLE_COUNT: usize = 24 + 6 * 8 + 8;

/// An MDF4 file being written.
pub struct Rows<'a> {
    path: &'a Path,
    file: &'a mut dyn Write,
    head: Vec<u8>,
    rows: BufWriter<File>,
    width: usize,
    count: u64,
}

impl<'a> Rows<'a> {
    pub(super) fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        columns: &[Column],
    ) -> Result<Self, FileError> {
        let failed = |error: io::Error| cannot_write(path, error);
        Ok(Self {
            path,
            file,
            head: one_row_file(columns).map_err(failed)?,
            rows: BufWriter::with_capacity(PART, tempfile::tempfile().map_err(failed)?),
            width: columns.len(),
            count: 0,
        })
    }

    pub(super) fn row(&mut self, values: &[f64]) -> Result<(), FileError> {
        let failed = |error: io::Error| cannot_write(self.path, error);
        for value in values {
            self.rows.write_all(&value.to_le_bytes()).map_err(failed)?;
        }
        self.count += 1;
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), FileError> {
        let path = self.path;
        self.write().map_err(|error| cannot_write(path, error))
    }

    fn write(mut self) -> io::Result<()> {
        let row_bytes = self.width * NUMBER;
        let data = self.head.len().checked_sub(row_bytes + DATA_HEADER);
        let data = data.filter(|data| self.head[*data..].starts_with(b"##DT"));
        let data = data.ok_or_else(|| unexpected("the data block is not last"))?;
        let group = self.head.windows(4).position(|bytes| bytes == b"##CG");
        let group = group.ok_or_else(|| unexpected("there is no channel group"))?;
        let length = DATA_HEADER as u64 + self.count * row_bytes as u64;
        set(&mut self.head, data + LENGTH, length)?;
        set(&mut self.head, group + CYCLE_COUNT, self.count)?;
        self.file.write_all(&self.head[..data + DATA_HEADER])?;
        let mut rows = self.rows.into_inner().map_err(|error| error.into_error())?;
        rows.rewind()?;
        io::copy(&mut BufReader::with_capacity(PART, rows), self.file)?;
        Ok(())
    }
}

/// Creates a file with one row of zeros.
fn one_row_file(columns: &[Column]) -> io::Result<Vec<u8>> {
    // The start time is unknown. The epoch makes files reproducible.
    let mut writer = Mf4Writer::with_start_time_ns(0);
    let group = writer.add_group(&[0.0]).map_err(io::Error::other)?;
    for column in columns.iter().skip(1) {
        group
            .add_channel(column.name, column.unit, &[0.0])
            .map_err(io::Error::other)?;
    }
    let mut bytes = Vec::new();
    writer.write(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes)
}

fn set(bytes: &mut [u8], at: usize, number: u64) -> io::Result<()> {
    let slot = bytes.get_mut(at..at + NUMBER);
    let slot = slot.ok_or_else(|| unexpected("the file is too short"))?;
    slot.copy_from_slice(&number.to_le_bytes());
    Ok(())
}

fn unexpected(reason: &str) -> io::Error {
    io::Error::other(format!(
        "the MDF4 library wrote an unexpected layout: {reason}"
    ))
}
