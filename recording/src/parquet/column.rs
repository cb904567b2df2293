//! Numbers of one column in a Parquet file.

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::RowGroupReader;
use parquet::schema::types::ColumnDescriptor;

use super::schema::is_instant;
use crate::sums::Sum;

/// A selected column.
pub(super) struct Column {
    index: usize,
    /// Definition level of a value that is not null.
    present: i16,
    /// True if the numbers are timestamps. They are read relative to the first timestamp, because a double has too few
    /// digits for a date with nanoseconds.
    is_instant: bool,
    origin: Option<i64>,
    reader: Option<ColumnReader>,
    values: Vec<f64>,
    /// Checksums, if the file contains one for this column.
    checksums: Option<Checksums>,
}

/// Expected and computed checksum of a column.
struct Checksums {
    /// Name of the column.
    name: String,
    /// Checksum in the metadata of the file.
    expected: String,
    /// Checksum of the numbers read so far.
    computed: Sum,
}

impl Column {
    /// Creates a reader of the column with this index (from 0); [`Self::open`] opens its first row group.
    pub(super) fn new(index: usize, descriptor: &ColumnDescriptor, sum: Option<String>) -> Self {
        Self {
            index,
            present: descriptor.max_def_level(),
            is_instant: is_instant(descriptor),
            origin: None,
            reader: None,
            values: Vec::new(),
            checksums: sum.map(|expected| Checksums {
                name: descriptor.path().string(),
                expected,
                computed: Sum::default(),
            }),
        }
    }

    /// Returns the name of the column if the checksum of its numbers is wrong.
    pub(super) fn differs_from_sum(&self) -> Option<&str> {
        let checksums = self.checksums.as_ref()?;
        (checksums.expected != checksums.computed.text()).then_some(&checksums.name)
    }

    /// Opens the column in the next row group.
    pub(super) fn open(&mut self, group: &dyn RowGroupReader) -> Result<(), ParquetError> {
        self.reader = Some(group.get_column_reader(self.index)?);
        Ok(())
    }

    /// Returns a value of the last block by its row.
    #[inline]
    pub(super) fn value(&self, row: usize) -> Option<f64> {
        self.values.get(row).copied()
    }

    /// Reads up to `count` values; returns the number of values read.
    pub(super) fn read(&mut self, count: usize) -> Result<usize, ParquetError> {
        let read = self.read_values(count)?;
        if let Some(checksums) = &mut self.checksums {
            checksums.computed.add(&self.values);
        }
        Ok(read)
    }

    fn read_values(&mut self, count: usize) -> Result<usize, ParquetError> {
        let present = self.present;
        let values = &mut self.values;
        values.clear();
        match &mut self.reader {
            Some(ColumnReader::DoubleColumnReader(reader)) => {
                take(reader, present, count, values, |value| *value)
            }
            Some(ColumnReader::FloatColumnReader(reader)) => {
                take(reader, present, count, values, |value| f64::from(*value))
            }
            Some(ColumnReader::Int32ColumnReader(reader)) => {
                take(reader, present, count, values, |value| f64::from(*value))
            }
            Some(ColumnReader::Int64ColumnReader(reader)) if self.is_instant => {
                let origin = &mut self.origin;
                take(reader, present, count, values, |value| {
                    // The difference of two timestamps (in ns) overflows only if they are more than 292 years apart.
                    value.wrapping_sub(*origin.get_or_insert(*value)) as f64
                })
            }
            // Timestamps of old programs: a day and the nanoseconds in it.
            Some(ColumnReader::Int96ColumnReader(reader)) => {
                let origin = &mut self.origin;
                take(reader, present, count, values, |value| {
                    let ns = value.to_nanos();
                    ns.wrapping_sub(*origin.get_or_insert(ns)) as f64
                })
            }
            Some(ColumnReader::Int64ColumnReader(reader)) => {
                take(reader, present, count, values, |value| *value as f64)
            }
            _ => Err(ParquetError::General("the column has no numbers".into())),
        }
    }
}

/// Reads up to `count` values, NaN for null; returns the number of values read, which is lower only at the end of the
/// row group.
fn take<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    present: i16,
    count: usize,
    values: &mut Vec<f64>,
    number: impl FnMut(&T::T) -> f64,
) -> Result<usize, ParquetError> {
    let (mut levels, mut numbers) = (Vec::new(), Vec::new());
    let (read, ..) = reader.read_records(count, Some(&mut levels), None, &mut numbers)?;
    let mut numbers = numbers.iter().map(number);
    if present == 0 {
        values.extend(numbers);
    } else {
        let at = |level: &i16| match *level == present {
            true => numbers.next().unwrap_or(f64::NAN),
            false => f64::NAN,
        };
        values.extend(levels.iter().map(at));
    }
    Ok(read.min(values.len()))
}
