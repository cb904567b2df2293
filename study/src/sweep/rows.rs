//! Files of rows: CSV with a header, read strictly and written completely in the order of the cases.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use super::row::Row;
use super::study::Study;
use dashpot_files::FileError;
use dashpot_files::input;
use dashpot_files::output::{cannot_write_rows, write_whole};

/// Error from a file of rows.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RowsError {
    /// The file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Invalid line: it is damaged or altered, or its case is also on another line.
    #[error("{source}")]
    Damaged {
        /// Line number, from 1.
        line: u64,
        /// Reason.
        source: FileError,
    },
    /// The rows belong to another study, version or physics, or to an earlier release with other columns.
    #[error("{0}")]
    Foreign(FileError),
}

/// Rows by case number.
pub type Rows = BTreeMap<u64, Row>;

/// Row with its line in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberedRow {
    /// Line number, from 1.
    pub line: u64,
    /// Row on this line.
    pub row: Row,
}

/// Reads the rows of a study from the file at `path`.
///
/// # Errors
/// Returns an error if the file cannot be read, or, with line and column, if the header or a row does not belong to
/// this study.
pub fn read(study: &Study, path: &Path) -> Result<Vec<NumberedRow>, RowsError> {
    parse(study, &input::name(path), &input::read(path)?)
}

/// Parses rows from `bytes`, the contents of the file at `path`.
pub(super) fn parse(
    study: &Study,
    path: &Path,
    bytes: &[u8],
) -> Result<Vec<NumberedRow>, RowsError> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(bytes);
    let mut rows = Vec::new();
    let columns = study.columns();
    for (number, record) in reader.records().enumerate() {
        let record = record.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            let source = match error.kind() {
                csv::ErrorKind::Utf8 { .. } => FileError::in_line(path, line, "not UTF-8 text"),
                _ => FileError::in_file(path, error),
            };
            RowsError::Damaged { line, source }
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        if number == 0 {
            if !record.iter().eq(columns.iter()) {
                let reason = format!(
                    "the columns are not those of the study, which are {}",
                    columns.join(",")
                );
                return Err(RowsError::Foreign(FileError::in_line(path, line, reason)));
            }
            continue;
        }
        let row = study.row(record.iter()).map_err(|error| {
            let is_foreign = error.is_foreign();
            let source = FileError::in_line(path, line, error);
            match is_foreign {
                true => RowsError::Foreign(source),
                false => RowsError::Damaged { line, source },
            }
        })?;
        rows.push(NumberedRow { line, row });
    }
    if rows.is_empty() && bytes.is_empty() {
        let reason = format!(
            "empty; allowed: rows under the header {}",
            columns.join(",")
        );
        return Err(FileError::in_file(path, reason).into());
    }
    Ok(rows)
}

/// Reads the rows of a study by case number.
///
/// # Errors
/// Same errors as [`read`]; also an error if a case occurs twice.
pub fn read_once(study: &Study, path: &Path) -> Result<Rows, RowsError> {
    index_by_case(path, read(study, path)?)
}

/// Collects rows by case number and rejects duplicates.
pub(super) fn index_by_case(path: &Path, read: Vec<NumberedRow>) -> Result<Rows, RowsError> {
    let mut rows = Rows::new();
    for NumberedRow { line, row } in read {
        let case = row.case;
        if rows.insert(case, row).is_some() {
            let reason = format!("case {case} occurs a second time; allowed: once");
            let source = FileError::in_line(path, line, reason);
            return Err(RowsError::Damaged { line, source });
        }
    }
    Ok(rows)
}

/// Writes rows under a header, in the order of the cases.
///
/// # Errors
/// Returns an error if the file cannot be written.
pub fn write(study: &Study, rows: &Rows, path: &Path) -> Result<(), FileError> {
    write_whole(path, |file| {
        let failed = |error: csv::Error| cannot_write_rows(path, error);
        let mut writer = csv::Writer::from_writer(file);
        writer.write_record(study.columns()).map_err(failed)?;
        for row in rows.values() {
            let record = record(study, row).map_err(|error| failed(error.into()))?;
            writer.write_record(record).map_err(failed)?;
        }
        writer.flush().map_err(|error| failed(error.into()))
    })
}

/// Formats the cells of a row.
pub(super) fn record(study: &Study, row: &Row) -> io::Result<Vec<String>> {
    let case = study.case(row.case);
    let case = case.ok_or_else(|| io::Error::other(format!("no case {}", row.case)))?;
    Ok(study.record(&case, row))
}
