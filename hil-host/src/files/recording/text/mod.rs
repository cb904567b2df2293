//! Text: CSV and what else loggers call so.

mod decode;
mod head;
mod header;
mod line_ends;
mod number;
mod options;
mod rows;
mod separator;

use std::io::{BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use csv::{ByteRecord, Reader, ReaderBuilder};
use line_ends::LineEnds;
pub use options::{DecimalMark, Separator, TextOptions};
pub(super) use rows::TextRows;

use super::error::RecordingError;
use super::select::Found;
use super::stream::{Count, Stream};
use crate::files::FileError;

/// A text whose columns are known and whose rows are still to be read.
pub(super) struct Text {
    lines: Lines,
    options: TextOptions,
    found: Vec<Found>,
    /// Cells of a row.
    cells: usize,
    /// The first row, where it was looked at already, and its line.
    pending: Option<(ByteRecord, u64)>,
}

/// Records of the text with their lines.
struct Lines {
    path: PathBuf,
    reader: Reader<LineEnds<Box<dyn Read>>>,
    separator: Separator,
    /// Lines before the first that the reader sees.
    skipped: u64,
    count: Count,
}

impl Text {
    /// Finds the columns of a text, which is called `path` in errors.
    ///
    /// # Errors
    /// An empty text, or one whose first line may be a header or a row.
    pub(super) fn open(
        path: &Path,
        stream: Stream,
        options: &TextOptions,
    ) -> Result<Self, FileError> {
        let count = stream.count();
        let failed = |error| FileError::read(path, error);
        let mut source = BufReader::new(decode::decoded(stream, options.encoding));
        let skipped = head::skip_lines(&mut source, options.skip_lines).map_err(failed)?;
        let (head, whole) = head::read(&mut source).map_err(failed)?;
        let separator = options
            .separator
            .unwrap_or_else(|| separator::separator(&head[..whole]));
        let source: Box<dyn Read> = Box::new(Cursor::new(head).chain(source));
        let reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .delimiter(separator.byte())
            .has_headers(false)
            .flexible(true)
            .from_reader(LineEnds::new(source));
        let lines = Lines {
            path: path.to_owned(),
            reader,
            separator,
            skipped,
            count,
        };
        Self::read_header(lines, *options)
    }

    fn read_header(mut lines: Lines, options: TextOptions) -> Result<Self, FileError> {
        let mut first = ByteRecord::new();
        if !lines.read(&mut first)? {
            return Err(FileError::in_file(&lines.path, RecordingError::Empty));
        }
        let first_line = lines.line();
        let mut text = Self {
            options,
            found: Vec::new(),
            cells: separator::cells(&first, lines.separator).count(),
            pending: None,
            lines,
        };
        let header: Vec<String> = separator::cells(&first, text.lines.separator)
            .map(|cell| decode::characters(cell.trim_ascii()).into_owned())
            .collect();
        let has_header = match options.header {
            Some(has_header) => has_header,
            None => header::is_header(&header)
                .map_err(|error| FileError::in_line(&text.lines.path, first_line, error))?,
        };
        if !has_header {
            text.found = vec![Found::default(); text.cells];
            text.pending = Some((first, first_line));
            return Ok(text);
        }
        text.found = header.iter().map(|cell| header::found(cell)).collect();
        let mut second = ByteRecord::new();
        if text.lines.read(&mut second)? {
            let line = text.lines.line();
            let cells = separator::cells(&second, text.lines.separator);
            if let Some(units) = header::units(cells) {
                for (found, unit) in text.found.iter_mut().zip(units) {
                    found.unit = Some(unit).filter(|u| !u.is_empty()).or(found.unit.take());
                }
            } else {
                text.pending = Some((second, line));
            }
        }
        Ok(text)
    }

    /// The columns.
    pub(super) fn found(&self) -> &[Found] {
        &self.found
    }

    /// The rows with the columns of `indices`.
    pub(super) fn rows(self, indices: &[usize]) -> Result<TextRows, FileError> {
        TextRows::new(self, indices)
    }
}

impl Lines {
    fn read(&mut self, record: &mut ByteRecord) -> Result<bool, FileError> {
        self.reader
            .read_byte_record(record)
            .map_err(|error| match error.into_kind() {
                csv::ErrorKind::Io(error) => FileError::read(&self.path, error),
                other => FileError::in_file(&self.path, RecordingError::Text(format!("{other:?}"))),
            })
    }

    /// Line of the record read last.
    fn line(&self) -> u64 {
        let (position, source) = (self.reader.position(), self.reader.get_ref());
        self.skipped + position.line() - u64::from(source.has_passed_line_feed(position.byte()))
    }
}
