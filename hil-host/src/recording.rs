//! Recorded motion as a logger writes it: time and displacement, uneven, with gaps.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use csv::{ByteRecord, Reader, ReaderBuilder};

use crate::failure::{Failure, Outcome};

/// The columns a recording must have; others are passed over.
const COLUMNS: [&str; 2] = ["time_s", "displacement_m"];

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
    reader: Reader<Box<dyn Read>>,
    columns: [usize; 2],
    record: ByteRecord,
    last_time_s: Option<f64>,
}

impl Recording {
    /// Opens the recording at `path` and reads its header.
    ///
    /// # Errors
    /// No readable file, an empty one, or a column that is missing or doubled.
    pub fn open(path: &Path) -> Outcome<Self> {
        let cannot =
            |error: &dyn std::fmt::Display| Failure::in_file(path, format!("cannot read: {error}"));
        let file = File::open(path).map_err(|error| cannot(&error))?;
        if file.metadata().map_err(|error| cannot(&error))?.is_dir() {
            return Err(cannot(&"it is a folder"));
        }
        Self::read(path, Box::new(file))
    }

    /// A recording from `source`, called `path` in errors.
    ///
    /// # Errors
    /// As [`Recording::open`].
    pub fn read(path: &Path, source: Box<dyn Read>) -> Outcome<Self> {
        let mut reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::Headers)
            .from_reader(source);
        let header = reader
            .byte_headers()
            .map_err(|error| explain(path, &error))?
            .clone();
        if header.is_empty() {
            return Err(Failure::in_file(
                path,
                "empty; a header `time_s,displacement_m` and at least one row are needed",
            ));
        }
        let columns = [
            column(path, &header, COLUMNS[0])?,
            column(path, &header, COLUMNS[1])?,
        ];
        Ok(Self {
            path: path.to_owned(),
            reader,
            columns,
            record: ByteRecord::new(),
            last_time_s: None,
        })
    }

    /// The next row; `None` at the end.
    ///
    /// # Errors
    /// A cell that is no finite number, a row of other length, or time that does not grow; with line
    /// and column.
    pub fn next_sample(&mut self) -> Outcome<Option<Sample>> {
        let more = self
            .reader
            .read_byte_record(&mut self.record)
            .map_err(|error| explain(&self.path, &error))?;
        if !more {
            if self.last_time_s.is_none() {
                return Err(Failure::in_file(&self.path, "no row after the header"));
            }
            return Ok(None);
        }
        let time_s = self.number(0)?;
        let displacement_m = self.number(1)?;
        if let Some(last) = self.last_time_s
            && time_s <= last
        {
            return Err(self.in_time(format!(
                "time {time_s} s does not grow; the row before has {last} s"
            )));
        }
        self.last_time_s = Some(time_s);
        Ok(Some(Sample {
            time_s,
            displacement_m,
        }))
    }

    /// All rows left.
    ///
    /// # Errors
    /// As [`Recording::next_sample`].
    pub fn read_all(mut self) -> Outcome<Vec<Sample>> {
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

    /// A failure of the time in the row read last.
    pub(crate) fn in_time(&self, message: String) -> Failure {
        self.in_cell(0, message)
    }

    fn number(&self, column: usize) -> Outcome<f64> {
        // Trimming in the reader would cost as much again as all of its reading.
        let cell = self.record.get(self.columns[column]).unwrap_or_default();
        let cell = cell.trim_ascii();
        let text = std::str::from_utf8(cell).ok();
        match text.and_then(|text| text.parse::<f64>().ok()) {
            Some(number) if number.is_finite() => Ok(number),
            _ => Err(self.in_cell(
                column,
                format!(
                    "`{}` is not a finite number",
                    String::from_utf8_lossy(&cell[..cell.len().min(40)])
                ),
            )),
        }
    }

    fn in_cell(&self, column: usize, message: String) -> Failure {
        let line = self.record.position().map_or(0, csv::Position::line);
        Failure::in_cell(&self.path, line, COLUMNS[column], message)
    }
}

fn column(path: &Path, header: &ByteRecord, name: &str) -> Outcome<usize> {
    let found: Vec<usize> = (0..header.len())
        .filter(|&index| &header[index] == name.as_bytes())
        .collect();
    let listed = || {
        let header = String::from_utf8_lossy(header.as_slice()).into_owned();
        header.chars().take(80).collect::<String>()
    };
    match found[..] {
        [index] => Ok(index),
        [] => Err(Failure::in_file(
            path,
            format!(
                "column {name} is missing from the header (found `{}`); the header names \
                 time_s and displacement_m",
                listed().escape_debug()
            ),
        )),
        _ => Err(Failure::in_file(
            path,
            format!("column {name} is in the header {} times", found.len()),
        )),
    }
}

fn explain(path: &Path, error: &csv::Error) -> Failure {
    match error.kind() {
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => Failure::in_file(
            path,
            format!(
                "line {}: {len} cells where the header has {expected_len}",
                pos.as_ref().map_or(0, csv::Position::line)
            ),
        ),
        _ => Failure::in_file(path, format!("cannot read: {error}")),
    }
}
