//! Writes computed rows as text, Parquet or MDF4.

#[cfg(feature = "mdf")]
mod growing;
#[cfg(feature = "mdf")]
mod mdf;
#[cfg(feature = "mdf")]
mod mdf_head;
#[cfg(feature = "parquet")]
mod parquet;

use std::io::Write;
use std::path::Path;

#[cfg(feature = "mdf")]
pub use growing::GrowingMdf;

use serde::Serialize;

use dashpot_files::FileError;
use dashpot_files::output::cannot_write_rows;

/// Name and unit of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name, which should end with the unit, such as `force_n`.
    pub name: &'static str,
    /// Unit, such as `N`.
    pub unit: &'static str,
}

impl Column {
    /// Creates a column with a name and a unit.
    pub const fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit }
    }
}

/// Output file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// CSV.
    Text,
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    Parquet,
    /// ASAM MDF 4.
    #[cfg(feature = "mdf")]
    Mdf4,
}

/// Writes rows one by one to a file, in bounded memory.
pub enum RowWriter<'a> {
    /// CSV.
    Text(&'a Path, Box<csv::Writer<&'a mut dyn Write>>),
    /// Parquet.
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::Rows<'a>>),
    /// MDF4.
    #[cfg(feature = "mdf")]
    Mdf4(Box<mdf::Rows<'a>>),
}

impl FileFormat {
    /// Returns the format for the extension of `path`: `.parquet`, `.mf4`, otherwise CSV. Standard output is CSV.
    ///
    /// # Errors
    /// Returns an error message if this build cannot write the format.
    pub fn from_path(path: &Path) -> Result<Self, String> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        // The name `-` of standard output has no extension.
        match extension.to_str() {
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            #[cfg(feature = "mdf")]
            Some("mf4") => Ok(Self::Mdf4),
            #[cfg(not(feature = "parquet"))]
            Some("parquet") => Err(without(path, "parquet")),
            #[cfg(not(feature = "mdf"))]
            Some("mf4") => Err(without(path, "mdf")),
            _ => Ok(Self::Text),
        }
    }
}

#[cfg(not(all(feature = "mdf", feature = "parquet")))]
fn without(path: &Path, feature: &str) -> String {
    format!(
        "{}: this build cannot write this format because it lacks the feature `{feature}`; allowed: .csv",
        path.display()
    )
}

impl<'a> RowWriter<'a> {
    /// Starts a file with the given format and columns. The first column is the time; errors name the file `path`.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        format: FileFormat,
        columns: &[Column],
    ) -> Result<Self, FileError> {
        match format {
            #[cfg(feature = "parquet")]
            FileFormat::Parquet => Ok(Self::Parquet(Box::new(parquet::Rows::new(
                path, file, columns,
            )?))),
            #[cfg(feature = "mdf")]
            FileFormat::Mdf4 => Ok(Self::Mdf4(Box::new(mdf::Rows::new(path, file, columns)?))),
            FileFormat::Text => {
                let mut rows = csv::Writer::from_writer(file);
                rows.write_record(columns.iter().map(|column| column.name))
                    .map_err(|error| cannot_write_rows(path, error))?;
                Ok(Self::Text(path, Box::new(rows)))
            }
        }
    }

    /// Writes a row. Binary formats contain `values`; text files contain `text`, whose numbers may be in single
    /// precision and therefore shorter.
    ///
    /// # Errors
    /// Returns an error if the row cannot be written.
    pub fn row(&mut self, values: &[f64], text: impl Serialize) -> Result<(), FileError> {
        // Only binary formats use `values`.
        #[cfg(not(any(feature = "parquet", feature = "mdf")))]
        let _ = values;
        match self {
            Self::Text(path, rows) => rows
                .serialize(text)
                .map_err(|error| cannot_write_rows(path, error)),
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => rows.row(values),
            #[cfg(feature = "mdf")]
            Self::Mdf4(rows) => rows.row(values),
        }
    }

    /// Finishes the file.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn finish(self) -> Result<(), FileError> {
        match self {
            Self::Text(path, mut rows) => rows
                .flush()
                .map_err(|error| cannot_write_rows(path, error.into())),
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => rows.finish(),
            #[cfg(feature = "mdf")]
            Self::Mdf4(rows) => rows.finish(),
        }
    }
}
