//! Rows as MDF4: one group whose master is the time.
//!
//! The library writes what it holds in memory. It is given one row; the file is what it makes of that, with the rows behind it and their
//! number in the two places that tell it. The number comes before the rows, which are in a temporary file until it is known.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Seek, Write};
use std::path::Path;

use falcon_mdf::Mf4Writer;

use super::ColumnName;
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Bytes of rows that go to or come from the temporary file at once.
const PART: usize = 1 << 16;

/// Bytes of a number in a row.
const NUMBER: usize = 8;

/// A block of data has its length behind its mark, and its rows behind its header.
const LENGTH: usize = 8;
const DATA_HEADER: usize = 24;

/// A block of a channel group has its number of rows behind its header, six links and the number of its record.
const CYCLE_COUNT: usize = 24 + 6 * 8 + 8;

/// A file of MDF4 that is being written.
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
        columns: &[ColumnName],
    ) -> Result<Self, FileError> {
        let failed = |error: io::Error| cannot_write(path, error);
        Ok(Self {
            path,
            file,
            head: of_one_row(columns).map_err(failed)?,
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
        let data = data.ok_or_else(|| unexpected("its data are not at its end"))?;
        let group = self.head.windows(4).position(|bytes| bytes == b"##CG");
        let group = group.ok_or_else(|| unexpected("it has no channel group"))?;
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

/// A file of one row of zeros.
fn of_one_row(columns: &[ColumnName]) -> io::Result<Vec<u8>> {
    // No start of the recording is known: the epoch, so that the same rows make the same file.
    let mut writer = Mf4Writer::with_start_time_ns(0);
    let group = writer.add_group(&[0.0]).map_err(io::Error::other)?;
    for (name, unit) in columns.iter().skip(1) {
        group
            .add_channel(name, unit, &[0.0])
            .map_err(io::Error::other)?;
    }
    let mut bytes = Vec::new();
    writer.write(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes)
}

fn set(bytes: &mut [u8], at: usize, number: u64) -> io::Result<()> {
    let place = bytes.get_mut(at..at + NUMBER);
    let place = place.ok_or_else(|| unexpected("it is too short"))?;
    place.copy_from_slice(&number.to_le_bytes());
    Ok(())
}

fn unexpected(what: &str) -> io::Error {
    io::Error::other(format!(
        "the library wrote another MDF4 than it did: {what}"
    ))
}
