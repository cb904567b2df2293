//! Reads Parquet files in blocks of bounded size and verifies the checksums of files that Dashpot wrote.

mod column;
mod rows;
mod schema;

use std::collections::HashMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::error::RecordingError;
use super::guarded::guarded;
use super::recording_file::RecordingFile;
use super::rows::Source;
use super::select::ChannelInfo;
use super::sums::SUMS;
use super::text::column_from_header;
use column::Column;
use dashpot_files::FileError;
use rows::ParquetRows;

/// Metadata key of the units: a JSON object that maps the name of each column to its unit.
pub(super) const UNITS: &str = "units";

/// A Parquet file with known columns.
pub(super) struct Parquet {
    path: PathBuf,
    reader: Arc<SerializedFileReader<File>>,
    found: Vec<ChannelInfo>,
    /// Checksums by column name; empty for files that another program wrote.
    sums: HashMap<String, String>,
    bytes: u64,
}

impl Parquet {
    /// Reads the list of columns.
    pub(super) fn open(path: &Path, file: File) -> Result<Self, FileError> {
        let bytes = file.metadata().map_or(0, |data| data.len());
        let reader = read(path, || SerializedFileReader::new(file))?;
        let metadata = reader.metadata().file_metadata();
        let rows = u64::try_from(metadata.num_rows()).unwrap_or(0);
        let value_of = |key: &str| {
            let mut pairs = metadata.key_value_metadata().into_iter().flatten();
            let pair = pairs.find(|pair| pair.key == key)?;
            Some(pair.value.as_deref().unwrap_or_default())
        };
        let sums = match value_of(SUMS).map(serde_json::from_str) {
            None => HashMap::new(),
            Some(Ok(sums)) => sums,
            Some(Err(error)) => {
                let reason = format!("its metadata {SUMS}: {error}");
                return Err(damaged(path, reason));
            }
        };
        let units = value_of(UNITS).and_then(|units| serde_json::from_str(units).ok());
        let units: serde_json::Value = units.unwrap_or_default();
        let columns = metadata.schema_descr().columns();
        let found = columns.iter().map(|column| {
            let name = column.path().string();
            let stated = units.get(&name).and_then(|unit| unit.as_str());
            let from_name = column_from_header(&name);
            ChannelInfo {
                unit: stated
                    .map(str::to_owned)
                    .or(schema::unit(column))
                    .or(from_name.unit),
                kind: schema::kind(column),
                is_number: schema::is_number(column),
                rows: Some(rows),
                ..from_name
            }
        });
        let found = found.collect();
        Ok(Self {
            path: path.to_owned(),
            reader: Arc::new(reader),
            found,
            sums,
            bytes,
        })
    }
}

impl RecordingFile for Parquet {
    fn found(&self) -> &[ChannelInfo] {
        &self.found
    }

    fn groups(&self) -> &[String] {
        &[]
    }

    fn rows(&mut self, indices: &[usize], _: bool) -> Result<Box<dyn Source>, FileError> {
        let schema = self.reader.metadata().file_metadata().schema_descr();
        let columns = indices.iter().map(|&index| {
            let column = schema.column(index);
            let sum = self.sums.get(&column.path().string());
            Column::new(index, &column, sum.cloned())
        });
        let rows = self.found.first().and_then(|f| f.rows).unwrap_or(0);
        let reader = Arc::clone(&self.reader);
        let rows = ParquetRows::new(&self.path, reader, columns.collect(), rows, self.bytes);
        Ok(Box::new(rows))
    }
}

/// Calls the library and converts its errors and panics.
fn read<T>(path: &Path, read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, FileError> {
    let reason = match guarded(read) {
        Some(Ok(read)) => return Ok(read),
        Some(Err(error)) => error.to_string(),
        None => "its parts contradict each other".into(),
    };
    Err(damaged(path, reason))
}

fn damaged(path: &Path, reason: String) -> FileError {
    let kind = "Parquet";
    FileError::in_file(path, RecordingError::Damaged { kind, reason })
}
