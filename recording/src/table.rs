//! Tables with text and numbers, as CSV or Parquet.

use std::path::Path;

use crate::writer::FileFormat;
use dashpot_files::FileError;
use dashpot_files::output::write_bytes;

/// Checks that the extension of `path` is of a format for tables: `.parquet`, otherwise CSV.
///
/// # Errors
/// Returns an error message if this build cannot write the format, or if it has no text.
pub fn check(path: &Path) -> Result<(), String> {
    match FileFormat::from_path(path)? {
        #[cfg(feature = "mdf")]
        FileFormat::Mdf4 => Err(format!(
            "{}: the table contains text; allowed: .csv, .parquet",
            path.display()
        )),
        _ => Ok(()),
    }
}

/// Writes the CSV table in `text`, which must have a header, in the format for the extension of `path`. The columns
/// named in `texts` are text in Parquet even if all their cells are numbers.
///
/// # Errors
/// Returns an error if the file cannot be written.
pub fn write(path: &Path, text: &[u8], texts: &[&str]) -> Result<(), FileError> {
    // Only Parquet has types.
    #[cfg(not(feature = "parquet"))]
    let _ = texts;
    match FileFormat::from_path(path) {
        #[cfg(feature = "parquet")]
        Ok(FileFormat::Parquet) => crate::columns::write_text(text, path, texts),
        _ => write_bytes(path, text),
    }
}
