//! Rows of a recording and of a measurement.

use crate::{Measurement, Recording, RecordingError};
use dashpot_files::FileError;

/// One row: a time and `N` values.
#[derive(Clone, Copy)]
pub(super) struct Row<const N: usize> {
    pub(super) time_s: f64,
    pub(super) values: [f64; N],
}

/// Source of rows with `N` values.
pub(super) trait Rows<const N: usize> {
    fn next_row(&mut self) -> Result<Option<Row<N>>, FileError>;
    fn in_file(&self, error: RecordingError) -> FileError;
    fn in_time(&self, error: RecordingError) -> FileError;
}

impl Rows<1> for Recording {
    fn next_row(&mut self) -> Result<Option<Row<1>>, FileError> {
        let sample = self.next_sample()?;
        Ok(sample.map(|sample| Row {
            time_s: sample.time_s,
            values: [sample.displacement_m],
        }))
    }

    fn in_file(&self, error: RecordingError) -> FileError {
        Recording::in_file(self, error)
    }

    fn in_time(&self, error: RecordingError) -> FileError {
        Recording::in_time(self, error)
    }
}

impl Rows<2> for Measurement {
    fn next_row(&mut self) -> Result<Option<Row<2>>, FileError> {
        let sample = self.next_sample()?;
        Ok(sample.map(|sample| Row {
            time_s: sample.time_s,
            values: [sample.displacement_m, sample.force_n],
        }))
    }

    fn in_file(&self, error: RecordingError) -> FileError {
        Measurement::in_file(self, error)
    }

    fn in_time(&self, error: RecordingError) -> FileError {
        Measurement::in_time(self, error)
    }
}
