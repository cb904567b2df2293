//! A pure delay.

/// Delays a signal by a number of steps that need not be whole.
#[derive(Clone, Debug)]
pub(crate) struct DelayLine {
    past: Vec<f64>,
    newest: usize,
    /// Weight of the older of the two values between which the delay lies.
    older: f64,
}

impl DelayLine {
    /// A line at rest at 0.
    pub(crate) fn new(delay_steps: f64) -> Self {
        // Rounding must not turn a whole number of steps into the next lower one.
        let whole = libm::floor(delay_steps + 1e-9);
        Self {
            past: vec![0.0; whole as usize + 2],
            newest: 0,
            older: (delay_steps - whole).max(0.0),
        }
    }

    /// Takes the value of this step; returns the delayed one, linear between values.
    pub(crate) fn push(&mut self, value: f64) -> f64 {
        let count = self.past.len();
        self.newest = (self.newest + 1) % count;
        self.past[self.newest] = value;
        let oldest = self.past[(self.newest + 1) % count];
        let next = self.past[(self.newest + 2) % count];
        next + self.older * (oldest - next)
    }
}

#[cfg(test)]
mod tests {
    use super::DelayLine;

    #[test]
    fn a_ramp_comes_out_as_late_as_the_delay() {
        for delay in [0.0, 0.25, 1.0, 1.5, 7.0, 7.9] {
            let mut line = DelayLine::new(delay);
            let mut out = 0.0;
            for step in 0..20 {
                out = line.push(f64::from(step));
            }
            assert!((out - (19.0 - delay)).abs() < 1e-12, "{delay}: {out}");
        }
    }
}
