//! Rows of a text.

use csv::ByteRecord;

use super::super::error::RecordingError;
use super::super::place::Place;
use super::super::rows::Source;
use super::number::{NotNumber, Numbers};
use super::options::Separator;
use super::{Lines, Text, decode};
use dashpot_files::FileError;

/// Numbers of the chosen columns, row by row.
pub(super) struct TextRows {
    lines: Lines,
    names: Vec<String>,
    columns: Vec<usize>,
    cells: usize,
    /// One for all columns, or one each where what is no number is let pass.
    numbers: Vec<Numbers>,
    lenient: bool,
    record: ByteRecord,
    /// Line of the record that was looked at before the rows are read, until it is taken.
    pending_line: Option<u64>,
    line_of_pending: Option<u64>,
}

impl TextRows {
    pub(super) fn new(text: &mut Text, lines: Lines, indices: &[usize], lenient: bool) -> Self {
        let name = |index: &usize| super::super::select::label(&text.found, *index);
        let names = indices.iter().map(name).collect();
        let (record, pending_line) = match text.pending.take() {
            Some((record, line)) => (record, Some(line)),
            None => (ByteRecord::new(), None),
        };
        Self {
            lines,
            names,
            columns: indices.to_vec(),
            cells: text.cells,
            numbers: vec![
                Numbers::new(text.options.decimal_mark);
                if lenient { indices.len() } else { 1 }
            ],
            lenient,
            record,
            pending_line,
            line_of_pending: None,
        }
    }

    fn cell(&self, place: usize) -> &[u8] {
        let column = self.columns[place];
        let cell = match self.lines.separator {
            Separator::Spaces => self.record.iter().filter(|c| !c.is_empty()).nth(column),
            _ => self.record.get(column),
        };
        // Trimming in the reader would cost as much again as all of its reading.
        cell.unwrap_or_default().trim_ascii()
    }

    /// Refuses a row with more or fewer cells than the header, but for a separator at its end.
    fn check_length(&self) -> Result<(), FileError> {
        let cells = match self.lines.separator {
            Separator::Spaces => self.record.iter().filter(|c| !c.is_empty()).count(),
            _ => self.record.len(),
        };
        let has_separator_at_end =
            cells == self.cells + 1 && self.record.get(self.cells).is_some_and(<[u8]>::is_empty);
        if cells == self.cells || has_separator_at_end {
            return Ok(());
        }
        let error = RecordingError::Cells {
            line: self.line(),
            cells: cells as u64,
            expected: self.cells as u64,
            separator: self.lines.separator,
        };
        Err(FileError::in_file(&self.lines.path, error))
    }

    fn line(&self) -> u64 {
        self.line_of_pending.unwrap_or_else(|| self.lines.line())
    }

    /// The cell's text, at most 40 bytes of it.
    fn shown(&self, place: usize) -> String {
        let cell = self.cell(place);
        decode::characters(&cell[..cell.len().min(40)]).into_owned()
    }
}

impl Source for TextRows {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        self.line_of_pending = self.pending_line.take();
        if self.line_of_pending.is_none() && !self.lines.read(&mut self.record)? {
            return Ok(false);
        }
        self.check_length()?;
        for (place, value) in values.iter_mut().enumerate() {
            let slot = if self.lenient { place } else { 0 };
            let mut numbers = self.numbers[slot];
            *value = match numbers.parse(self.cell(place)) {
                Ok(number) => number,
                Err(_) if self.lenient => f64::NAN,
                Err(what) => {
                    let cell = self.shown(place);
                    let error = match what {
                        NotNumber::Text => RecordingError::Number { cell },
                        NotNumber::OtherMark(mark) => RecordingError::Mark { cell, mark },
                    };
                    let (path, name) = (&self.lines.path, &self.names[place]);
                    return Err(self.place().error(path, name, error));
                }
            };
            self.numbers[slot] = numbers;
        }
        Ok(true)
    }

    fn missing(&self, place: usize) -> RecordingError {
        RecordingError::NotFinite {
            cell: self.shown(place),
        }
    }

    fn place(&self) -> Place {
        Place::Line(self.line())
    }

    fn position(&self) -> u64 {
        self.lines.count.get()
    }

    fn unended_line(&self) -> Option<u64> {
        self.lines.unended_line()
    }
}
