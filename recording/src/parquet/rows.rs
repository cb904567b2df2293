//! Rows of the selected columns of a Parquet file.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::column::Column;
use super::read;
use crate::error::RecordingError;
use crate::location::RowLocation;
use crate::rows::Source;
use crate::sums::SUMS;
use dashpot_files::FileError;

/// Rows read at a time.
const ROWS: usize = 1 << 13;

/// Rows of the selected columns.
pub(super) struct ParquetRows {
    path: PathBuf,
    reader: Arc<SerializedFileReader<File>>,
    columns: Vec<Column>,
    group: usize,
    /// Remaining rows in the row group.
    left: usize,
    next: usize,
    read: usize,
    row: u64,
    rows: u64,
    bytes: u64,
}

impl ParquetRows {
    /// Creates a reader of the columns of a file with `rows` rows and a size of `bytes`.
    pub(super) fn new(
        path: &Path,
        reader: Arc<SerializedFileReader<File>>,
        columns: Vec<Column>,
        rows: u64,
        bytes: u64,
    ) -> Self {
        Self {
            path: path.to_owned(),
            reader,
            columns,
            group: 0,
            left: 0,
            next: 0,
            read: 0,
            row: 0,
            rows,
            bytes,
        }
    }

    /// Reads the next block of rows; returns `false` at the end.
    fn read(&mut self) -> Result<bool, FileError> {
        while self.left == 0 {
            if self.group == self.reader.num_row_groups() {
                return if self.row == self.rows {
                    self.check_sums().map(|()| false)
                } else {
                    Err(self.cut_off())
                };
            }
            let path = self.path.clone();
            read(&path, || self.open_group())?;
        }
        let wanted = self.left.min(ROWS);
        for column in &mut self.columns {
            if read(&self.path, || column.read(wanted))? != wanted {
                return Err(self.cut_off());
            }
        }
        self.left -= wanted;
        self.read = wanted;
        self.next = 0;
        Ok(true)
    }

    fn open_group(&mut self) -> Result<(), ParquetError> {
        let group = self.reader.get_row_group(self.group)?;
        for column in &mut self.columns {
            column.open(&*group)?;
        }
        self.left = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        self.group += 1;
        Ok(())
    }

    /// Verifies the checksums once all numbers have been read.
    fn check_sums(&self) -> Result<(), FileError> {
        match self.columns.iter().find_map(Column::differs_from_sum) {
            None => Ok(()),
            Some(column) => Err(FileError::in_file(
                &self.path,
                RecordingError::Sum {
                    column: column.to_owned(),
                    key: SUMS,
                },
            )),
        }
    }

    fn cut_off(&self) -> FileError {
        FileError::in_file(
            &self.path,
            RecordingError::CutOff {
                declared: self.rows,
                found: self.row,
            },
        )
    }
}

impl Source for ParquetRows {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        if self.next >= self.read && !self.read()? {
            return Ok(false);
        }
        for (value, column) in values.iter_mut().zip(&self.columns) {
            *value = column.value(self.next).unwrap_or(f64::NAN);
        }
        self.next += 1;
        self.row += 1;
        Ok(true)
    }

    fn missing(&self, index: usize) -> RecordingError {
        let row = self.next.saturating_sub(1);
        let value = self.columns[index].value(row);
        RecordingError::NotFinite {
            cell: value.map_or_else(String::new, |value| value.to_string()),
        }
    }

    fn location(&self) -> RowLocation {
        RowLocation::Row(self.row)
    }

    fn position(&self) -> u64 {
        (self.bytes as f64 * (self.row as f64 / self.rows.max(1) as f64)) as u64
    }
}
