//! A recorded force, for a damper that stands outside a simulated vehicle.

use std::path::Path;

use super::RecordingError;
use super::channels::Channels;
use super::open::{Origin, open_rows};
use super::unit::Quantity;
use dashpot_files::FileError;

/// What times may differ by and count as the same: text has them rounded to the nanosecond (s).
const SAME_S: f64 = 1e-9;

/// A force over time, between its samples on a straight line: channels time_s and force_n, else as a
/// [`Recording`](super::Recording).
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    /// Times (s) and forces (N).
    samples: Vec<[f64; 2]>,
    unended_line: Option<u64>,
}

impl ForceHistory {
    /// The force in the file at `path`, `-` being standard input, which must last over `needed_s` (s).
    ///
    /// # Errors
    /// As [`Recording::open`](super::Recording::open) and [`Recording::next_sample`](super::Recording::next_sample); a recording that
    /// starts later or ends before.
    pub fn open(path: &Path, needed_s: [f64; 2]) -> Result<Self, FileError> {
        Self::open_with(path, &Channels::default(), needed_s)
    }

    /// As [`ForceHistory::open`], of the channels that are chosen.
    ///
    /// # Errors
    /// As [`ForceHistory::open`].
    pub fn open_with(
        path: &Path,
        channels: &Channels,
        needed_s: [f64; 2],
    ) -> Result<Self, FileError> {
        let quantities = [Quantity::Time, Quantity::Force];
        let mut rows = open_rows(Origin::Path(path), channels, quantities)?;
        let samples = rows.read_all(|sample| sample)?;
        if let (Some([from_s, _]), Some([to_s, _])) = (samples.first(), samples.last())
            && (*from_s > needed_s[0] + SAME_S || *to_s < needed_s[1] - SAME_S)
        {
            return Err(rows.in_text(RecordingError::Short {
                lasts_s: [*from_s, *to_s],
                needed_s,
            }));
        }
        Ok(Self {
            samples,
            unended_line: rows.gaps().unended_line,
        })
    }

    /// The last line of a text, where it has no line end and may be cut inside its last number.
    pub fn unended_line(&self) -> Option<u64> {
        self.unended_line
    }

    /// Force at a time (N); before the first sample the first, after the last the last.
    pub fn force_n(&self, time_s: f64) -> f64 {
        let after = self.samples.partition_point(|[time, _]| *time <= time_s);
        let before = self.samples.get(after.wrapping_sub(1));
        match (before, self.samples.get(after)) {
            (Some([from_s, from_n]), Some([to_s, to_n])) => {
                from_n + (to_n - from_n) * ((time_s - from_s) / (to_s - from_s))
            }
            (Some([_, force_n]), None) | (None, Some([_, force_n])) => *force_n,
            (None, None) => 0.0,
        }
    }
}
