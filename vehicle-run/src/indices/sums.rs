//! Running statistics of a signal.

/// Running mean, root mean square and maximum magnitude.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Statistics {
    ticks: f64,
    sum: f64,
    square: f64,
    max_magnitude: f64,
}

/// Range of the mean over a moving window of ticks.
#[derive(Debug, Clone)]
pub(crate) struct Windowed {
    ring: Vec<f64>,
    /// Sum of the values in the ring.
    sum: f64,
    next: usize,
    is_full: bool,
    means: Range,
}

/// Smallest and largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Range {
    pub min: f64,
    pub max: f64,
}

impl Range {
    /// Range of no value.
    pub const NONE: Self = Self {
        min: f64::INFINITY,
        max: f64::NEG_INFINITY,
    };

    pub fn add(&mut self, value: f64) {
        self.min = self.min.min(value);
        self.max = self.max.max(value);
    }
}

/// Longest run of consecutive ticks for which a condition holds.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Longest {
    current: u64,
    longest: u64,
}

impl Statistics {
    pub fn add(&mut self, value: f64) {
        self.ticks += 1.0;
        self.sum += value;
        self.square += value * value;
        self.max_magnitude = self.max_magnitude.max(value.abs());
    }

    pub fn mean(&self) -> f64 {
        self.sum / self.ticks
    }

    /// Root mean square.
    pub fn rms(&self) -> f64 {
        (self.square / self.ticks).sqrt()
    }

    /// Maximum magnitude.
    pub fn max_magnitude(&self) -> f64 {
        self.max_magnitude
    }
}

impl Windowed {
    /// Starts with a moving window of `ticks` ticks, at least 1.
    pub fn new(ticks: usize) -> Self {
        Self {
            ring: vec![0.0; ticks.max(1)],
            sum: 0.0,
            next: 0,
            is_full: false,
            means: Range::NONE,
        }
    }

    pub fn add(&mut self, value: f64) {
        self.sum += value - self.ring[self.next];
        self.ring[self.next] = value;
        self.next += 1;
        if self.next == self.ring.len() {
            self.next = 0;
            self.is_full = true;
        }
        if self.is_full {
            self.means.add(self.mean());
        }
    }

    /// Mean of the values in the window; of all values before the first whole window.
    pub fn mean(&self) -> f64 {
        let count = if self.is_full {
            self.ring.len()
        } else {
            self.next.max(1)
        };
        self.sum / count as f64
    }

    /// Range of the means over a window; `None` before the first whole window.
    pub fn means(&self) -> Option<Range> {
        self.is_full.then_some(self.means)
    }

    /// Maximum magnitude of the mean over a window, or the magnitude of the mean of all values before the first whole
    /// window.
    pub fn max_mean_magnitude(&self) -> f64 {
        let magnitude = |means: Range| means.max.max(-means.min);
        let overall = || self.mean().abs();
        self.means().map_or_else(overall, magnitude)
    }
}

impl Longest {
    pub fn add(&mut self, holds: bool) {
        self.current = if holds { self.current + 1 } else { 0 };
        self.longest = self.longest.max(self.current);
    }

    pub fn ticks(&self) -> u64 {
        self.longest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(min: f64, max: f64) -> Option<Range> {
        Some(Range { min, max })
    }

    /// For the ramp `0, 1, ... 99`, windows of 10 ticks have means from 4.5 to 94.5.
    #[test]
    fn window_means_of_a_ramp_are_the_values_at_the_window_centres() {
        let mut ramp = Windowed::new(10);
        for tick in 0..100 {
            assert_eq!(ramp.means().is_some(), tick >= 10);
            ramp.add(f64::from(tick));
        }
        assert_eq!(ramp.means(), range(4.5, 94.5));
        assert_eq!(ramp.max_mean_magnitude(), 94.5);
    }

    /// A pulse of 3 ticks in a window of 4 ticks gives three quarters of its height; negative pulses count by
    /// magnitude.
    #[test]
    fn window_mean_of_a_short_pulse_is_its_share_of_the_window() {
        let mut pulse = Windowed::new(4);
        for tick in 0..20 {
            pulse.add(if (8..11).contains(&tick) { -8.0 } else { 0.0 });
        }
        assert_eq!(pulse.means(), range(-6.0, 0.0));
        assert_eq!(pulse.max_mean_magnitude(), 6.0);
    }

    #[test]
    fn statistics_are_mean_root_mean_square_and_greatest_magnitude() {
        let mut statistics = Statistics::default();
        for value in [1.0, -7.0, 3.0, 3.0] {
            statistics.add(value);
        }
        assert_eq!(
            (statistics.mean(), statistics.rms()),
            (0.0, 17.0_f64.sqrt())
        );
        assert_eq!(statistics.max_magnitude(), 7.0);
    }

    #[test]
    fn longest_counts_the_longest_run_of_consecutive_ticks() {
        let mut longest = Longest::default();
        for holds in [true, true, false, true, true, true, false, true] {
            longest.add(holds);
        }
        assert_eq!(longest.ticks(), 3);
    }
}
