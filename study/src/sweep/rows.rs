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

/// Beginning of every header.
const HEADER_START: &[u8] = b"case,sweep,";

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
    parse_from(study, path, bytes, 1)
}

/// Splits the contents of a file of rows before each header, and returns the first line of each section with its bytes.
/// A journal has several sections if the study was extended before it was complete.
pub(super) fn sections(bytes: &[u8]) -> Vec<(u64, &[u8])> {
    let mut sections = Vec::new();
    let (mut start, mut first_line, mut at, mut line) = (0, 1, 0, 1);
    for text in bytes.split_inclusive(|byte| *byte == b'\n') {
        if at > start && text.starts_with(HEADER_START) {
            sections.push((first_line, &bytes[start..at]));
            (start, first_line) = (at, line);
        }
        at += text.len();
        line += 1;
    }
    sections.push((first_line, &bytes[start..]));
    sections
}

/// Checks whether a section has only a header.
pub(super) fn is_header(section: &[u8]) -> bool {
    section.starts_with(HEADER_START) && !section.trim_ascii_end().contains(&b'\n')
}

/// Checks whether rows of `study` can be added at the end: the last section has its header and its rows.
pub(super) fn ends_in_section_of(study: &Study, bytes: &[u8]) -> bool {
    let Some((_, last)) = sections(bytes).pop() else {
        return false;
    };
    let mut reader = csv::Reader::from_reader(last);
    let has_columns = match reader.headers() {
        Ok(header) => header.iter().eq(study.columns()),
        Err(_) => false,
    };
    has_columns && provenance(last).is_none_or(|[digest, ..]| digest == study.digest())
}

/// Returns the whole lines of rows to which a process may be adding; nothing if they are blank. The process was writing
/// an incomplete last line when it ended, or when the file was read.
pub(super) fn whole_lines(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|byte| *byte == b'\n');
    let whole = &bytes[..end.map_or(0, |end| end + 1)];
    match whole.trim_ascii() {
        [] => &[],
        _ => whole,
    }
}

/// Reads study, version and physics from the first row below a header; `None` without a row.
pub(super) fn provenance(section: &[u8]) -> Option<[String; 3]> {
    let mut reader = csv::ReaderBuilder::new()
        .flexible(true)
        .from_reader(section);
    let header = reader.headers().ok()?.clone();
    let record = reader.records().next()?.ok()?;
    let cell = |name: &str| {
        let column = header.iter().position(|column| column == name)?;
        Some(record.get(column)?.to_owned())
    };
    Some([cell("study")?, cell("version")?, cell("physics")?])
}

/// Parses rows from `bytes`, which begin at line `first_line` of the file at `path`.
pub(super) fn parse_from(
    study: &Study,
    path: &Path,
    bytes: &[u8],
    first_line: u64,
) -> Result<Vec<NumberedRow>, RowsError> {
    let line_of = |line: u64| line + first_line - 1;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(bytes);
    let mut rows = Vec::new();
    let columns = study.columns();
    for (number, record) in reader.records().enumerate() {
        let record = record.map_err(|error| {
            let line = line_of(error.position().map_or(0, csv::Position::line));
            let source = match error.kind() {
                csv::ErrorKind::Utf8 { .. } => FileError::in_line(path, line, "not UTF-8 text"),
                _ => FileError::in_file(path, error),
            };
            RowsError::Damaged { line, source }
        })?;
        let line = line_of(record.position().map_or(0, csv::Position::line));
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

#[cfg(test)]
mod tests {
    use super::{provenance, sections};

    #[test]
    fn sections_begin_at_headers_and_keep_their_lines() {
        let text = "case,sweep,seed\n1,a,1\n2,a,2\ncase,sweep,seed,x\n3,b,1,4\n";
        let split: Vec<(u64, &str)> = sections(text.as_bytes())
            .into_iter()
            .map(|(line, bytes)| (line, std::str::from_utf8(bytes).unwrap()))
            .collect();
        let second = text.find("case,sweep,seed,x").unwrap();
        assert_eq!(split, [(1, &text[..second]), (4, &text[second..])]);
        assert_eq!(sections(b""), [(1, b"".as_slice())]);
    }

    #[test]
    fn the_origin_of_a_section_is_that_of_its_first_row() {
        let header = "case,sweep,study,version,physics,row_digest\n";
        assert_eq!(provenance(header.as_bytes()), None);
        let text = format!("{header}0,a,b,1,c,d\n1,a,e,1,c,d\n");
        let origin = provenance(text.as_bytes());
        assert_eq!(origin, Some(["b", "1", "c"].map(str::to_owned)));
    }
}
