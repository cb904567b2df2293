//! Reduction of a long series to the points that a plot can show. It keeps the lowest and the highest sample of each
//! interval of ticks, at their own ticks, so that no peak is lost.

/// Maximum number of intervals; a plot is about a thousand pixels wide and can be enlarged.
const MAX_INTERVALS: usize = 4096;

/// Lowest and highest value of each interval of ticks. The length of the intervals doubles as the series grows.
pub struct Envelope {
    /// Ticks per interval.
    width: u32,
    intervals: Vec<Interval>,
}

/// Tick and value.
type Sample = (u32, f64);

struct Interval {
    low: Sample,
    high: Sample,
}

impl Interval {
    fn merge(&mut self, other: &Self) {
        if other.low.1 < self.low.1 {
            self.low = other.low;
        }
        if other.high.1 > self.high.1 {
            self.high = other.high;
        }
    }
}

impl Default for Envelope {
    fn default() -> Self {
        Self {
            width: 1,
            intervals: Vec::new(),
        }
    }
}

impl Envelope {
    /// Adds the value at `tick`, which must be later than all previous ones; ticks may be skipped. Values that are not
    /// finite are ignored.
    pub fn record(&mut self, tick: u32, value: f64) {
        if !value.is_finite() {
            return;
        }
        let sample = (tick, value);
        self.push(Interval {
            low: sample,
            high: sample,
        });
        if self.intervals.len() > MAX_INTERVALS {
            self.width = self.width.saturating_mul(2);
            for interval in std::mem::take(&mut self.intervals) {
                self.push(interval);
            }
        }
    }

    fn push(&mut self, new: Interval) {
        let width = self.width;
        match self.intervals.last_mut() {
            Some(last) if last.low.0 / width == new.low.0 / width => last.merge(&new),
            _ => self.intervals.push(new),
        }
    }

    /// Returns the kept samples in the order of their ticks.
    pub fn samples(&self) -> impl Iterator<Item = Sample> {
        self.intervals.iter().flat_map(|interval| {
            let (low, high) = (interval.low, interval.high);
            let (first, last) = if low.0 <= high.0 {
                (low, high)
            } else {
                (high, low)
            };
            std::iter::once(first).chain((last.0 != first.0).then_some(last))
        })
    }

    /// Returns the tick of the first kept sample of each interval.
    pub fn ticks(&self) -> impl Iterator<Item = u32> {
        self.intervals
            .iter()
            .map(|interval| interval.low.0.min(interval.high.0))
    }
}

/// Returns the time (s) at the end of a tick; tick 0 ends one step after the start.
pub fn time_s(tick: u32, step_s: f64) -> f64 {
    (f64::from(tick) + 1.0) * step_s
}

/// Reduces one value per tick to points `(time_s, value)` that keep all peaks.
///
/// ```
/// let points = dashpot_report::plot::envelope::thinned([1.0, 5.0, 2.0], 1e-3);
/// assert_eq!(points[1], (2e-3, 5.0));
/// ```
pub fn thinned(values: impl IntoIterator<Item = f64>, step_s: f64) -> Vec<(f64, f64)> {
    let mut envelope = Envelope::default();
    for (tick, value) in (0..).zip(values) {
        envelope.record(tick, value);
    }
    let samples = envelope.samples();
    samples
        .map(|(tick, value)| (time_s(tick, step_s), value))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_series_is_unchanged() {
        let mut envelope = Envelope::default();
        let samples: Vec<Sample> = (0..MAX_INTERVALS as u32).map(|tick| (tick, 0.5)).collect();
        for (tick, value) in &samples {
            envelope.record(*tick, *value);
        }
        assert!(envelope.samples().eq(samples));
    }

    #[test]
    fn a_long_series_keeps_its_peaks_at_their_ticks() {
        let mut envelope = Envelope::default();
        let peak = |tick| match tick {
            123_456 => 7.0,
            123_457 => -9.0,
            900_001 => f64::NAN,
            _ => f64::from(tick % 3),
        };
        for tick in 0..1_000_000 {
            envelope.record(tick, peak(tick));
        }
        let samples: Vec<Sample> = envelope.samples().collect();
        assert!(samples.len() <= 2 * MAX_INTERVALS && samples.len() > MAX_INTERVALS / 2);
        assert!(
            samples.is_sorted_by(|a, b| a.0 < b.0),
            "in order, once each"
        );
        assert!(samples.iter().all(|(tick, value)| peak(*tick) == *value));
        assert!(samples.contains(&(123_456, 7.0)) && samples.contains(&(123_457, -9.0)));
    }

    #[test]
    fn ticks_may_be_skipped() {
        let mut envelope = Envelope::default();
        for tick in (0..5000).map(|i| i * i) {
            envelope.record(tick, 1.0);
        }
        let ticks: Vec<u32> = envelope.ticks().collect();
        assert!(ticks.len() <= MAX_INTERVALS && ticks.is_sorted());
        assert_eq!(ticks[0], 0);
    }
}
