//! Running statistics of a signal.

/// Running mean, root mean square and maximum magnitude.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Statistics {
    ticks: f64,
    sum: f64,
    square: f64,
    max_magnitude: f64,
}

/// Range of the mean over a moving window, whose number of ticks may change.
#[derive(Debug, Clone)]
pub(crate) struct Windowed {
    ring: Vec<f64>,
    /// Sum of the last `count` values.
    sum: f64,
    next: usize,
    count: usize,
    means: Option<Range>,
}

/// Smallest and largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
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

/// Longest distance over which a condition holds without a break.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Longest {
    current: Travelled,
    longest_m: f64,
}

/// Distance travelled.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Travelled {
    /// Distance of the ticks before the last change of speed, m.
    before_m: f64,
    tick_m: f64,
    /// Ticks since the last change of speed.
    ticks: u64,
}

impl Travelled {
    /// Adds a tick.
    pub fn add(&mut self, tick_m: f64) {
        if tick_m != self.tick_m {
            (self.before_m, self.tick_m, self.ticks) = (self.metres(), tick_m, 0);
        }
        self.ticks += 1;
    }

    /// The distance, m.
    pub fn metres(&self) -> f64 {
        self.before_m + self.ticks as f64 * self.tick_m
    }
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
    /// Starts with moving windows of at most `longest` ticks, at least 1.
    pub fn new(longest: usize) -> Self {
        Self {
            ring: vec![0.0; longest.max(1)],
            sum: 0.0,
            next: 0,
            count: 0,
            means: None,
        }
    }

    /// Adds a value; the window has now `ticks` ticks, at least 1 and at most the longest.
    pub fn add(&mut self, value: f64, ticks: usize) {
        let length = self.ring.len();
        let ticks = ticks.clamp(1, length);
        let left = if self.count < ticks {
            0.0
        } else {
            self.oldest()
        };
        self.sum += value - left;
        self.count -= usize::from(self.count >= ticks);
        while self.count >= ticks {
            self.sum -= self.oldest();
            self.count -= 1;
        }
        self.ring[self.next] = value;
        self.next = (self.next + 1) % length;
        self.count += 1;
        if self.count == ticks {
            let mean = self.mean();
            self.means.get_or_insert(Range::NONE).add(mean);
        }
    }

    /// Oldest value in the window.
    fn oldest(&self) -> f64 {
        self.ring[(self.next + self.ring.len() - self.count) % self.ring.len()]
    }

    /// Mean of the values in the window; of all values before the first whole window.
    pub fn mean(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }

    /// Range of the means over a window; `None` before the first whole window.
    pub fn means(&self) -> Option<Range> {
        self.means
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
    pub fn add(&mut self, holds: bool, tick_m: f64) {
        if holds {
            self.current.add(tick_m);
        } else {
            self.current = Travelled::default();
        }
        self.longest_m = self.longest_m.max(self.current.metres());
    }

    pub fn metres(&self) -> f64 {
        self.longest_m
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
            ramp.add(f64::from(tick), 10);
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
            pulse.add(if (8..11).contains(&tick) { -8.0 } else { 0.0 }, 4);
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
    fn longest_is_the_longest_unbroken_distance() {
        let mut longest = Longest::default();
        for holds in [true, true, false, true, true, true, false, true] {
            longest.add(holds, 0.5);
        }
        assert_eq!(longest.metres(), 1.5);
        // Three ticks at another speed.
        for tick_m in [1.0, 1.0, 0.25] {
            longest.add(true, tick_m);
        }
        assert_eq!(longest.metres(), 0.5 + 2.25);
    }

    /// A vehicle that brakes needs more and more ticks for a window; it then takes its whole last values.
    #[test]
    fn a_window_may_change_its_length() {
        let mut mean = Windowed::new(4);
        for (value, ticks, expected) in [
            (1.0, 2, 1.0),
            (3.0, 2, 2.0),
            (5.0, 2, 4.0),
            (7.0, 4, 5.0),
            (9.0, 4, 6.0),
            (11.0, 4, 8.0),
            (13.0, 1, 13.0),
        ] {
            mean.add(value, ticks);
            assert_eq!(mean.mean(), expected);
        }
        assert_eq!(mean.means(), range(2.0, 13.0));
    }
}
