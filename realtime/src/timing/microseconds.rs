//! Number of time spans in each whole microsecond, as cyclictest counts latencies.

/// Spans of this many microseconds and more are counted together: ten ticks of 1 kHz.
pub const MAX_MICROSECONDS: usize = 10_000;

/// Number of spans in each whole microsecond.
///
/// ```
/// use dashpot_realtime::timing::Distribution;
/// let mut lateness = Distribution::new();
/// for span_ns in [300.0, 2_000.0, 2_999.0, 20e6] {
///     lateness.record_ns(span_ns);
/// }
/// assert_eq!(lateness.microseconds().counts(), [1, 0, 2]);
/// assert_eq!(lateness.microseconds().beyond(), 1);
/// ```
#[derive(Debug, Clone)]
pub struct Microseconds {
    counts: Vec<u64>,
    beyond: u64,
}

impl Default for Microseconds {
    fn default() -> Self {
        Self {
            counts: vec![0; MAX_MICROSECONDS],
            beyond: 0,
        }
    }
}

impl Microseconds {
    /// Counts a span (ns) without allocating memory.
    pub(super) fn count(&mut self, span_ns: f64) {
        match self.counts.get_mut((span_ns * 1e-3) as usize) {
            Some(count) => *count += 1,
            None => self.beyond += 1,
        }
    }

    /// Returns the numbers of spans up to the last microsecond that has one. Index n counts spans of at least n and
    /// less than n + 1 microseconds.
    pub fn counts(&self) -> &[u64] {
        let occupied = self.counts.iter().rposition(|count| *count > 0);
        &self.counts[..occupied.map_or(0, |last| last + 1)]
    }

    /// Returns the number of spans of [`MAX_MICROSECONDS`] and more.
    pub fn beyond(&self) -> u64 {
        self.beyond
    }
}
