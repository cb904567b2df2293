//! Time spans and how they are spread: percentiles, the longest and its index, bins.

mod bins;
mod machine;
mod text;

pub use bins::Bin;
use bins::Bins;
use hdrhistogram::Histogram;
pub use machine::Machine;
use serde::Serialize;
pub use text::{optional_span, span};

/// Picoseconds in a nanosecond: the unit of the histogram, for means of batches.
const UNITS: f64 = 1e3;
/// Longest span that the percentiles resolve (ns): ten seconds.
const LONGEST_NS: f64 = 10e9;
/// A percentile is reported when at least this many spans are expected beyond it: with fewer it would
/// depend on a few spans.
const SPANS_BEYOND: u64 = 10;

/// Time spans, percentiles to three significant digits, of constant size.
#[derive(Debug, Clone)]
pub struct Distribution {
    spans: Histogram<u64>,
    bins: Bins,
    worst_ns: f64,
    worst_index: u64,
}

/// Figures of a distribution, in nanoseconds. The percentile p is `None` unless `count (1 - p/100)` is at
/// least 10: p50 takes 20 spans, p90 100, p99 1000, p99.9 10 000 and p99.99 100 000.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Number of spans.
    pub count: u64,
    /// Shortest.
    pub min_ns: f64,
    /// Mean.
    pub mean_ns: f64,
    /// Median.
    pub p50_ns: Option<f64>,
    /// Percentile 90: nine tenths are at most this long.
    pub p90_ns: Option<f64>,
    /// Percentile 99.
    pub p99_ns: Option<f64>,
    /// Percentile 99.9.
    pub p99_9_ns: Option<f64>,
    /// Percentile 99.99.
    pub p99_99_ns: Option<f64>,
    /// Longest.
    pub worst_ns: f64,
    /// Spans counted before the longest; of several as long, the first.
    pub worst_index: u64,
}

impl Default for Distribution {
    fn default() -> Self {
        Self::new()
    }
}

impl Distribution {
    /// An empty one.
    ///
    /// # Panics
    /// Never: the bounds are those hdrhistogram allows.
    pub fn new() -> Self {
        let longest = (LONGEST_NS * UNITS) as u64;
        Self {
            spans: Histogram::new_with_bounds(1, longest, 3).expect("constant bounds are valid"),
            bins: Bins::default(),
            worst_ns: 0.0,
            worst_index: 0,
        }
    }

    /// Counts a span (ns); no allocation.
    pub fn record_ns(&mut self, span_ns: f64) {
        if span_ns > self.worst_ns {
            self.worst_ns = span_ns;
            self.worst_index = self.count();
        }
        self.bins.count(span_ns);
        self.spans
            .saturating_record((span_ns * UNITS).round() as u64);
    }

    /// Spans counted.
    pub fn count(&self) -> u64 {
        self.spans.len()
    }

    /// The shortest span that at least the fraction `quantile` (0 to 1) of all spans does not exceed (ns).
    pub fn quantile_ns(&self, quantile: f64) -> f64 {
        let value = self.spans.value_at_quantile(quantile);
        value.min(self.spans.max()) as f64 / UNITS
    }

    /// The quantile that one span in `one_in` lies beyond, where the spans carry it (ns).
    fn carried_ns(&self, one_in: u64) -> Option<f64> {
        let carried = self.count() >= SPANS_BEYOND * one_in;
        carried.then(|| self.quantile_ns(1.0 - 1.0 / one_in as f64))
    }

    /// The figures; 0 and `None` when nothing was counted.
    pub fn figures(&self) -> Figures {
        Figures {
            count: self.count(),
            min_ns: self.spans.min() as f64 / UNITS,
            mean_ns: self.spans.mean() / UNITS,
            p50_ns: self.carried_ns(2),
            p90_ns: self.carried_ns(10),
            p99_ns: self.carried_ns(100),
            p99_9_ns: self.carried_ns(1000),
            p99_99_ns: self.carried_ns(10_000),
            worst_ns: self.worst_ns,
            worst_index: self.worst_index,
        }
    }

    /// The bins that hold spans, shortest first.
    pub fn bins(&self) -> Vec<Bin> {
        self.bins.occupied()
    }
}
