//! Parquet, read a bounded part at a time.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;

use super::error::RecordingError;
use super::guarded::guarded;
use super::open::Opened;
use super::rows::{Place, Source};
use super::select::Found;
use super::text::found;
use crate::files::FileError;

/// Rows read at a time.
const ROWS: usize = 1 << 13;

/// Key of the units in the file's metadata: an object of JSON with the unit of each column by its name.
pub(super) const UNITS: &str = "units";

/// A Parquet file whose columns are known.
pub(super) struct Parquet {
    path: PathBuf,
    reader: Arc<SerializedFileReader<File>>,
    found: Vec<Found>,
    bytes: u64,
}

/// Values of the chosen columns.
struct ParquetRows {
    path: PathBuf,
    reader: Arc<SerializedFileReader<File>>,
    columns: Vec<Column>,
    group: usize,
    /// Rows left in the row group.
    left: usize,
    next: usize,
    read: usize,
    row: u64,
    rows: u64,
    bytes: u64,
}

/// A chosen column.
struct Column {
    index: usize,
    /// Level at which a value is there.
    present: i16,
    /// Whether its numbers are instants, of which only the time since the first is of use: a double has not enough digits.
    is_instant: bool,
    origin: Option<i64>,
    reader: Option<ColumnReader>,
    values: Vec<f64>,
}

impl Parquet {
    /// Reads what columns there are.
    pub(super) fn open(path: &Path, file: File) -> Result<Self, FileError> {
        let bytes = file.metadata().map_or(0, |data| data.len());
        let reader = read(path, || SerializedFileReader::new(file))?;
        let metadata = reader.metadata().file_metadata();
        let rows = u64::try_from(metadata.num_rows()).unwrap_or(0);
        let units = metadata
            .key_value_metadata()
            .into_iter()
            .flatten()
            .find(|pair| pair.key == UNITS)
            .and_then(|pair| serde_json::from_str(pair.value.as_deref()?).ok());
        let units: serde_json::Value = units.unwrap_or_default();
        let columns = metadata.schema_descr().columns();
        let found = columns.iter().map(|column| {
            let name = column.path().string();
            let told = units.get(&name).and_then(|unit| unit.as_str());
            let from_name = found(&name);
            Found {
                unit: told.map(str::to_owned).or(unit(column)).or(from_name.unit),
                kind: kind(column),
                is_number: is_number(column),
                rows: Some(rows),
                ..from_name
            }
        });
        let found = found.collect();
        Ok(Self {
            path: path.to_owned(),
            reader: Arc::new(reader),
            found,
            bytes,
        })
    }
}

impl Opened for Parquet {
    fn found(&self) -> &[Found] {
        &self.found
    }

    fn groups(&self) -> &[String] {
        &[]
    }

    fn rows(&mut self, indices: &[usize], _: bool) -> Result<Box<dyn Source>, FileError> {
        let schema = self.reader.metadata().file_metadata().schema_descr();
        let columns = indices.iter().map(|&index| {
            let descriptor = schema.column(index);
            Column {
                index,
                present: descriptor.max_def_level(),
                is_instant: is_instant(&descriptor),
                origin: None,
                reader: None,
                values: Vec::new(),
            }
        });
        Ok(Box::new(ParquetRows {
            path: self.path.clone(),
            reader: Arc::clone(&self.reader),
            columns: columns.collect(),
            group: 0,
            left: 0,
            next: 0,
            read: 0,
            row: 0,
            rows: self.found.first().and_then(|f| f.rows).unwrap_or(0),
            bytes: self.bytes,
        }))
    }
}

impl ParquetRows {
    /// Reads the next part of the rows; `false` at the end.
    fn read(&mut self) -> Result<bool, FileError> {
        while self.left == 0 {
            if self.group == self.reader.num_row_groups() {
                return if self.row == self.rows {
                    Ok(false)
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
            column.reader = Some(group.get_column_reader(column.index)?);
        }
        self.left = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        self.group += 1;
        Ok(())
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

impl Column {
    /// Reads so many values; how many there were.
    fn read(&mut self, count: usize) -> Result<usize, ParquetError> {
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

impl Source for ParquetRows {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        if self.next >= self.read && !self.read()? {
            return Ok(false);
        }
        for (value, column) in values.iter_mut().zip(&self.columns) {
            *value = column.values.get(self.next).copied().unwrap_or(f64::NAN);
        }
        self.next += 1;
        self.row += 1;
        Ok(true)
    }

    fn missing(&self, place: usize) -> RecordingError {
        let row = self.next.saturating_sub(1);
        let value = self.columns[place].values.get(row);
        RecordingError::NotFinite {
            cell: value.map_or_else(String::new, f64::to_string),
        }
    }

    fn place(&self) -> Place {
        Place::Row(self.row)
    }

    fn position(&self) -> u64 {
        (self.bytes as f64 * (self.row as f64 / self.rows.max(1) as f64)) as u64
    }
}

/// What the library reads.
fn read<T>(path: &Path, read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, FileError> {
    let reason = match guarded(read) {
        Some(Ok(read)) => return Ok(read),
        Some(Err(error)) => error.to_string(),
        None => "its parts contradict each other".into(),
    };
    let kind = "Parquet";
    Err(FileError::in_file(
        path,
        RecordingError::Damaged { kind, reason },
    ))
}

/// The unit of a time, which its type tells.
fn unit(column: &ColumnDescriptor) -> Option<String> {
    let unit = match column.logical_type_ref() {
        Some(LogicalType::Timestamp(stamp)) => Some(&stamp.unit),
        Some(LogicalType::Time(time)) => Some(&time.unit),
        _ => None,
    };
    let name = match (unit, column.converted_type()) {
        (Some(TimeUnit::MILLIS), _)
        | (None, ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIME_MILLIS) => "ms",
        (Some(TimeUnit::MICROS), _)
        | (None, ConvertedType::TIMESTAMP_MICROS | ConvertedType::TIME_MICROS) => "us",
        (Some(TimeUnit::NANOS), _) => "ns",
        (None, _) => return None,
    };
    Some(name.to_owned())
}

fn is_instant(column: &ColumnDescriptor) -> bool {
    matches!(column.logical_type_ref(), Some(LogicalType::Timestamp(_)))
        || matches!(
            column.converted_type(),
            ConvertedType::TIMESTAMP_MILLIS | ConvertedType::TIMESTAMP_MICROS
        )
}

fn is_number(column: &ColumnDescriptor) -> bool {
    let is_plain = match column.logical_type_ref() {
        None | Some(LogicalType::Timestamp(_) | LogicalType::Time(_)) => true,
        // Of 64 bits without sign, half the numbers would be read as negative ones.
        Some(LogicalType::Integer(integer)) => integer.is_signed || integer.bit_width < 32,
        Some(_) => false,
    };
    let physical = [
        Physical::INT32,
        Physical::INT64,
        Physical::FLOAT,
        Physical::DOUBLE,
    ];
    is_plain && column.max_rep_level() == 0 && physical.contains(&column.physical_type())
}

fn kind(column: &ColumnDescriptor) -> String {
    match (column.logical_type_ref(), column.physical_type()) {
        (Some(LogicalType::Timestamp(_)), _) => "timestamp".into(),
        (Some(LogicalType::Time(_)), _) => "time".into(),
        (Some(LogicalType::String), _) => "text".into(),
        (_, Physical::DOUBLE) => "f64".into(),
        (_, Physical::FLOAT) => "f32".into(),
        (None, Physical::INT32) => "i32".into(),
        (None, Physical::INT64) => "i64".into(),
        (_, other) => other.to_string().to_ascii_lowercase(),
    }
}
