//! Recorded force of a damper that is not simulated with the vehicle.

use std::ops::RangeInclusive;
use std::path::Path;

use super::channels::Channels;
use super::open::{Origin, open_rows};
use super::unit::Quantity;
use super::{RecordingError, UnfinishedEnd};
use dashpot_files::FileError;

/// Times this close together count as equal (s), because text files round times to the nanosecond.
const TIME_TOLERANCE_S: f64 = 1e-9;

/// Force over time, linear between samples. By default the channels are `time_s` and `force_n`; the file formats are
/// those of a [`Recording`](super::Recording).
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    samples: Vec<ForceSample>,
    unended_line: Option<u64>,
    unfinished: Option<UnfinishedEnd>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct ForceSample {
    time_s: f64,
    force_n: f64,
}

impl ForceHistory {
    /// Reads the force from the file at `path` (`-` for standard input), which must cover the period `needed_s` (s).
    ///
    /// # Errors
    /// Same errors as [`Recording::open`](super::Recording::open) and
    /// [`Recording::next_sample`](super::Recording::next_sample); also an error if the recording does not cover the
    /// period.
    pub fn open(path: &Path, needed_s: RangeInclusive<f64>) -> Result<Self, FileError> {
        Self::open_with(path, &Channels::default(), needed_s)
    }

    /// Same as [`ForceHistory::open`], but with the given channels.
    ///
    /// # Errors
    /// Same errors as [`ForceHistory::open`].
    pub fn open_with(
        path: &Path,
        channels: &Channels,
        needed_s: RangeInclusive<f64>,
    ) -> Result<Self, FileError> {
        let quantities = [Quantity::Time, Quantity::Force];
        let mut rows = open_rows(Origin::Path(path), channels, quantities)?;
        let samples = rows.read_all(|[time_s, force_n]| ForceSample { time_s, force_n })?;
        if let (Some(first), Some(last)) = (samples.first(), samples.last())
            && (first.time_s > needed_s.start() + TIME_TOLERANCE_S
                || last.time_s < needed_s.end() - TIME_TOLERANCE_S)
        {
            return Err(rows.in_file(RecordingError::Short {
                recorded_s: first.time_s..=last.time_s,
                needed_s,
            }));
        }
        let gaps = rows.gaps();
        Ok(Self {
            samples,
            unended_line: gaps.unended_line,
            unfinished: gaps.unfinished,
        })
    }

    /// Number of the last line if the text does not end with a line end. The last number of this line may be cut off.
    pub fn unended_line(&self) -> Option<u64> {
        self.unended_line
    }

    /// End of the rows if the file is an unfinished MDF4 file, which is read up to the last whole row.
    pub fn unfinished(&self) -> Option<UnfinishedEnd> {
        self.unfinished
    }

    /// Returns the force (N) at a time (s). Before the first and after the last sample the force is constant.
    pub fn force_n(&self, time_s: f64) -> f64 {
        let after = self
            .samples
            .partition_point(|sample| sample.time_s <= time_s);
        let before = self.samples.get(after.wrapping_sub(1));
        match (before, self.samples.get(after)) {
            (Some(from), Some(to)) => {
                let fraction = (time_s - from.time_s) / (to.time_s - from.time_s);
                from.force_n + (to.force_n - from.force_n) * fraction
            }
            (Some(only), None) | (None, Some(only)) => only.force_n,
            (None, None) => 0.0,
        }
    }
}
