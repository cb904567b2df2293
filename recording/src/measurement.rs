//! Recorded motion with the measured force.

use std::io::Read;
use std::path::Path;
use std::rc::Rc;

use super::channels::Channels;
use super::open::{Origin, open_rows};
use super::rows::Rows;
use super::unit::Quantity;
use super::{Gaps, RecordingError, samples};
use dashpot_files::FileError;

/// One row of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredSample {
    /// Time (s).
    pub time_s: f64,
    /// Relative displacement of the damper's two ends (m), positive in extension.
    pub displacement_m: f64,
    /// Force (N), positive in extension.
    pub force_n: f64,
}

impl MeasuredSample {
    fn from_row([time_s, displacement_m, force_n]: [f64; 3]) -> Self {
        Self {
            time_s,
            displacement_m,
            force_n,
        }
    }
}

/// Quantities of a row.
const QUANTITIES: [Quantity; 3] = [Quantity::Time, Quantity::Displacement, Quantity::Force];

/// Displacement and force over time, read row by row in bounded memory from the same file formats as a
/// [`Recording`](super::Recording).
pub struct Measurement {
    rows: Rows<3>,
}

impl Measurement {
    /// Opens the file at `path` (`-` for standard input).
    ///
    /// # Errors
    /// Same errors as [`Recording::open_with`](super::Recording::open_with).
    pub fn open(path: &Path, channels: &Channels) -> Result<Self, FileError> {
        Self::from_origin(Origin::Path(path), channels)
    }

    /// Reads a measurement from `source`; errors name it `path`.
    ///
    /// # Errors
    /// Same errors as [`Measurement::open`].
    pub fn read(
        path: &Path,
        source: Box<dyn Read>,
        channels: &Channels,
    ) -> Result<Self, FileError> {
        Self::from_origin(Origin::Stream(path, source), channels)
    }

    /// Creates a measurement from samples in memory; errors name it `path`.
    pub fn from_samples(path: &Path, samples: Rc<Vec<MeasuredSample>>) -> Self {
        let row = |sample: &MeasuredSample| [sample.time_s, sample.displacement_m, sample.force_n];
        let samples = Box::new(samples::Samples::new(samples, row));
        let names = QUANTITIES.map(|quantity| quantity.column().to_owned());
        let channels = samples::si_channels(QUANTITIES);
        let rows = Rows::new(path, samples, names, channels, false);
        Self { rows }
    }

    fn from_origin(origin: Origin<'_>, channels: &Channels) -> Result<Self, FileError> {
        let rows = open_rows(origin, channels, QUANTITIES)?;
        Ok(Self { rows })
    }

    /// Returns the next row; `None` at the end.
    ///
    /// # Errors
    /// Same errors as [`Recording::next_sample`](super::Recording::next_sample).
    pub fn next_sample(&mut self) -> Result<Option<MeasuredSample>, FileError> {
        Ok(self.rows.next()?.map(MeasuredSample::from_row))
    }

    /// Returns all remaining rows.
    ///
    /// # Errors
    /// Same errors as [`Measurement::next_sample`].
    pub fn read_all(&mut self) -> Result<Vec<MeasuredSample>, FileError> {
        self.rows.read_all(MeasuredSample::from_row)
    }

    /// Number of bytes read so far, for a progress bar.
    pub fn position(&self) -> u64 {
        self.rows.position()
    }

    /// Returns the gaps among the rows read so far, and the omitted rows.
    pub fn gaps(&self) -> Gaps {
        self.rows.gaps()
    }

    /// Returns `error` as an error of the whole file.
    pub(crate) fn in_file(&self, error: RecordingError) -> FileError {
        self.rows.in_file(error)
    }

    /// Returns `error` as an error in the time of the last row read.
    pub(crate) fn in_time(&self, error: RecordingError) -> FileError {
        self.rows.in_time(error)
    }
}
