#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod channels;
#[cfg(feature = "parquet")]
pub mod columns;
pub mod digest;
mod error;
mod force_history;
mod gaps;
mod groups;
#[cfg(feature = "parquet")]
mod guarded;
mod interpolated;
mod location;
#[cfg(feature = "mdf")]
mod mdf;
mod measurement;
mod notes;
mod open;
mod overview;
#[cfg(feature = "parquet")]
mod parquet;
mod recording_file;
mod remedy;
mod rows;
mod samples;
mod select;
mod signals;
mod stream;
pub mod stretches;
#[cfg(feature = "parquet")]
pub(crate) mod sums;
pub mod table;
mod text;
mod text_options;
pub mod tick_grid;
mod unit;
pub mod writer;

use std::io::Read;
use std::path::Path;
use std::rc::Rc;

pub use channels::{Channel, Channels};
pub(crate) use error::{MAX_GAP_TICKS, MAX_TICKS};
pub use error::{RecordingError, remedy};
pub use force_history::ForceHistory;
pub use gaps::{GAP_IN_MEDIANS, Gap, Gaps};
pub use location::{LeftOut, RowLocation};
pub use measurement::{MeasuredSample, Measurement};
pub use notes::{Interpolation, UnfinishedEnd};
use open::{Origin, open_rows};
pub use overview::{ChannelOverview, Overview, TimeOverview, overview};
pub use remedy::Remedy;
use rows::Rows;
pub use signals::Signals;
pub use text_options::{DecimalMark, Separator, TextOptions};
pub use unit::{Quantity, Unit};

use dashpot_files::FileError;

/// One row of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub time_s: f64,
    /// Relative displacement of the damper's two ends (m), positive in extension.
    pub displacement_m: f64,
}

impl Sample {
    fn from_row([time_s, displacement_m]: [f64; 2]) -> Self {
        Self {
            time_s,
            displacement_m,
        }
    }
}

/// A recorded motion, read row by row in bounded memory. The first bytes of the file determine its format.
pub struct Recording {
    rows: Rows<2>,
}

impl Recording {
    /// Opens the recording at `path` (`-` for standard input) with the default channels `time_s` and `displacement_m`.
    ///
    /// # Errors
    /// Same errors as [`Recording::open_with`].
    pub fn open(path: &Path) -> Result<Self, FileError> {
        Self::open_with(path, &Channels::default())
    }

    /// Opens the recording at `path` (`-` for standard input) with the given channels.
    ///
    /// # Errors
    /// Returns an error if the file is unreadable, empty or in an unsupported format, if a channel is missing or
    /// ambiguous, or if its unit is unknown.
    pub fn open_with(path: &Path, channels: &Channels) -> Result<Self, FileError> {
        Self::from_origin(Origin::Path(path), channels)
    }

    /// Reads a recording from `source` with the default channels; errors name it `path`.
    ///
    /// # Errors
    /// Same errors as [`Recording::open_with`].
    pub fn read(path: &Path, source: Box<dyn Read>) -> Result<Self, FileError> {
        Self::read_with(path, source, &Channels::default())
    }

    /// Reads a recording from `source` with the given channels; errors name it `path`.
    ///
    /// # Errors
    /// Same errors as [`Recording::open_with`].
    pub fn read_with(
        path: &Path,
        source: Box<dyn Read>,
        channels: &Channels,
    ) -> Result<Self, FileError> {
        Self::from_origin(Origin::Stream(path, source), channels)
    }

    /// Creates a recording from samples in memory; errors name it `path`.
    pub fn from_samples(path: &Path, samples: Rc<Vec<Sample>>) -> Self {
        let quantities = [Quantity::Time, Quantity::Displacement];
        let names = quantities.map(|quantity| quantity.column().to_owned());
        let row = |sample: &Sample| [sample.time_s, sample.displacement_m];
        let samples = Box::new(samples::Samples::new(samples, row));
        let channels = samples::si_channels(quantities);
        let rows = Rows::new(path, samples, names, channels, false);
        Self { rows }
    }

    fn from_origin(origin: Origin<'_>, channels: &Channels) -> Result<Self, FileError> {
        let quantities = [Quantity::Time, Quantity::Displacement];
        let rows = open_rows(origin, channels, quantities)?;
        Ok(Self { rows })
    }

    /// Returns the next row; `None` at the end.
    ///
    /// # Errors
    /// Returns an error if a value is not a finite number, a row has the wrong number of cells, or time does not
    /// increase. The error states the line or row, and the column.
    pub fn next_sample(&mut self) -> Result<Option<Sample>, FileError> {
        Ok(self.rows.next()?.map(Sample::from_row))
    }

    /// Returns all remaining rows.
    ///
    /// # Errors
    /// Same errors as [`Recording::next_sample`].
    pub fn read_all(&mut self) -> Result<Vec<Sample>, FileError> {
        self.rows.read_all(Sample::from_row)
    }

    /// Number of bytes read so far, or of rows if the recording was made of samples, for a progress bar.
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
