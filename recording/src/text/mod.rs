//! Text files: CSV and similar formats of loggers.

mod blocks;
mod decimal;
mod decode;
mod head;
mod header;
mod instant;
mod number;
mod plain_row;
mod rows;
mod separator;
mod title;

use std::io::{self, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use blocks::Blocks;
use csv::{ByteRecord, Reader, ReaderBuilder};
#[cfg(feature = "parquet")]
pub(super) use header::column_from_header;
use number::Numbers;
use plain_row::PlainRows;
use rows::TextRows;

use super::error::RecordingError;
use super::recording_file::RecordingFile;
use super::rows::Source;
use super::select::ChannelInfo;
use super::stream::{Count, Stream};
use super::text_options::{Separator, TextOptions};
use dashpot_files::FileError;

/// A text file with known columns and unread rows.
pub(super) struct Text {
    path: PathBuf,
    /// `None` once the rows are being read.
    lines: Option<Lines>,
    options: TextOptions,
    found: Vec<ChannelInfo>,
    /// Number of cells per row.
    cells: usize,
    /// First row, if it was read while looking for the header.
    pending: Option<PendingRow>,
}

/// A row that was read before the other rows.
struct PendingRow {
    record: ByteRecord,
    /// Line of the row, from 1.
    line: u64,
}

/// Records of the text and their line numbers.
struct Lines {
    path: PathBuf,
    reader: Reader<Blocks<Box<dyn Read>>>,
    separator: Separator,
    /// Number of skipped lines before the first line of the reader.
    skipped: u64,
    count: Count,
    /// Position, in bytes, of the end of the record read last by the reader.
    end: u64,
    /// True if the record read last is the last one of the text and has no line end.
    is_unended: bool,
}

impl Text {
    /// Finds the columns of a text; errors name it `path`.
    ///
    /// # Errors
    /// Returns an error if the text is empty, or if its first line could be either a header or a row of numbers.
    pub(super) fn open(
        path: &Path,
        stream: Stream,
        options: &TextOptions,
    ) -> Result<Self, FileError> {
        let count = stream.count();
        let failed = |error| FileError::read(path, error);
        let mut source = BufReader::new(decode::decoded(stream, options.encoding));
        let skipped = head::skip_lines(&mut source, options.skip_lines).map_err(failed)?;
        let head = head::read(&mut source).map_err(failed)?;
        if options.skip_lines == 0 {
            title::check(head.whole_lines(), options.separator)
                .map_err(|error| FileError::in_file(path, error))?;
        }
        let separator = options
            .separator
            .unwrap_or_else(|| separator::separator(head.whole_lines()));
        let source: Box<dyn Read> = Box::new(Cursor::new(head.bytes).chain(source));
        let reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .delimiter(separator.byte())
            .has_headers(false)
            .flexible(true)
            .from_reader(Blocks::new(source));
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
            found.extend(header.iter().map(|cell| header::column_from_header(cell)));
            let mut second = ByteRecord::new();
            if lines.read(&mut second)? {
                let line = lines.line();
                match header::units(separator::cells(&second, lines.separator)) {
                    Some(units) => {
                        header::set_units(&mut found, units);
                        // The first row decides which columns are times with dates.
                        if lines.read(&mut second)? {
                            pending = Some(PendingRow {
                                line: lines.line(),
                                record: second,
                            });
                        }
                    }
                    None => {
                        pending = Some(PendingRow {
                            record: second,
                            line,
                        });
                    }
                }
            }
        } else {
            found.resize(header.len(), header::column_from_header(""));
            pending = Some(PendingRow {
                record: first,
                line: first_line,
            });
        }
        if let Some(row) = &pending {
            let cells = separator::cells(&row.record, lines.separator);
            header::set_instants(&mut found, cells);
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

impl RecordingFile for Text {
    fn found(&self) -> &[ChannelInfo] {
        &self.found
    }

    fn groups(&self) -> &[String] {
        &[]
    }

    fn rows(&mut self, indices: &[usize], lenient: bool) -> Result<Box<dyn Source>, FileError> {
        let lines = self.lines.take().ok_or_else(|| {
            let reason =
                io::Error::other("the rows of this text have already been read; open it again");
            FileError::read(&self.path, reason)
        })?;
        Ok(Box::new(TextRows::new(self, lines, indices, lenient)))
    }
}

impl Lines {
    fn read(&mut self, record: &mut ByteRecord) -> Result<bool, FileError> {
        let read = self.reader.read_byte_record(record);
        match read {
            Ok(true) => self.end = self.reader.get_ref().position(),
            Ok(false) => {
                let blocks = self.reader.get_ref();
                self.is_unended = blocks.position() == self.end && blocks.is_within_line();
            }
            Err(_) => {}
        }
        read.map_err(|error| match error.into_kind() {
            csv::ErrorKind::Io(error) => FileError::read(&self.path, error),
            other => FileError::in_file(&self.path, RecordingError::Text(format!("{other:?}"))),
        })
    }

    /// Line of the record read last, if the file ends after it without a line end.
    fn unended_line(&self) -> Option<u64> {
        self.is_unended.then(|| self.line())
    }

    /// Reads the next row into `values` if it is plain; `false` leaves it to [`Lines::read`].
    #[inline]
    fn read_plain(&mut self, rows: &PlainRows, numbers: &mut Numbers, values: &mut [f64]) -> bool {
        let blocks = self.reader.get_mut();
        let Some(row) = blocks
            .whole_lines()
            .and_then(|text| rows.parse(text, numbers.mark(), values))
        else {
            return false;
        };
        if row.has_mark {
            numbers.keep_mark();
        }
        blocks.advance(row.length);
        true
    }

    /// Line of the row read last.
    fn line(&self) -> u64 {
        self.skipped + self.reader.get_ref().line()
    }
}
