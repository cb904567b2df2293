//! Gaps in a recording: sample intervals much longer than the median.

use hdrhistogram::Histogram;
use serde::Serialize;

use super::location::{LeftOut, RowLocation};
use super::notes::{Interpolation, UnfinishedEnd};

/// An interval longer than this many median intervals is a gap. Neither jitter of half an interval nor one or two lost
/// samples make a gap.
pub const GAP_IN_MEDIANS: f64 = 5.0;

/// Intervals are counted in nanoseconds.
const UNITS_PER_S: f64 = 1e9;
/// Longest interval that the histogram resolves: 31 years.
const MAX_UNITS: u64 = 1_000_000_000_000_000_000;
const SIGNIFICANT_DIGITS: u8 = 3;

/// Intervals of a recording, counted in constant memory.
pub(super) struct Intervals {
    counts: Histogram<u32>,
    /// Last interval, and how many equal ones at the end are not in `counts` yet: looking up a count for each row would
    /// take a tenth of the reading time.
    last_units: u64,
    last_count: u32,
    longest_units: u64,
    longest: Option<Gap>,
}

/// One gap in a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gap {
    /// Time of the sample before the gap (s).
    pub start_s: f64,
    /// Duration (s), to the nanosecond.
    pub duration_s: f64,
    /// Location of the sample after the gap.
    #[serde(flatten)]
    pub location: RowLocation,
}

/// Gaps and other irregularities of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gaps {
    /// Median sample interval (s), to three digits; `None` for fewer than two samples.
    pub median_interval_s: Option<f64>,
    /// Number of intervals longer than [`GAP_IN_MEDIANS`] times the median.
    pub count: u64,
    /// Longest gap.
    pub longest: Option<Gap>,
    /// Rows omitted because a value was missing; several consecutive ones create a gap.
    pub left_out: LeftOut,
    /// Number of the last line if the text was read to its end and does not end with a line end. The last number of
    /// this line may be cut off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unended_line: Option<u64>,
    /// End of the rows if the file is an unfinished MDF4 file, which is read up to the last whole row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unfinished: Option<UnfinishedEnd>,
    /// How the force was brought to the times of the displacement, if it is in another group.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Interpolation>,
}

impl Intervals {
    pub(super) fn new() -> Self {
        Self {
            counts: Histogram::new_with_bounds(1, MAX_UNITS, SIGNIFICANT_DIGITS)
                .expect("the histogram supports these bounds and digits"),
            last_units: 0,
            last_count: 0,
            longest_units: 0,
            longest: None,
        }
    }

    /// Adds the interval from `start_s` (s) to a later sample at `end_s` (s); `location` returns the location of that
    /// sample.
    #[inline]
    pub(super) fn add(&mut self, start_s: f64, end_s: f64, location: impl FnOnce() -> RowLocation) {
        // Rounds to the nearest unit without `round`, which is a function call on some processors. This runs for every
        // row.
        let interval = (end_s - start_s) * UNITS_PER_S;
        let units = (interval + 0.5) as u64;
        if units == self.last_units && self.last_count > 0 {
            self.last_count = self.last_count.saturating_add(1);
            return;
        }
        add_equal(&mut self.counts, self.last_units, self.last_count);
        (self.last_units, self.last_count) = (units, 1);
        if self.longest.is_none() || units > self.longest_units {
            self.longest_units = units;
            self.longest = Some(Gap {
                start_s,
                duration_s: interval.round() / UNITS_PER_S,
                location: location(),
            });
        }
    }

    /// Returns the gaps among the intervals added so far.
    pub(super) fn gaps(&self, left_out: LeftOut) -> Gaps {
        let mut counts = self.counts.clone();
        add_equal(&mut counts, self.last_units, self.last_count);
        if counts.is_empty() {
            return Gaps {
                median_interval_s: None,
                count: 0,
                longest: None,
                left_out,
                unended_line: None,
                unfinished: None,
                interpolation: None,
            };
        }
        let median = counts.value_at_quantile(0.5);
        let longest_regular = (GAP_IN_MEDIANS * median as f64) as u64;
        let shortest_gap = counts.next_non_equivalent(longest_regular);
        let count = counts.count_between(shortest_gap, u64::MAX);
        Gaps {
            median_interval_s: Some(three_digits(counts.median_equivalent(median))),
            count,
            longest: self.longest.filter(|_| count > 0),
            left_out,
            unended_line: None,
            unfinished: None,
            interpolation: None,
        }
    }
}

fn add_equal(counts: &mut Histogram<u32>, units: u64, count: u32) {
    if count > 0 {
        counts.saturating_record_n(units.max(1), count);
    }
}

/// Converts `units` to seconds with the three digits that the histogram resolves.
fn three_digits(units: u64) -> f64 {
    let seconds = units as f64 / UNITS_PER_S;
    format!("{seconds:.2e}").parse().unwrap_or(seconds)
}
