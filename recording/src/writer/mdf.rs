//! Writes rows as MDF4: one group with the time as its master channel.
//!
//! Because the row count precedes the rows, a temporary file keeps the rows until the count is known.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Seek, Write};
use std::path::Path;

use super::Column;
use super::mdf_head::{Head, Width};
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Buffer size for the temporary file in bytes.
const PART: usize = 1 << 16;

/// An MDF4 file being written.
pub struct Rows<'a> {
    path: &'a Path,
    file: &'a mut dyn Write,
    head: Head,
    rows: BufWriter<File>,
    count: u64,
}

impl<'a> Rows<'a> {
    pub(super) fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        columns: &[Column],
    ) -> Result<Self, FileError> {
        let failed = |error: io::Error| cannot_write(path, error);
        let columns = columns.iter().map(|column| (column.name, column.unit));
        Ok(Self {
            path,
            file,
            head: Head::new(columns, Width::Double).map_err(failed)?,
            rows: BufWriter::with_capacity(PART, tempfile::tempfile().map_err(failed)?),
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

    fn write(self) -> io::Result<()> {
        let head = self.head.with_rows(self.count)?;
        self.file.write_all(head.bytes())?;
        let mut rows = self.rows.into_inner().map_err(|error| error.into_error())?;
        rows.rewind()?;
        io::copy(&mut BufReader::with_capacity(PART, rows), self.file)?;
        Ok(())
    }
}
