//! Numbers of one column of a Parquet file.

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::RowGroupReader;
use parquet::schema::types::ColumnDescriptor;

use super::schema::is_instant;
use crate::sums::Sum;

/// A chosen column.
pub(super) struct Column {
    index: usize,
    /// Level at which a value is there.
    present: i16,
    /// Whether its numbers are instants, of which only the time since the first is of use: a double has not enough digits.
    is_instant: bool,
    origin: Option<i64>,
    reader: Option<ColumnReader>,
    values: Vec<f64>,
    /// The column's name, the sum that the file says it has, and that of the numbers read so far.
    sum: Option<(String, String, Sum)>,
}

impl Column {
    /// The column of this number from 0, of no row group yet.
    pub(super) fn new(index: usize, descriptor: &ColumnDescriptor, sum: Option<String>) -> Self {
        Self {
            index,
            present: descriptor.max_def_level(),
            is_instant: is_instant(descriptor),
            origin: None,
            reader: None,
            values: Vec::new(),
            sum: sum.map(|sum| (descriptor.path().string(), sum, Sum::default())),
        }
    }

    /// The column's name where the numbers read are not those that the file's sum is of.
    pub(super) fn differs_from_sum(&self) -> Option<&str> {
        let (name, expected, sum) = self.sum.as_ref()?;
        (*expected != sum.text()).then_some(name)
    }

    /// Goes to its start in a row group.
    pub(super) fn open(&mut self, group: &dyn RowGroupReader) -> Result<(), ParquetError> {
        self.reader = Some(group.get_column_reader(self.index)?);
        Ok(())
    }

    /// Of the values read last that of this place.
    #[inline]
    pub(super) fn value(&self, place: usize) -> Option<f64> {
        self.values.get(place).copied()
    }

    /// Reads so many values; how many there were.
    pub(super) fn read(&mut self, count: usize) -> Result<usize, ParquetError> {
        let read = self.read_values(count)?;
        if let Some((_, _, sum)) = &mut self.sum {
            sum.add(&self.values);
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
                    // Instants before year 1677 or after 2262 alone are farther apart than this can be.
                    value.wrapping_sub(*origin.get_or_insert(*value)) as f64
                })
            }
            Some(ColumnReader::Int64ColumnReader(reader)) => {
                take(reader, present, count, values, |value| *value as f64)
            }
            _ => Err(ParquetError::General("the column has no numbers".into())),
        }
    }
}

/// Reads so many values, not a number where there is none; how many there were.
fn take<T: DataType>(
    reader: &mut ColumnReaderImpl<T>,
    present: i16,
    count: usize,
    values: &mut Vec<f64>,
    mut number: impl FnMut(&T::T) -> f64,
) -> Result<usize, ParquetError> {
    let (mut levels, mut numbers) = (Vec::new(), Vec::new());
    let mut total = 0;
    while total < count {
        levels.clear();
        numbers.clear();
        let (read, ..) =
            reader.read_records(count - total, Some(&mut levels), None, &mut numbers)?;
        if read == 0 {
            break;
        }
        total += read;
        let mut numbers = numbers.iter().map(&mut number);
        if present == 0 {
            values.extend(numbers);
        } else {
            let at = |level: &i16| match *level == present {
                true => numbers.next().unwrap_or(f64::NAN),
                false => f64::NAN,
            };
            values.extend(levels.iter().map(at));
        }
    }
    Ok(total.min(values.len()))
}
