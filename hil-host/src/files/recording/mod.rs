//! Recorded motion as a logger writes it: time and displacement, uneven, with gaps. Forces over time are read likewise.

mod error;
mod force_history;
mod gaps;
mod header;
mod line_ends;

use std::io::Read;
use std::path::{Path, PathBuf};

use csv::{ByteRecord, Reader, ReaderBuilder};
pub(crate) use error::MOST_TICKS;
pub use error::RecordingError;
pub use force_history::ForceHistory;
use gaps::Intervals;
pub use gaps::{GAP_IN_MEDIANS, Gap, Gaps};
use header::{MOTION, Names};
use line_ends::LineEnds;

use crate::files::{FileError, input};

/// One row of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub time_s: f64,
    /// Relative displacement of the seats (m), positive in extension.
    pub displacement_m: f64,
}

/// A recording read row by row in bounded memory: CSV with a header, `#` comment lines, LF or CRLF, with
/// or without byte order mark, columns in any order.
pub struct Recording {
    path: PathBuf,
    reader: Reader<LineEnds<Box<dyn Read>>>,
    names: Names,
    columns: [usize; 2],
    record: ByteRecord,
    last_time_s: Option<f64>,
    intervals: Intervals,
}

impl Recording {
    /// Opens the recording at `path`, `-` being standard input, and reads its header.
    ///
    /// # Errors
    /// No readable file, an empty one, or a column that is missing or doubled.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        Self::read(&input::name(path), input::open(path)?)
    }

    /// A recording from `source`, called `path` in errors.
    ///
    /// # Errors
    /// As [`Recording::open`].
    pub fn read(path: &Path, source: Box<dyn Read>) -> Result<Self, FileError> {
        Self::read_columns(path, source, MOTION)
    }

    /// As [`Recording::read`], of columns of other names.
    fn read_columns(path: &Path, source: Box<dyn Read>, names: Names) -> Result<Self, FileError> {
        let mut reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::Headers)
            .from_reader(LineEnds::new(source));
        let columns = header::columns(path, &mut reader, names)?;
        Ok(Self {
            path: path.to_owned(),
            reader,
            names,
            columns,
            record: ByteRecord::new(),
            last_time_s: None,
            intervals: Intervals::new(),
        })
    }

    /// The next row; `None` at the end.
    ///
    /// # Errors
    /// A cell that is no finite number, a row of other length, or time that does not grow; with line
    /// and column.
    pub fn next_sample(&mut self) -> Result<Option<Sample>, FileError> {
        let row = self.next_row()?;
        Ok(row.map(|[time_s, displacement_m]| Sample {
            time_s,
            displacement_m,
        }))
    }

    /// Time (s) and value of the next row.
    fn next_row(&mut self) -> Result<Option<[f64; 2]>, FileError> {
        let more = self
            .reader
            .read_byte_record(&mut self.record)
            .map_err(|error| self.explain(error))?;
        if !more {
            if self.last_time_s.is_none() {
                return Err(self.in_text(RecordingError::NoRow));
            }
            return Ok(None);
        }
        let time_s = self.number(0)?;
        let value = self.number(1)?;
        if let Some(before_s) = self.last_time_s {
            if time_s <= before_s {
                return Err(self.in_time(RecordingError::Time { time_s, before_s }));
            }
            self.intervals.add(before_s, time_s, self.line());
        }
        self.last_time_s = Some(time_s);
        Ok(Some([time_s, value]))
    }

    /// All rows left.
    ///
    /// # Errors
    /// As [`Recording::next_sample`].
    pub fn read_all(&mut self) -> Result<Vec<Sample>, FileError> {
        let mut samples = Vec::new();
        while let Some(sample) = self.next_sample()? {
            samples.push(sample);
        }
        Ok(samples)
    }

    /// Bytes read so far, for a progress bar.
    pub fn position(&self) -> u64 {
        self.reader.position().byte()
    }

    /// The gaps among the rows read so far.
    pub fn gaps(&self) -> Gaps {
        self.intervals.gaps()
    }

    /// `error` in the text as a whole.
    pub(crate) fn in_text(&self, error: RecordingError) -> FileError {
        FileError::in_file(&self.path, error)
    }

    /// `error` in the time of the row read last.
    pub(crate) fn in_time(&self, error: RecordingError) -> FileError {
        self.in_cell(0, error)
    }

    fn number(&self, column: usize) -> Result<f64, FileError> {
        // Trimming in the reader would cost as much again as all of its reading.
        let cell = self.record.get(self.columns[column]).unwrap_or_default();
        let cell = cell.trim_ascii();
        let text = std::str::from_utf8(cell).ok();
        match text.and_then(|text| text.parse::<f64>().ok()) {
            Some(number) if number.is_finite() => Ok(number),
            _ => {
                let with_point = text.map(|text| text.replacen(',', ".", 1).parse::<f64>());
                let error = RecordingError::Number {
                    cell: String::from_utf8_lossy(&cell[..cell.len().min(40)]).into(),
                    decimal_comma: matches!(with_point, Some(Ok(_))) && cell.contains(&b','),
                };
                Err(self.in_cell(column, error))
            }
        }
    }

    fn in_cell(&self, column: usize, error: RecordingError) -> FileError {
        FileError::in_cell(&self.path, self.line(), self.names[column], error)
    }

    /// Line of the row read last.
    fn line(&self) -> u64 {
        let (position, source) = (self.reader.position(), self.reader.get_ref());
        position.line() - u64::from(source.has_passed_line_feed(position.byte()))
    }

    /// The reader's `error` at the row read last.
    fn explain(&self, error: csv::Error) -> FileError {
        let error = match *error.kind() {
            csv::ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => RecordingError::Cells {
                line: self.line(),
                cells: len,
                expected: expected_len,
            },
            _ => error.into(),
        };
        self.in_text(error)
    }
}
