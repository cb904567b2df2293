//! The histories as Parquet: a column of float64 for each signal, called as in history.csv.

use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};

use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::commands::failure::{Failure, Outcome};
use crate::files::FileError;
use crate::files::output::{cannot_write, write_whole};

/// Rows of a row group: some 15 MB of a locomotive.
const ROWS: usize = 16_384;

/// Writes the rows of the CSV file `from`, numbers under a header, as Parquet to `to`.
///
/// # Errors
/// A file that cannot be read or written.
pub(super) fn write(from: &Path, to: &Path) -> Outcome<()> {
    let mut rows = csv::Reader::from_path(from).map_err(|error| unreadable(from, error))?;
    let names = rows.headers().map_err(|error| unreadable(from, error))?;
    let schema = schema(names.iter()).map_err(|error| unwritable(to, error))?;
    let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(ROWS); names.len()];
    write_whole::<Failure>(to, |file| {
        let bytes = Bytes::default();
        let properties = Arc::new(WriterProperties::builder().build());
        let mut writer = SerializedFileWriter::new(bytes.clone(), schema, properties)
            .map_err(|error| unwritable(to, error))?;
        let mut row = csv::StringRecord::new();
        loop {
            let is_row = rows
                .read_record(&mut row)
                .map_err(|error| unreadable(from, error))?;
            if is_row {
                for (column, cell) in columns.iter_mut().zip(&row) {
                    let number = cell.parse::<f64>();
                    column.push(number.map_err(|error| FileError::in_file(from, error))?);
                }
            }
            let is_whole = columns.first().is_some_and(|column| column.len() == ROWS);
            if is_whole || !is_row {
                add(&mut writer, &columns).map_err(|error| unwritable(to, error))?;
                bytes
                    .take_to(file)
                    .map_err(|error| cannot_write(to, error))?;
                columns.iter_mut().for_each(Vec::clear);
            }
            if !is_row {
                break;
            }
        }
        writer.close().map_err(|error| unwritable(to, error))?;
        Ok(bytes
            .take_to(file)
            .map_err(|error| cannot_write(to, error))?)
    })
}

fn schema<'a>(names: impl Iterator<Item = &'a str>) -> Result<Arc<Type>, ParquetError> {
    let columns = names.map(|name| {
        let column = Type::primitive_type_builder(name, parquet::basic::Type::DOUBLE);
        let required = parquet::basic::Repetition::REQUIRED;
        Ok(Arc::new(column.with_repetition(required).build()?))
    });
    let columns = columns.collect::<Result<_, ParquetError>>()?;
    let group = Type::group_type_builder("history").with_fields(columns);
    Ok(Arc::new(group.build()?))
}

/// A row group.
fn add(writer: &mut SerializedFileWriter<Bytes>, columns: &[Vec<f64>]) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for values in columns {
        if let Some(mut column) = group.next_column()? {
            column
                .typed::<DoubleType>()
                .write_batch(values, None, None)?;
            column.close()?;
        }
    }
    group.close()?;
    Ok(())
}

/// What the library has written and the file has not got: it takes no writer that is only lent.
#[derive(Clone, Default)]
struct Bytes(Arc<Mutex<Vec<u8>>>);

impl Bytes {
    fn take_to(&self, file: &mut dyn Write) -> io::Result<()> {
        match self.0.lock() {
            Ok(mut bytes) => file.write_all(&std::mem::take(&mut *bytes)),
            Err(error) => Err(io::Error::other(error.to_string())),
        }
    }
}

impl Write for Bytes {
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

fn unreadable(path: &Path, error: csv::Error) -> FileError {
    FileError::in_file(path, error)
}

fn unwritable(path: &Path, error: ParquetError) -> FileError {
    cannot_write(path, io::Error::other(error))
}
