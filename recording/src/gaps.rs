//! Gaps of a recording: sample intervals far longer than its median one.

use hdrhistogram::Histogram;
use serde::Serialize;

use super::place::{LeftOut, Place};

/// An interval of more than this many median intervals is a gap. A logger whose stamps jitter by half an
/// interval or that loses one or two samples makes no gap.
pub const GAP_IN_MEDIANS: f64 = 5.0;

/// Intervals are counted in nanoseconds, up to thirty years.
const UNITS_PER_S: f64 = 1e9;
const LONGEST: u64 = 1_000_000_000_000_000_000;
const SIGNIFICANT_DIGITS: u8 = 3;

/// The intervals of a recording, counted in constant memory.
pub(super) struct Intervals {
    counts: Histogram<u32>,
    longest_units: u64,
    longest: Option<Gap>,
}

/// One gap of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gap {
    /// Time of the sample before it (s).
    pub start_s: f64,
    /// How long it is (s), to the nanosecond.
    pub duration_s: f64,
    /// Where the sample after it is.
    #[serde(flatten)]
    pub place: Place,
}

/// The gaps of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gaps {
    /// Median sample interval (s), to three digits; `None` for less than two samples.
    pub median_interval_s: Option<f64>,
    /// How many intervals are over [`GAP_IN_MEDIANS`] times the median.
    pub count: u64,
    /// The longest of them.
    pub longest: Option<Gap>,
    /// Rows left out because they lacked a value; several of them make a gap.
    pub left_out: LeftOut,
    /// The last line of a text that was read to its end, where that line has no line end and may be cut inside its last
    /// number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unended_line: Option<u64>,
}

impl Intervals {
    pub(super) fn new() -> Self {
        Self {
            counts: Histogram::new_with_bounds(1, LONGEST, SIGNIFICANT_DIGITS)
                .expect("bounds and digits within the histogram's"),
            longest_units: 0,
            longest: None,
        }
    }

    /// Takes in the interval from `start_s` (s) to the sample at `end_s` (s), later; `place` tells where that is.
    #[inline]
    pub(super) fn add(&mut self, start_s: f64, end_s: f64, place: impl FnOnce() -> Place) {
        // To the nearest; every row is taken in, and `round` is a call where the processor has no instruction for it.
        let interval = (end_s - start_s) * UNITS_PER_S;
        let units = (interval + 0.5) as u64;
        self.counts.saturating_record(units.max(1));
        if self.longest.is_none() || units > self.longest_units {
            self.longest_units = units;
            self.longest = Some(Gap {
                start_s,
                duration_s: interval.round() / UNITS_PER_S,
                place: place(),
            });
        }
    }

    /// The gaps among the intervals taken in.
    pub(super) fn gaps(&self, left_out: LeftOut) -> Gaps {
        if self.counts.is_empty() {
            return Gaps {
                median_interval_s: None,
                count: 0,
                longest: None,
                left_out,
                unended_line: None,
            };
        }
        let median = self.counts.value_at_quantile(0.5);
        let longest_regular = (GAP_IN_MEDIANS * median as f64) as u64;
        let shortest_gap = self.counts.next_non_equivalent(longest_regular);
        let count = self.counts.count_between(shortest_gap, u64::MAX);
        Gaps {
            median_interval_s: Some(three_digits(self.counts.median_equivalent(median))),
            count,
            longest: self.longest.filter(|_| count > 0),
            left_out,
            unended_line: None,
        }
    }
}

/// The interval (s) of `units`, as far as the histogram knows it.
fn three_digits(units: u64) -> f64 {
    let seconds = units as f64 / UNITS_PER_S;
    format!("{seconds:.2e}").parse().unwrap_or(seconds)
}
