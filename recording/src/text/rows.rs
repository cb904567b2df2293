//! Rows of a text file.

use csv::ByteRecord;

use super::instant::Instants;
use super::number::{NotNumber, Numbers};
use super::plain_row::PlainRows;
use super::title::COMMENT;
use super::{Lines, PendingRow, Text, decode};
use crate::error::RecordingError;
use crate::location::RowLocation;
use crate::rows::Source;
use crate::select;
use crate::text_options::Separator;
use dashpot_files::FileError;

/// Numbers of the selected columns, row by row.
pub(super) struct TextRows {
    lines: Lines,
    names: Vec<String>,
    columns: Vec<usize>,
    cells: usize,
    /// One parser for all columns, or one per column if `lenient`.
    numbers: Vec<Numbers>,
    /// Times with dates; `None` for a column of numbers.
    instants: Vec<Option<Instants>>,
    /// True if rows may leave out the last cell with its separator.
    may_lack_last: bool,
    lenient: bool,
    /// Parser of plain rows; `None` if the CSV reader reads all rows.
    plain: Option<PlainRows>,
    record: ByteRecord,
    /// Line of the record that was read with the header; `None` once that record has been returned.
    pending_line: Option<u64>,
    /// Line of the current record if it was read with the header.
    line_read_before: Option<u64>,
}

impl TextRows {
    pub(super) fn new(text: &mut Text, lines: Lines, indices: &[usize], lenient: bool) -> Self {
        let name = |index: &usize| select::label(&text.found, *index);
        let names = indices.iter().map(name).collect();
        let (record, pending_line) = match text.pending.take() {
            Some(PendingRow { record, line }) => (record, Some(line)),
            None => (ByteRecord::new(), None),
        };
        let separator = lines.separator;
        let is_instant =
            |index: &usize| text.found.get(*index).is_some_and(|found| found.is_instant);
        let instants: Vec<Option<Instants>> = indices
            .iter()
            .map(|index| is_instant(index).then(Instants::default))
            .collect();
        let has_instant = instants.iter().any(Option::is_some);
        Self {
            may_lack_last: text.found.last().is_some_and(|last| last.name == COMMENT),
            instants,
            plain: (!lenient && !has_instant)
                .then(|| PlainRows::new(separator, text.cells, indices))
                .flatten(),
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
            line_read_before: None,
        }
    }

    fn cell(&self, index: usize) -> &[u8] {
        let column = self.columns[index];
        let cell = match self.lines.separator {
            Separator::Spaces => self.record.iter().filter(|c| !c.is_empty()).nth(column),
            _ => self.record.get(column),
        };
        // Trimming in the CSV reader would double its cost.
        cell.unwrap_or_default().trim_ascii()
    }

    /// Checks that the row has as many cells as the header. A separator at the end is allowed.
    fn check_length(&self) -> Result<(), FileError> {
        let cells = match self.lines.separator {
            Separator::Spaces => self.record.iter().filter(|c| !c.is_empty()).count(),
            _ => self.record.len(),
        };
        let has_separator_at_end =
            cells == self.cells + 1 && self.record.get(self.cells).is_some_and(<[u8]>::is_empty);
        let lacks_last = self.may_lack_last && cells + 1 == self.cells;
        if cells == self.cells || has_separator_at_end || lacks_last {
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
        self.line_read_before.unwrap_or_else(|| self.lines.line())
    }

    /// Returns the text of a cell for messages, cut to 40 bytes.
    fn cell_text(&self, index: usize) -> String {
        let cell = self.cell(index);
        decode::characters(&cell[..cell.len().min(40)]).into_owned()
    }
}

impl Source for TextRows {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        self.line_read_before = self.pending_line.take();
        if self.line_read_before.is_none()
            && let Some(plain) = &self.plain
            && self.lines.read_plain(plain, &mut self.numbers[0], values)
        {
            return Ok(true);
        }
        if self.line_read_before.is_none() && !self.lines.read(&mut self.record)? {
            return Ok(false);
        }
        self.check_length()?;
        for (index, value) in values.iter_mut().enumerate() {
            if let Some(mut instants) = self.instants[index] {
                *value = match instants.parse(self.cell(index)) {
                    Some(time_s) => time_s,
                    None if self.lenient => f64::NAN,
                    None => {
                        let cell = self.cell_text(index);
                        let error = RecordingError::Instant { cell };
                        let (path, name) = (&self.lines.path, &self.names[index]);
                        return Err(self.location().error(path, name, error));
                    }
                };
                self.instants[index] = Some(instants);
                continue;
            }
            let parser = if self.lenient { index } else { 0 };
            let mut numbers = self.numbers[parser];
            *value = match numbers.parse(self.cell(index)) {
                Ok(number) => number,
                Err(_) if self.lenient => f64::NAN,
                Err(reason) => {
                    let cell = self.cell_text(index);
                    let error = match reason {
                        NotNumber::Text => RecordingError::Number { cell },
                        NotNumber::OtherMark(mark) => RecordingError::Mark { cell, mark },
                    };
                    let (path, name) = (&self.lines.path, &self.names[index]);
                    return Err(self.location().error(path, name, error));
                }
            };
            self.numbers[parser] = numbers;
        }
        Ok(true)
    }

    fn missing(&self, index: usize) -> RecordingError {
        RecordingError::NotFinite {
            cell: self.cell_text(index),
        }
    }

    fn location(&self) -> RowLocation {
        RowLocation::Line(self.line())
    }

    fn position(&self) -> u64 {
        self.lines.count.get()
    }

    fn unended_line(&self) -> Option<u64> {
        self.lines.unended_line()
    }
}
