//! Writes rows as Parquet: one float64 column per quantity, with units and SHA-256 checksums in the metadata.

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

use super::Column;
use crate::columns::SharedBuffer;
use crate::parquet::UNITS;
use crate::sums::{self, Sum};
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Rows per row group.
const ROWS: usize = 1 << 16;

/// A Parquet file being written.
pub struct Rows<'a> {
    path: &'a Path,
    file: &'a mut dyn Write,
    bytes: SharedBuffer,
    writer: SerializedFileWriter<SharedBuffer>,
    columns: Vec<Vec<f64>>,
    sums: Vec<(&'static str, Sum)>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        columns: &[Column],
    ) -> Result<Self, FileError> {
        let bytes = SharedBuffer::default();
        let writer = start(bytes.clone(), columns).map_err(|error| failed(path, error))?;
        Ok(Self {
            path,
            file,
            bytes,
            writer,
            sums: columns
                .iter()
                .map(|column| (column.name, Sum::default()))
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

    /// Writes the buffered rows as a row group.
    fn flush(&mut self) -> Result<(), FileError> {
        self.write_group()
            .map_err(|error| failed(self.path, error))?;
        let flushed = self.bytes.flush_to(self.file);
        flushed.map_err(|error| cannot_write(self.path, error))
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for (column, (_, sum)) in self.columns.iter_mut().zip(&mut self.sums) {
            sum.add(column);
            if let Some(mut writer) = group.next_column()? {
                writer
                    .typed::<DoubleType>()
                    .write_batch(column, None, None)?;
                writer.close()?;
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
        let flushed = self.bytes.flush_to(self.file);
        flushed.map_err(|error| cannot_write(path, error))
    }
}

fn start(
    bytes: SharedBuffer,
    columns: &[Column],
) -> Result<SerializedFileWriter<SharedBuffer>, ParquetError> {
    let fields = columns.iter().map(|column| {
        let field = Type::primitive_type_builder(column.name, Physical::DOUBLE)
            .with_repetition(Repetition::REQUIRED);
        Ok(Arc::new(field.build()?))
    });
    let fields = fields.collect::<Result<_, ParquetError>>()?;
    let schema = Type::group_type_builder("table")
        .with_fields(fields)
        .build()?;
    let units: serde_json::Map<String, serde_json::Value> = columns
        .iter()
        .map(|column| (column.name.into(), column.unit.into()))
        .collect();
    let units = serde_json::Value::Object(units).to_string();
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        // Numbers rarely repeat, so a dictionary would save nothing.
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(vec![KeyValue::new(UNITS.into(), units)]));
    SerializedFileWriter::new(bytes, Arc::new(schema), Arc::new(properties.build()))
}

fn failed(path: &Path, error: ParquetError) -> FileError {
    cannot_write(path, io::Error::other(error))
}
