//! Text: CSV and what else loggers call so.

mod decode;
mod head;
mod header;
mod line_ends;
mod number;
mod options;
mod rows;
mod separator;

use std::io::{self, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use csv::{ByteRecord, Reader, ReaderBuilder};
#[cfg(feature = "parquet")]
pub(super) use header::found;
use line_ends::LineEnds;
pub use options::{DecimalMark, Separator, TextOptions};
use rows::TextRows;

use super::error::RecordingError;
use super::opened::Opened;
use super::rows::Source;
use super::select::Found;
use super::stream::{Count, Stream};
use dashpot_files::FileError;

/// A text whose columns are known and whose rows are still to be read.
pub(super) struct Text {
    path: PathBuf,
    /// Until they are read.
    lines: Option<Lines>,
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
    /// Bytes up to the end of the record read last.
    end: u64,
    /// Whether there is no record after it, and no line end.
    is_unended: bool,
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
            end: 0,
            is_unended: false,
        };
        Self::read_header(lines, *options)
    }

    fn read_header(mut lines: Lines, options: TextOptions) -> Result<Self, FileError> {
        let mut first = ByteRecord::new();
        if !lines.read(&mut first)? {
            return Err(FileError::in_file(&lines.path, RecordingError::Empty));
        }
        let first_line = lines.line();
        let cells = separator::cells(&first, lines.separator);
        let header: Vec<String> = cells
            .map(|cell| decode::characters(cell.trim_ascii()).into_owned())
            .collect();
        let has_header = match options.header {
            Some(has_header) => has_header,
            None => header::is_header(&header)
                .map_err(|error| FileError::in_line(&lines.path, first_line, error))?,
        };
        let (mut found, mut pending) = (Vec::new(), None);
        if has_header {
            found.extend(header.iter().map(|cell| header::found(cell)));
            let mut second = ByteRecord::new();
            if lines.read(&mut second)? {
                let line = lines.line();
                match header::units(separator::cells(&second, lines.separator)) {
                    Some(units) => header::take_units(&mut found, units),
                    None => pending = Some((second, line)),
                }
            }
        } else {
            found.resize(header.len(), header::found(""));
            pending = Some((first, first_line));
        }
        Ok(Self {
            path: lines.path.clone(),
            cells: header.len(),
            lines: Some(lines),
            options,
            found,
            pending,
        })
    }
}

impl Opened for Text {
    fn found(&self) -> &[Found] {
        &self.found
    }

    fn groups(&self) -> &[String] {
        &[]
    }

    fn rows(&mut self, indices: &[usize], lenient: bool) -> Result<Box<dyn Source>, FileError> {
        let lines = self.lines.take().ok_or_else(|| {
            let reason = io::Error::other("it was read already");
            FileError::read(&self.path, reason)
        })?;
        Ok(Box::new(TextRows::new(self, lines, indices, lenient)))
    }
}

impl Lines {
    fn read(&mut self, record: &mut ByteRecord) -> Result<bool, FileError> {
        let read = self.reader.read_byte_record(record);
        match read {
            Ok(true) => self.end = self.reader.position().byte(),
            Ok(false) => self.is_unended = self.reader.get_ref().ends_unended(self.end),
            Err(_) => {}
        }
        read.map_err(|error| match error.into_kind() {
            csv::ErrorKind::Io(error) => FileError::read(&self.path, error),
            other => FileError::in_file(&self.path, RecordingError::Text(format!("{other:?}"))),
        })
    }

    /// Line of the record read last, where there is none after it and it has no line end.
    fn unended_line(&self) -> Option<u64> {
        self.is_unended.then(|| self.line())
    }

    /// Line of the record read last.
    fn line(&self) -> u64 {
        let (position, source) = (self.reader.position(), self.reader.get_ref());
        self.skipped + position.line() - u64::from(source.has_passed_line_feed(position.byte()))
    }
}
