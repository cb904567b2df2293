//! Rows as Parquet: a column of float64 each, their units and their SHA-256 in the file's metadata.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::ColumnName;
use crate::columns::Bytes;
use crate::parquet::UNITS;
use crate::sums::{self, Sum};
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Rows of a row group.
const ROWS: usize = 1 << 16;

/// A file of Parquet that is being written.
pub struct Rows<'a> {
    path: &'a Path,
    file: &'a mut dyn Write,
    bytes: Bytes,
    writer: SerializedFileWriter<Bytes>,
    columns: Vec<Vec<f64>>,
    sums: Vec<(&'static str, Sum)>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        columns: &[ColumnName],
    ) -> Result<Self, FileError> {
        let bytes = Bytes::default();
        let writer = start(bytes.clone(), columns).map_err(|error| failed(path, error))?;
        Ok(Self {
            path,
            file,
            bytes,
            writer,
            sums: columns
                .iter()
                .map(|(name, _)| (*name, Sum::default()))
                .collect(),
            columns: vec![Vec::with_capacity(ROWS); columns.len()],
        })
    }

    pub(super) fn row(&mut self, values: &[f64]) -> Result<(), FileError> {
        for (column, value) in self.columns.iter_mut().zip(values) {
            column.push(*value);
        }
        match self.columns.first() {
            Some(first) if first.len() == ROWS => self.flush(),
            _ => Ok(()),
        }
    }

    /// A row group of the rows that there are.
    fn flush(&mut self) -> Result<(), FileError> {
        self.add().map_err(|error| failed(self.path, error))?;
        let taken = self.bytes.take_to(self.file);
        taken.map_err(|error| cannot_write(self.path, error))
    }

    fn add(&mut self) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for (column, (_, sum)) in self.columns.iter_mut().zip(&mut self.sums) {
            sum.add(column);
            if let Some(mut place) = group.next_column()? {
                place
                    .typed::<DoubleType>()
                    .write_batch(column, None, None)?;
                place.close()?;
            }
            column.clear();
        }
        group.close()?;
        Ok(())
    }

    pub(super) fn finish(mut self) -> Result<(), FileError> {
        if self.columns.first().is_some_and(|first| !first.is_empty()) {
            self.flush()?;
        }
        let path = self.path;
        let sums = self.sums.iter().map(|(name, sum)| (*name, sum));
        self.writer.append_key_value_metadata(sums::metadata(sums));
        self.writer.close().map_err(|error| failed(path, error))?;
        let taken = self.bytes.take_to(self.file);
        taken.map_err(|error| cannot_write(path, error))
    }
}

fn start(
    bytes: Bytes,
    columns: &[ColumnName],
) -> Result<SerializedFileWriter<Bytes>, ParquetError> {
    let fields = columns.iter().map(|(name, _)| {
        let column = Type::primitive_type_builder(name, Physical::DOUBLE)
            .with_repetition(Repetition::REQUIRED);
        Ok(Arc::new(column.build()?))
    });
    let fields = fields.collect::<Result<_, ParquetError>>()?;
    let schema = Type::group_type_builder("table")
        .with_fields(fields)
        .build()?;
    let units: serde_json::Map<String, serde_json::Value> = columns
        .iter()
        .map(|(name, unit)| ((*name).into(), (*unit).into()))
        .collect();
    let units = serde_json::Value::Object(units).to_string();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        // Hardly a number is there twice.
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(vec![KeyValue::new(UNITS.into(), units)]));
    SerializedFileWriter::new(bytes, Arc::new(schema), Arc::new(properties.build()))
}

fn failed(path: &Path, error: ParquetError) -> FileError {
    cannot_write(path, io::Error::other(error))
}
