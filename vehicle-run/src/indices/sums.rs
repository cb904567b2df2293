//! Sums of a signal that indices are of.

/// Sum, squares and greatest magnitude.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spread {
    ticks: f64,
    sum: f64,
    square: f64,
    greatest: f64,
}

/// Squares, and least and greatest mean over a window of ticks.
#[derive(Debug, Clone)]
pub(super) struct Windowed {
    spread: Spread,
    ring: Vec<f64>,
    /// Sum of the ring.
    sum: f64,
    next: usize,
    is_full: bool,
    means: [f64; 2],
}

/// The longest time without a break that something is so.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Longest {
    now: u64,
    longest: u64,
}

impl Spread {
    pub fn add(&mut self, value: f64) {
        self.ticks += 1.0;
        self.sum += value;
        self.square += value * value;
        self.greatest = self.greatest.max(value.abs());
    }

    pub fn mean(&self) -> f64 {
        self.sum / self.ticks
    }

    /// Root mean square.
    pub fn rms(&self) -> f64 {
        (self.square / self.ticks).sqrt()
    }

    /// Greatest magnitude.
    pub fn greatest(&self) -> f64 {
        self.greatest
    }
}

impl Windowed {
    /// Of windows of so many ticks.
    pub fn new(ticks: usize) -> Self {
        Self {
            spread: Spread::default(),
            ring: vec![0.0; ticks.max(1)],
            sum: 0.0,
            next: 0,
            is_full: false,
            means: [f64::INFINITY, f64::NEG_INFINITY],
        }
    }

    pub fn add(&mut self, value: f64) {
        self.spread.add(value);
        self.sum += value - self.ring[self.next];
        self.ring[self.next] = value;
        self.next += 1;
        if self.next == self.ring.len() {
            self.next = 0;
            self.is_full = true;
        }
        if self.is_full {
            let mean = self.sum / self.ring.len() as f64;
            let [least, greatest] = self.means;
            self.means = [least.min(mean), greatest.max(mean)];
        }
    }

    /// What does not count windows.
    pub fn spread(&self) -> &Spread {
        &self.spread
    }

    /// Least and greatest mean; none where there was no whole window.
    pub fn means(&self) -> Option<[f64; 2]> {
        self.is_full.then_some(self.means)
    }

    /// Greatest magnitude of the mean; of what there was where that is shorter than a window.
    pub fn greatest_mean(&self) -> f64 {
        let magnitude = |[least, greatest]: [f64; 2]| greatest.max(-least);
        let of_all = || (self.sum / self.next.max(1) as f64).abs();
        self.means().map_or_else(of_all, magnitude)
    }
}

impl Longest {
    pub fn add(&mut self, is_so: bool) {
        self.now = if is_so { self.now + 1 } else { 0 };
        self.longest = self.longest.max(self.now);
    }

    pub fn ticks(&self) -> u64 {
        self.longest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Over `0, 1, ... 99` windows of 10 have means from 4.5 to 94.5.
    #[test]
    fn windows_of_a_ramp_have_the_mean_of_their_middle() {
        let mut ramp = Windowed::new(10);
        for tick in 0..100 {
            assert_eq!(ramp.means().is_some(), tick >= 10);
            ramp.add(f64::from(tick));
        }
        assert_eq!(ramp.means(), Some([4.5, 94.5]));
        assert_eq!((ramp.spread().mean(), ramp.greatest_mean()), (49.5, 94.5));
        assert_eq!(ramp.spread().greatest(), 99.0);
    }

    /// A step of 3 ticks within a window of 4 has three quarters of its height, and negative ones count by their magnitude.
    #[test]
    fn a_step_counts_by_its_share_of_the_window() {
        let mut step = Windowed::new(4);
        for tick in 0..20 {
            step.add(if (8..11).contains(&tick) { -8.0 } else { 0.0 });
        }
        assert_eq!(step.means(), Some([-6.0, 0.0]));
        assert_eq!(step.greatest_mean(), 6.0);
        assert!((step.spread().rms() - (3.0 * 64.0 / 20.0_f64).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn the_longest_stretch_counts() {
        let mut longest = Longest::default();
        for is_so in [true, true, false, true, true, true, false, true] {
            longest.add(is_so);
        }
        assert_eq!(longest.ticks(), 3);
    }
}
