//! Rows of a recording in SI, from whatever file.

use std::hint::black_box;
use std::io;
use std::path::{Path, PathBuf};

use super::error::RecordingError;
use super::gaps::{Gaps, Intervals};
use super::place::{LeftOut, Place};
use super::select::Chosen;
use dashpot_files::FileError;

/// What gives rows: the numbers of the chosen channels in the units of the file, not finite where there are none.
pub(super) trait Source {
    /// Takes the next row into `values`; `false` at the end.
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError>;

    /// What is said of a value of the row taken last that is not finite.
    fn missing(&self, place: usize) -> RecordingError;

    /// Where the row taken last is.
    fn place(&self) -> Place;

    /// Bytes read so far, for a progress bar.
    fn position(&self) -> u64;

    /// The last line of a text that was read to its end, where that line has no line end and may be cut inside its last
    /// number.
    fn unended_line(&self) -> Option<u64> {
        None
    }
}

/// Rows of `N` channels, the first of which is the time, which grows.
pub(super) struct Rows<const N: usize> {
    path: PathBuf,
    source: Box<dyn Source>,
    names: [String; N],
    chosen: [Chosen; N],
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
        chosen: [Chosen; N],
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

    /// The next row in SI; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<[f64; N]>, FileError> {
        let mut numbers = [0.0; N];
        let row = loop {
            if !self.source.next(&mut numbers)? {
                return match self.last_time_s {
                    None => Err(self.in_text(RecordingError::NoRow {
                        left_out: self.left_out.rows,
                    })),
                    Some(_) => Ok(None),
                };
            }
            // Into an array of its own, one by one: a copy of all that the source wrote one by one would wait for its writes, which wait
            // for the step before.
            let row: [f64; N] =
                std::array::from_fn(|place| self.chosen[place].in_si(black_box(numbers[place])));
            match row.iter().position(|value| !value.is_finite()) {
                None => break row,
                Some(_) if self.skip_invalid => {
                    self.left_out.rows += 1;
                    self.left_out.first.get_or_insert(self.source.place());
                }
                Some(place) => return Err(self.in_cell(place, self.source.missing(place))),
            }
        };
        let time_s = row[0];
        if let Some(before_s) = self.last_time_s {
            if time_s <= before_s {
                return Err(self.in_time(RecordingError::Time { time_s, before_s }));
            }
            self.intervals.add(before_s, time_s, || self.source.place());
        }
        self.last_time_s = Some(time_s);
        Ok(Some(row))
    }

    /// All rows left, each as `of` has it.
    pub(super) fn read_all<T>(&mut self, of: impl Fn([f64; N]) -> T) -> Result<Vec<T>, FileError> {
        let mut kept = Vec::new();
        while let Some(row) = self.next()? {
            kept.try_reserve(1)
                .map_err(|_| FileError::read(&self.path, io::ErrorKind::OutOfMemory.into()))?;
            kept.push(of(row));
        }
        Ok(kept)
    }

    pub(super) fn position(&self) -> u64 {
        self.source.position()
    }

    pub(super) fn gaps(&self) -> Gaps {
        Gaps {
            unended_line: self.source.unended_line(),
            ..self.intervals.gaps(self.left_out)
        }
    }

    pub(super) fn in_text(&self, error: RecordingError) -> FileError {
        FileError::in_file(&self.path, error)
    }

    pub(super) fn in_time(&self, error: RecordingError) -> FileError {
        self.in_cell(0, error)
    }

    fn in_cell(&self, place: usize, error: RecordingError) -> FileError {
        self.source
            .place()
            .error(&self.path, &self.names[place], error)
    }
}

impl Place {
    /// `error` in the channel `name` of the file at `path`.
    pub(super) fn error(self, path: &Path, name: &str, error: RecordingError) -> FileError {
        match self {
            Self::Line(line) => FileError::in_cell(path, line, name, error),
            Self::Row(row) => FileError::in_row(path, row, name, error),
        }
    }
}
