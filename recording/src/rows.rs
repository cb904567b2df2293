//! Rows of a recording in SI units, from any file format.

use std::hint::black_box;
use std::io;
use std::path::{Path, PathBuf};

use super::error::RecordingError;
use super::gaps::{Gaps, Intervals};
use super::location::{LeftOut, RowLocation};
use super::notes::{Interpolation, UnfinishedEnd};
use super::select::SelectedChannel;
use dashpot_files::FileError;

/// Source of rows: numbers of the selected channels in the units of the file; missing values are not finite.
pub(super) trait Source {
    /// Reads the next row into `values`; returns `false` at the end.
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError>;

    /// Returns the error for a value of the last row that is not finite, given its index.
    fn missing(&self, index: usize) -> RecordingError;

    /// Location of the last row.
    fn location(&self) -> RowLocation;

    /// Number of bytes read so far, for a progress bar.
    fn position(&self) -> u64;

    /// Number of the last line if the text was read to its end and does not end with a line end. The last number of
    /// this line may be cut off.
    fn unended_line(&self) -> Option<u64> {
        None
    }

    /// End of the rows if the file is an unfinished MDF4 file.
    fn unfinished(&self) -> Option<UnfinishedEnd> {
        None
    }

    /// How the force of another group was brought to the times of these rows.
    fn interpolation(&self) -> Option<Interpolation> {
        None
    }
}

/// Rows of `N` channels. The first channel is the time, which must increase.
pub(super) struct Rows<const N: usize> {
    path: PathBuf,
    source: Box<dyn Source>,
    names: [String; N],
    chosen: [SelectedChannel; N],
    skip_invalid: bool,
    left_out: LeftOut,
    last_time_s: Option<f64>,
    intervals: Intervals,
}

impl<const N: usize> Rows<N> {
    pub(super) fn new(
        path: &Path,
        source: Box<dyn Source>,
        names: [String; N],
        chosen: [SelectedChannel; N],
        skip_invalid: bool,
    ) -> Self {
        Self {
            path: path.to_owned(),
            source,
            names,
            chosen,
            skip_invalid,
            left_out: LeftOut::default(),
            last_time_s: None,
            intervals: Intervals::new(),
        }
    }

    /// Returns the next row in SI units; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<[f64; N]>, FileError> {
        let mut numbers = [0.0; N];
        let row = loop {
            if !self.source.next(&mut numbers)? {
                return match self.last_time_s {
                    None => Err(self.in_file(RecordingError::NoRow {
                        left_out: self.left_out.rows,
                    })),
                    Some(_) => Ok(None),
                };
            }
            // Converts the numbers one by one. Copying the array as a whole would stall until the source has written
            // each of its numbers.
            let row: [f64; N] =
                std::array::from_fn(|index| self.chosen[index].in_si(black_box(numbers[index])));
            match row.iter().position(|value| !value.is_finite()) {
                None => break row,
                Some(_) if self.skip_invalid => {
                    self.left_out.rows += 1;
                    self.left_out.first.get_or_insert(self.source.location());
                }
                Some(index) => return Err(self.in_cell(index, self.source.missing(index))),
            }
        };
        let time_s = row[0];
        if let Some(before_s) = self.last_time_s {
            if time_s <= before_s {
                return Err(self.in_time(RecordingError::Time { time_s, before_s }));
            }
            self.intervals
                .add(before_s, time_s, || self.source.location());
        }
        self.last_time_s = Some(time_s);
        Ok(Some(row))
    }

    /// Returns all remaining rows, each converted by `convert`.
    pub(super) fn read_all<T>(
        &mut self,
        convert: impl Fn([f64; N]) -> T,
    ) -> Result<Vec<T>, FileError> {
        let mut kept = Vec::new();
        while let Some(row) = self.next()? {
            kept.try_reserve(1)
                .map_err(|_| FileError::read(&self.path, io::ErrorKind::OutOfMemory.into()))?;
            kept.push(convert(row));
        }
        Ok(kept)
    }

    pub(super) fn position(&self) -> u64 {
        self.source.position()
    }

    pub(super) fn gaps(&self) -> Gaps {
        Gaps {
            unended_line: self.source.unended_line(),
            unfinished: self.source.unfinished(),
            interpolation: self.source.interpolation(),
            ..self.intervals.gaps(self.left_out)
        }
    }

    pub(super) fn in_file(&self, error: RecordingError) -> FileError {
        FileError::in_file(&self.path, error)
    }

    pub(super) fn in_time(&self, error: RecordingError) -> FileError {
        self.in_cell(0, error)
    }

    fn in_cell(&self, index: usize, error: RecordingError) -> FileError {
        self.source
            .location()
            .error(&self.path, &self.names[index], error)
    }
}

impl RowLocation {
    /// Returns `error` as an error of the channel `name` in the file at `path`.
    pub(super) fn error(self, path: &Path, name: &str, error: RecordingError) -> FileError {
        match self {
            Self::Line(line) => FileError::in_cell(path, line, name, error),
            Self::Row(row) => FileError::in_row(path, row, name, error),
        }
    }
}
