//! A series over ticks, however long, in no more points than a plot can show: the lowest and the highest of
//! each stretch of ticks stay, at their own ticks, so that no peak vanishes.

/// Stretches at most; a plot is a thousand pixels wide, and may be enlarged.
const MOST: usize = 4096;

/// The lowest and highest value of each stretch of ticks. Stretches double as the series grows.
pub struct Envelope {
    /// Ticks in a stretch.
    width: u32,
    stretches: Vec<Stretch>,
}

/// A value and its tick.
type Sample = (u32, f64);

struct Stretch {
    low: Sample,
    high: Sample,
}

impl Stretch {
    fn take(&mut self, other: &Self) {
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
            stretches: Vec::new(),
        }
    }
}

impl Envelope {
    /// Takes the value at `tick`, later than all before; ticks may be left out. A value that is not finite
    /// is passed over.
    pub fn record(&mut self, tick: u32, value: f64) {
        if !value.is_finite() {
            return;
        }
        let sample = (tick, value);
        self.push(Stretch {
            low: sample,
            high: sample,
        });
        if self.stretches.len() > MOST {
            self.width = self.width.saturating_mul(2);
            for stretch in std::mem::take(&mut self.stretches) {
                self.push(stretch);
            }
        }
    }

    fn push(&mut self, new: Stretch) {
        let width = self.width;
        match self.stretches.last_mut() {
            Some(last) if last.low.0 / width == new.low.0 / width => last.take(&new),
            _ => self.stretches.push(new),
        }
    }

    /// The samples that stay, in the order of their ticks.
    pub fn samples(&self) -> impl Iterator<Item = Sample> {
        self.stretches.iter().flat_map(|stretch| {
            let (low, high) = (stretch.low, stretch.high);
            let (first, last) = if low.0 <= high.0 {
                (low, high)
            } else {
                (high, low)
            };
            std::iter::once(first).chain((last.0 != first.0).then_some(last))
        })
    }

    /// The first tick of each stretch that stays.
    pub fn ticks(&self) -> impl Iterator<Item = u32> {
        self.stretches
            .iter()
            .map(|stretch| stretch.low.0.min(stretch.high.0))
    }
}

/// When a tick ended, the first a step after the start, s.
pub fn time_s(tick: u32, step_s: f64) -> f64 {
    (f64::from(tick) + 1.0) * step_s
}

/// Values of ticks over time (s), the lowest and highest of each stretch.
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
    fn a_short_series_stays_as_it_is() {
        let mut envelope = Envelope::default();
        let samples: Vec<Sample> = (0..MOST as u32).map(|tick| (tick, 0.5)).collect();
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
        assert!(samples.len() <= 2 * MOST && samples.len() > MOST / 2);
        assert!(
            samples.is_sorted_by(|a, b| a.0 < b.0),
            "in order, once each"
        );
        assert!(samples.iter().all(|(tick, value)| peak(*tick) == *value));
        assert!(samples.contains(&(123_456, 7.0)) && samples.contains(&(123_457, -9.0)));
    }

    #[test]
    fn ticks_may_be_left_out() {
        let mut envelope = Envelope::default();
        for tick in (0..5000).map(|i| i * i) {
            envelope.record(tick, 1.0);
        }
        let ticks: Vec<u32> = envelope.ticks().collect();
        assert!(ticks.len() <= MOST && ticks.is_sorted());
        assert_eq!(ticks[0], 0);
    }
}
