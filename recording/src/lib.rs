#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod channels;
#[cfg(feature = "parquet")]
pub mod columns;
mod error;
mod force_history;
mod gaps;
#[cfg(feature = "parquet")]
mod guarded;
#[cfg(feature = "mdf")]
mod mdf;
mod measurement;
mod open;
mod opened;
mod overview;
#[cfg(feature = "parquet")]
mod parquet;
mod place;
mod remedy;
mod rows;
mod samples;
mod select;
mod stream;
pub mod stretches;
#[cfg(feature = "parquet")]
pub(crate) mod sums;
mod text;
pub mod tick_grid;
mod unit;
pub mod written;

use std::io::Read;
use std::path::Path;
use std::rc::Rc;

pub use channels::{Channel, Channels};
pub use error::RecordingError;
pub(crate) use error::{MAX_GAP_TICKS, MOST_TICKS};
pub use force_history::ForceHistory;
pub use gaps::{GAP_IN_MEDIANS, Gap, Gaps};
pub use measurement::{MeasuredSample, Measurement};
use open::{Origin, open_rows};
pub use overview::{ChannelOverview, Overview, TimeOverview, overview};
pub use place::{LeftOut, Place};
pub use remedy::{Remedy, remedy};
use rows::Rows;
pub use text::{DecimalMark, Separator, TextOptions};
pub use unit::{Quantity, Unit};

use dashpot_files::FileError;

/// One row of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub time_s: f64,
    /// Relative displacement of the seats (m), positive in extension.
    pub displacement_m: f64,
}

impl Sample {
    fn of([time_s, displacement_m]: [f64; 2]) -> Self {
        Self {
            time_s,
            displacement_m,
        }
    }
}

/// A recorded motion, read row by row in bounded memory. What the file is, is found in its first bytes.
pub struct Recording {
    rows: Rows<2>,
}

impl Recording {
    /// Opens the recording at `path`, `-` being standard input, with the channels `time_s` and `displacement_m`.
    ///
    /// # Errors
    /// As [`Recording::open_with`].
    pub fn open(path: &Path) -> Result<Self, FileError> {
        Self::open_with(path, &Channels::default())
    }

    /// Opens the recording at `path`, `-` being standard input.
    ///
    /// # Errors
    /// No readable file, an empty one, one of another kind, a channel that is missing or may be several, or whose unit is not known.
    pub fn open_with(path: &Path, channels: &Channels) -> Result<Self, FileError> {
        Self::of(Origin::Path(path), channels)
    }

    /// A recording from `source`, called `path` in errors, with the channels `time_s` and `displacement_m`.
    ///
    /// # Errors
    /// As [`Recording::open_with`].
    pub fn read(path: &Path, source: Box<dyn Read>) -> Result<Self, FileError> {
        Self::read_with(path, source, &Channels::default())
    }

    /// A recording from `source`, called `path` in errors.
    ///
    /// # Errors
    /// As [`Recording::open_with`].
    pub fn read_with(
        path: &Path,
        source: Box<dyn Read>,
        channels: &Channels,
    ) -> Result<Self, FileError> {
        Self::of(Origin::Stream(path, source), channels)
    }

    /// Rows that were read from `path` already, once more.
    pub fn again(path: &Path, samples: Rc<Vec<Sample>>) -> Self {
        let quantities = [Quantity::Time, Quantity::Displacement];
        let names = quantities.map(|quantity| quantity.column().to_owned());
        let samples = Box::new(samples::Samples::new(samples));
        let rows = Rows::new(path, samples, names, samples::chosen(), false);
        Self { rows }
    }

    fn of(origin: Origin<'_>, channels: &Channels) -> Result<Self, FileError> {
        let quantities = [Quantity::Time, Quantity::Displacement];
        let rows = open_rows(origin, channels, quantities)?;
        Ok(Self { rows })
    }

    /// The next row; `None` at the end.
    ///
    /// # Errors
    /// A value that is no finite number, a row of other length, or time that does not grow; with line or row, and column.
    pub fn next_sample(&mut self) -> Result<Option<Sample>, FileError> {
        Ok(self.rows.next()?.map(Sample::of))
    }

    /// All rows left.
    ///
    /// # Errors
    /// As [`Recording::next_sample`].
    pub fn read_all(&mut self) -> Result<Vec<Sample>, FileError> {
        self.rows.read_all(Sample::of)
    }

    /// Bytes read so far, for a progress bar.
    pub fn position(&self) -> u64 {
        self.rows.position()
    }

    /// The gaps among the rows read so far, and rows that were left out.
    pub fn gaps(&self) -> Gaps {
        self.rows.gaps()
    }

    /// `error` in the recording as a whole.
    pub(crate) fn in_text(&self, error: RecordingError) -> FileError {
        self.rows.in_text(error)
    }

    /// `error` in the time of the row read last.
    pub(crate) fn in_time(&self, error: RecordingError) -> FileError {
        self.rows.in_time(error)
    }
}
