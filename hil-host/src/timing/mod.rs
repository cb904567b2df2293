//! Time spans and how they are spread: percentiles, worst, bars.

use hdrhistogram::Histogram;
use serde::Serialize;

/// Picoseconds in a nanosecond: the unit of the histogram, for means of batches.
const UNITS: f64 = 1e3;
/// Longest span held (ns): ten seconds; a longer one counts as this long.
const LONGEST_NS: f64 = 10e9;

/// Time spans counted to three significant digits, of constant size.
#[derive(Debug, Clone)]
pub struct Distribution {
    spans: Histogram<u64>,
}

/// Figures of a distribution, in nanoseconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Number of spans.
    pub count: u64,
    /// Shortest.
    pub min_ns: f64,
    /// Mean.
    pub mean_ns: f64,
    /// Median.
    pub p50_ns: f64,
    /// Percentile 90: nine tenths are at most this long.
    pub p90_ns: f64,
    /// Percentile 99.
    pub p99_ns: f64,
    /// Percentile 99.9.
    pub p99_9_ns: f64,
    /// Percentile 99.99.
    pub p99_99_ns: f64,
    /// Longest.
    pub worst_ns: f64,
}

/// A bar of a histogram.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bar {
    /// Spans above this (ns) ...
    pub from_ns: f64,
    /// ... and up to this (ns).
    pub to_ns: f64,
    /// How many.
    pub count: u64,
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
        }
    }

    /// Counts a span (ns); no allocation.
    pub fn record_ns(&mut self, span_ns: f64) {
        self.spans
            .saturating_record((span_ns * UNITS).round() as u64);
    }

    /// Spans counted.
    pub fn count(&self) -> u64 {
        self.spans.len()
    }

    /// The shortest span that at least the share `quantile` (0 to 1) of all is at most as long as (ns).
    pub fn quantile_ns(&self, quantile: f64) -> f64 {
        let value = self.spans.value_at_quantile(quantile);
        value.min(self.spans.max()) as f64 / UNITS
    }

    /// The figures; all 0 when nothing was counted.
    pub fn figures(&self) -> Figures {
        Figures {
            count: self.count(),
            min_ns: self.spans.min() as f64 / UNITS,
            mean_ns: self.spans.mean() / UNITS,
            p50_ns: self.quantile_ns(0.5),
            p90_ns: self.quantile_ns(0.9),
            p99_ns: self.quantile_ns(0.99),
            p99_9_ns: self.quantile_ns(0.999),
            p99_99_ns: self.quantile_ns(0.9999),
            worst_ns: self.spans.max() as f64 / UNITS,
        }
    }

    /// Up to `most` bars from shortest to longest span, their borders in geometric progression;
    /// together they hold every span.
    pub fn bars(&self, most: usize) -> Vec<Bar> {
        if self.count() == 0 || most == 0 {
            return Vec::new();
        }
        let low = self.spans.min().max(1) as f64;
        let high = (self.spans.max() as f64).max(low);
        let ratio = (high / low).max(1.0 + 1e-3).powf(1.0 / most as f64);
        let border = |index: usize| low * ratio.powi(index as i32);
        let mut bars: Vec<Bar> = (0..most)
            .map(|index| Bar {
                from_ns: border(index) / UNITS,
                to_ns: border(index + 1) / UNITS,
                count: 0,
            })
            .collect();
        for step in self.spans.iter_recorded() {
            let value = step.value_iterated_to() as f64;
            let index = (value.max(low) / low).ln() / ratio.ln();
            bars[(index as usize).min(most - 1)].count += step.count_since_last_iteration();
        }
        bars
    }
}
