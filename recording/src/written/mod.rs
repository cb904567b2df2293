//! Rows that were computed, as text, Parquet or MDF4.

#[cfg(feature = "mdf")]
mod mdf;
#[cfg(feature = "parquet")]
mod parquet;

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use dashpot_files::FileError;
use dashpot_files::input::is_standard_stream;
use dashpot_files::output::cannot_write_rows;

/// Name and unit of a column; the unit is that which the end of the name tells.
pub type ColumnName = (&'static str, &'static str);

/// In what form rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// CSV.
    Text,
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    Parquet,
    /// ASAM MDF 4.
    #[cfg(feature = "mdf")]
    Mdf4,
}

/// A file that rows are written to one by one, in bounded memory.
pub enum Written<'a> {
    /// CSV.
    Text(&'a Path, Box<csv::Writer<&'a mut dyn Write>>),
    /// Parquet.
    #[cfg(feature = "parquet")]
    Parquet(Box<parquet::Rows<'a>>),
    /// MDF4.
    #[cfg(feature = "mdf")]
    Mdf4(Box<mdf::Rows<'a>>),
}

impl Form {
    /// That of a file by its extension: `.parquet`, `.mf4`, else CSV; that of standard output is CSV.
    ///
    /// # Errors
    /// This build does not write it, in words for a person.
    pub fn of(path: &Path) -> Result<Self, String> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            _ if is_standard_stream(path) => Ok(Self::Text),
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
        "{}: this build does not write it: build it with the feature `{feature}`, or name a file .csv",
        path.display()
    )
}

impl<'a> Written<'a> {
    /// Starts a file of `form`, called `path` in errors, with the columns, the first of which is the time.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        form: Form,
        columns: &[ColumnName],
    ) -> Result<Self, FileError> {
        match form {
            #[cfg(feature = "parquet")]
            Form::Parquet => Ok(Self::Parquet(Box::new(parquet::Rows::new(
                path, file, columns,
            )?))),
            #[cfg(feature = "mdf")]
            Form::Mdf4 => Ok(Self::Mdf4(Box::new(mdf::Rows::new(path, file, columns)?))),
            Form::Text => {
                let mut rows = csv::Writer::from_writer(file);
                rows.write_record(columns.iter().map(|(name, _)| name))
                    .map_err(|error| cannot_write_rows(path, error))?;
                Ok(Self::Text(path, Box::new(rows)))
            }
        }
    }

    /// Adds a row: `values` are its numbers, of which text has those of `text`, which may be of single precision and shorter.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn row(&mut self, values: &[f64], text: impl Serialize) -> Result<(), FileError> {
        // Values are for the other forms.
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

    /// Ends the file.
    ///
    /// # Errors
    /// It cannot be written.
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
