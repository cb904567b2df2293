//! Converts CSV tables to Parquet. Columns in which every cell is a number or empty become float64, all others text.
//! The metadata contain the SHA-256 of the numbers.

use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::sums::{self, Sum};
use dashpot_files::FileError;
use dashpot_files::output::{cannot_write, write_whole};

/// Rows per row group, which takes about 15 MB for the history of a locomotive.
const ROWS: usize = 16_384;

/// Cells of one column.
enum Column {
    Numbers(Vec<Option<f64>>, Sum),
    Texts(Vec<ByteArray>),
}

/// Converts the CSV file `from`, which must have a header, to the Parquet file `to`. The columns named in `texts` are
/// always text, because a hexadecimal digest may consist of digits only.
///
/// # Errors
/// Returns an error if a file cannot be read or written.
pub fn write(from: &Path, to: &Path, texts: &[&str]) -> Result<(), FileError> {
    let open = || csv::Reader::from_path(from);
    convert(from, open, to, texts)
}

/// Writes the CSV table in `text`, which must have a header, as the Parquet file `to`; `texts` as for [`write()`].
///
/// # Errors
/// Returns an error if the table is not CSV or the file cannot be written.
pub fn write_text(text: &[u8], to: &Path, texts: &[&str]) -> Result<(), FileError> {
    convert(to, || Ok(csv::Reader::from_reader(text)), to, texts)
}

/// Converts the table that `open` opens, which is read twice; errors in it name `from`.
fn convert<R: io::Read>(
    from: &Path,
    open: impl Fn() -> Result<csv::Reader<R>, csv::Error>,
    to: &Path,
    texts: &[&str],
) -> Result<(), FileError> {
    let unreadable = |error: csv::Error| FileError::in_file(from, error);
    let unwritable = |error: ParquetError| cannot_write(to, io::Error::other(error));
    let are_numbers = open()
        .and_then(|rows| numbers(rows, texts))
        .map_err(unreadable)?;
    let mut rows = open().map_err(unreadable)?;
    let names = rows.headers().map_err(unreadable)?.clone();
    let schema = schema(names.iter().zip(&are_numbers)).map_err(unwritable)?;
    let mut columns: Vec<Column> = are_numbers
        .iter()
        .map(|is_number| match is_number {
            true => Column::Numbers(Vec::with_capacity(ROWS), Sum::default()),
            false => Column::Texts(Vec::new()),
        })
        .collect();
    write_whole(to, |file| {
        let bytes = SharedBuffer::default();
        let properties = Arc::new(WriterProperties::builder().build());
        let mut writer =
            SerializedFileWriter::new(bytes.clone(), schema, properties).map_err(unwritable)?;
        let (mut row, mut count) = (csv::StringRecord::new(), 0);
        loop {
            let is_row = rows.read_record(&mut row).map_err(unreadable)?;
            if is_row {
                count += 1;
                for (column, cell) in columns.iter_mut().zip(&row) {
                    match column {
                        Column::Numbers(numbers, _) => numbers.push(cell.parse().ok()),
                        Column::Texts(texts) => texts.push(cell.into()),
                    }
                }
            }
            if count == ROWS || !is_row {
                add(&mut writer, &mut columns).map_err(unwritable)?;
                bytes
                    .flush_to(file)
                    .map_err(|error| cannot_write(to, error))?;
                count = 0;
            }
            if !is_row {
                break;
            }
        }
        let sums = columns
            .iter()
            .zip(&names)
            .filter_map(|(column, name)| match column {
                Column::Numbers(_, sum) => Some((name, sum)),
                Column::Texts(_) => None,
            });
        writer.append_key_value_metadata(sums::metadata(sums));
        writer.close().map_err(unwritable)?;
        bytes
            .flush_to(file)
            .map_err(|error| cannot_write(to, error))
    })
}

/// For each column, returns true if at least one cell is a number and all others are numbers or empty.
fn numbers<R: io::Read>(mut rows: csv::Reader<R>, texts: &[&str]) -> Result<Vec<bool>, csv::Error> {
    let names = rows.headers()?;
    let mut only_numbers: Vec<bool> = names.iter().map(|name| !texts.contains(&name)).collect();
    let mut has_number = vec![false; only_numbers.len()];
    let mut row = csv::StringRecord::new();
    while rows.read_record(&mut row)? {
        for (index, cell) in row.iter().enumerate() {
            let is_number = cell.parse::<f64>().is_ok();
            only_numbers[index] &= is_number || cell.is_empty();
            has_number[index] |= is_number;
        }
    }
    let columns = only_numbers.into_iter().zip(has_number);
    Ok(columns
        .map(|(only_numbers, has_number)| only_numbers && has_number)
        .collect())
}

fn schema<'a>(
    columns: impl Iterator<Item = (&'a str, &'a bool)>,
) -> Result<Arc<Type>, ParquetError> {
    let columns = columns.map(|(name, is_number)| {
        let column = match is_number {
            true => Type::primitive_type_builder(name, Physical::DOUBLE)
                .with_repetition(Repetition::OPTIONAL),
            false => Type::primitive_type_builder(name, Physical::BYTE_ARRAY)
                .with_logical_type(Some(LogicalType::String))
                .with_repetition(Repetition::REQUIRED),
        };
        Ok(Arc::new(column.build()?))
    });
    let columns = columns.collect::<Result<_, ParquetError>>()?;
    let group = Type::group_type_builder("table").with_fields(columns);
    Ok(Arc::new(group.build()?))
}

/// Writes the cells of the columns as a row group and clears them.
fn add(
    writer: &mut SerializedFileWriter<SharedBuffer>,
    columns: &mut [Column],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        let Some(mut writer) = group.next_column()? else {
            continue;
        };
        match column {
            Column::Numbers(numbers, sum) => {
                let read: Vec<f64> = numbers.iter().map(|n| n.unwrap_or(f64::NAN)).collect();
                sum.add(&read);
                let levels: Vec<i16> = numbers.iter().map(|n| i16::from(n.is_some())).collect();
                let values: Vec<f64> = numbers.drain(..).flatten().collect();
                let writer = writer.typed::<DoubleType>();
                writer.write_batch(&values, Some(&levels), None)?;
            }
            Column::Texts(texts) => {
                let writer = writer.typed::<ByteArrayType>();
                writer.write_batch(texts, None, None)?;
                texts.clear();
            }
        }
        writer.close()?;
    }
    group.close()?;
    Ok(())
}

/// Buffer that the library writes to. The library must own its writer, but the file is only borrowed.
#[derive(Clone, Default)]
pub(super) struct SharedBuffer(Arc<Mutex<Vec<u8>>>);

impl SharedBuffer {
    /// Moves the buffered bytes to `file`.
    pub(super) fn flush_to(&self, file: &mut dyn Write) -> io::Result<()> {
        match self.0.lock() {
            Ok(mut bytes) => file.write_all(&std::mem::take(&mut *bytes)),
            Err(error) => Err(io::Error::other(error.to_string())),
        }
    }
}

impl Write for SharedBuffer {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        match self.0.lock() {
            Ok(mut bytes) => bytes.write(buffer),
            Err(error) => Err(io::Error::other(error.to_string())),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
