//! Distributions of time spans: percentiles, the longest span and its index, and bins.

mod bins;
mod machine;
mod microseconds;
mod text;

pub use bins::Bin;
use bins::Bins;
use hdrhistogram::Histogram;
pub use machine::Machine;
pub use microseconds::{MAX_MICROSECONDS, Microseconds};
use serde::Serialize;
pub use text::{optional_span, span};

/// Histogram units per nanosecond. The unit is a picosecond, because means of batches are fractions of a nanosecond.
const UNITS_PER_NS: f64 = 1e3;
/// Longest span that the histogram resolves (ns): ten seconds.
const LONGEST_NS: f64 = 10e9;
/// Minimum number of expected spans beyond a reported percentile. With fewer, the percentile would depend on a few
/// spans.
const SPANS_BEYOND: u64 = 10;

/// Distribution of time spans in constant memory, with percentiles to three significant digits.
#[derive(Debug, Clone)]
pub struct Distribution {
    spans: Histogram<u64>,
    bins: Bins,
    microseconds: Microseconds,
    worst_ns: f64,
    worst_index: u64,
}

/// Figures of a distribution, in nanoseconds. The percentile p is `None` unless `count (1 - p/100)` is at least 10: p50
/// needs 20 spans, p90 100, p99 1000, p99.9 10 000 and p99.99 100 000.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Number of spans.
    pub count: u64,
    /// Minimum.
    pub min_ns: f64,
    /// Mean.
    pub mean_ns: f64,
    /// Median.
    pub p50_ns: Option<f64>,
    /// Percentile 90: 90 % of the spans are at most this long.
    pub p90_ns: Option<f64>,
    /// Percentile 99.
    pub p99_ns: Option<f64>,
    /// Percentile 99.9.
    pub p99_9_ns: Option<f64>,
    /// Percentile 99.99.
    pub p99_99_ns: Option<f64>,
    /// Maximum.
    pub worst_ns: f64,
    /// Index of the longest span, from 0; the first one if several are equal.
    pub worst_index: u64,
}

impl Default for Distribution {
    fn default() -> Self {
        Self::new()
    }
}

impl Distribution {
    /// Creates an empty distribution.
    ///
    /// # Panics
    /// Never: the bounds are valid for hdrhistogram.
    pub fn new() -> Self {
        let longest = (LONGEST_NS * UNITS_PER_NS) as u64;
        Self {
            spans: Histogram::new_with_bounds(1, longest, 3).expect("constant bounds are valid"),
            bins: Bins::default(),
            microseconds: Microseconds::default(),
            worst_ns: 0.0,
            worst_index: 0,
        }
    }

    /// Adds a span (ns) without allocating memory.
    pub fn record_ns(&mut self, span_ns: f64) {
        if span_ns > self.worst_ns {
            self.worst_ns = span_ns;
            self.worst_index = self.count();
        }
        self.bins.count(span_ns);
        self.microseconds.count(span_ns);
        self.spans
            .saturating_record((span_ns * UNITS_PER_NS).round() as u64);
    }

    /// Number of spans.
    pub fn count(&self) -> u64 {
        self.spans.len()
    }

    /// Returns the `quantile` (0 to 1) of the spans (ns): the shortest span that this fraction of all spans does not
    /// exceed.
    pub fn quantile_ns(&self, quantile: f64) -> f64 {
        let value = self.spans.value_at_quantile(quantile);
        value.min(self.spans.max()) as f64 / UNITS_PER_NS
    }

    /// Returns the quantile that one span in `one_in` exceeds (ns); `None` if there are too few spans.
    fn percentile_ns(&self, one_in: u64) -> Option<f64> {
        let has_enough_spans = self.count() >= SPANS_BEYOND * one_in;
        has_enough_spans.then(|| self.quantile_ns(1.0 - 1.0 / one_in as f64))
    }

    /// Returns the figures; 0 and `None` if there are no spans.
    pub fn figures(&self) -> Figures {
        Figures {
            count: self.count(),
            min_ns: self.spans.min() as f64 / UNITS_PER_NS,
            mean_ns: self.spans.mean() / UNITS_PER_NS,
            p50_ns: self.percentile_ns(2),
            p90_ns: self.percentile_ns(10),
            p99_ns: self.percentile_ns(100),
            p99_9_ns: self.percentile_ns(1000),
            p99_99_ns: self.percentile_ns(10_000),
            worst_ns: self.worst_ns,
            worst_index: self.worst_index,
        }
    }

    /// Returns the bins that are not empty, in increasing order.
    pub fn bins(&self) -> Vec<Bin> {
        self.bins.occupied()
    }

    /// Returns the number of spans in each whole microsecond.
    pub fn microseconds(&self) -> &Microseconds {
        &self.microseconds
    }
}
