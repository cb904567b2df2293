//! Fixed histogram bins for time spans, so that runs can be compared bin by bin.

use serde::Serialize;

/// Preferred numbers R10 of ISO 3: ten bin edges per decade, with ratios of about 1.25.
const R10: [f64; 10] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0];
/// Number of decades that the edges cover: from 1 ns to 10 s.
const DECADES: usize = 10;
const BORDERS: usize = R10.len() * DECADES + 1;
/// Edges of the bins (ns).
const BORDERS_NS: [f64; BORDERS] = borders_ns();

const fn borders_ns() -> [f64; BORDERS] {
    let mut borders = [0.0; BORDERS];
    let mut decade = 1.0;
    let mut index = 0;
    while index < BORDERS {
        borders[index] = R10[index % R10.len()] * decade;
        index += 1;
        if index.is_multiple_of(R10.len()) {
            decade *= 10.0;
        }
    }
    borders
}

/// A bin with spans of at least `from_ns` and less than `to_ns`. The edges are 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3
/// and 8 times the powers of ten from 1 ns to 10 s. The first bin starts at 0, and the last one has no upper edge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bin {
    /// Lower edge (ns), inclusive.
    pub from_ns: f64,
    /// Upper edge (ns), exclusive; `None` for the last bin.
    pub to_ns: Option<f64>,
    /// Number of spans in the bin.
    pub count: u64,
}

/// Number of spans in each bin.
#[derive(Debug, Clone)]
pub(super) struct Bins([u64; BORDERS + 1]);

impl Default for Bins {
    fn default() -> Self {
        Self([0; BORDERS + 1])
    }
}

impl Bins {
    /// Counts a span (ns).
    pub(super) fn count(&mut self, span_ns: f64) {
        self.0[BORDERS_NS.partition_point(|border| *border <= span_ns)] += 1;
    }

    /// Returns the bins that are not empty, in increasing order.
    pub(super) fn occupied(&self) -> Vec<Bin> {
        let border = |index: usize| BORDERS_NS.get(index).copied();
        let bins = self.0.iter().enumerate().map(|(index, &count)| Bin {
            from_ns: index.checked_sub(1).and_then(border).unwrap_or(0.0),
            to_ns: border(index),
            count,
        });
        bins.filter(|bin| bin.count > 0).collect()
    }
}
