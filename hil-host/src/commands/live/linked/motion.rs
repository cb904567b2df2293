//! The motion that drives a target's dampers.

use std::f64::consts::TAU;

use dashpot_live::{ActionError, within};
use serde_json::{Value, json};

/// Amplitudes that an operator may choose, m.
const AMPLITUDE_M: [f64; 2] = [0.0, 0.05];

/// Frequencies that an operator may choose, Hz.
const FREQUENCY_HZ: [f64; 2] = [0.1, 20.0];

/// Time in which amplitude and frequency follow what the operator wants, s.
const FOLLOW_S: f64 = 0.2;

/// Amplitude and frequency of a sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sine {
    pub amplitude_m: f64,
    pub frequency_hz: f64,
}

impl Default for Sine {
    fn default() -> Self {
        Self {
            amplitude_m: 0.005,
            frequency_hz: 1.0,
        }
    }
}

impl Sine {
    /// A sine that an operator may choose.
    ///
    /// # Errors
    /// A number is out of range.
    pub fn checked(amplitude_m: f64, frequency_hz: f64) -> Result<Self, ActionError> {
        within("amplitude_m", amplitude_m, AMPLITUDE_M)?;
        within("frequency_hz", frequency_hz, FREQUENCY_HZ)?;
        Ok(Self {
            amplitude_m,
            frequency_hz,
        })
    }

    /// The numbers and their ranges, for a page.
    pub fn scene(&self) -> Value {
        let range =
            |[min, max]: [f64; 2], value: f64| json!({"min": min, "max": max, "value": value});
        json!({
            "amplitude_m": range(AMPLITUDE_M, self.amplitude_m),
            "frequency_hz": range(FREQUENCY_HZ, self.frequency_hz),
        })
    }
}

/// A sine whose displacement has no jump when its numbers change.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub wanted: Sine,
    now: Sine,
    phase: f64,
}

impl Motion {
    /// At rest in the middle; it grows from there.
    pub fn new(wanted: Sine) -> Self {
        Self {
            wanted,
            now: Sine {
                amplitude_m: 0.0,
                ..wanted
            },
            phase: 0.0,
        }
    }

    /// The displacement after another step, m.
    pub fn next_m(&mut self, step_s: f64) -> f64 {
        let share = (step_s / FOLLOW_S).min(1.0);
        self.now.amplitude_m += share * (self.wanted.amplitude_m - self.now.amplitude_m);
        self.now.frequency_hz += share * (self.wanted.frequency_hz - self.now.frequency_hz);
        self.phase = (self.phase + TAU * self.now.frequency_hz * step_s) % TAU;
        self.now.amplitude_m * self.phase.sin()
    }
}

#[cfg(test)]
mod tests {
    use super::{AMPLITUDE_M, FREQUENCY_HZ, Motion, Sine};

    #[test]
    fn a_change_makes_no_jump() {
        let step_s = 1e-3;
        let mut motion = Motion::new(Sine::default());
        let fastest = Sine::checked(AMPLITUDE_M[1], FREQUENCY_HZ[1]).unwrap();
        let mut before_m = 0.0;
        let mut greatest_m = 0.0_f64;
        for tick in 0..4000 {
            if tick % 500 == 250 {
                motion.wanted = if tick % 1000 == 250 {
                    fastest
                } else {
                    Sine::default()
                };
            }
            let now_m = motion.next_m(step_s);
            let largest_m = std::f64::consts::TAU * FREQUENCY_HZ[1] * AMPLITUDE_M[1] * step_s;
            assert!((now_m - before_m).abs() < 1.1 * largest_m);
            greatest_m = greatest_m.max(now_m.abs());
            before_m = now_m;
        }
        assert!((0.04..0.05).contains(&greatest_m), "{greatest_m}");
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        assert!(Sine::checked(0.06, 1.0).is_err());
        assert!(Sine::checked(f64::NAN, 1.0).is_err());
        assert!(Sine::checked(0.01, 0.0).is_err());
    }
}
