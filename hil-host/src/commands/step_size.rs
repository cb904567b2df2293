//! The value of `--step-us`: a step size in microseconds.

use std::fmt;
use std::str::FromStr;

use crate::commands::failure::{Failure, Outcome};

/// Shortest and longest step (us), as the core builds dampers for.
const SHORTEST_US: f64 = 1.0;
const LONGEST_US: f64 = 20_000.0;

/// A step size of 1 us to 20 ms; fractions of a microsecond are allowed.
///
/// ```
/// use dashpot_hil::commands::step_size::StepSize;
/// let step: StepSize = "62.5".parse()?;
/// assert_eq!(step.seconds(), 62.5e-6);
/// assert_eq!(step.to_string(), "62.5");
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSize {
    us: f64,
}

impl StepSize {
    /// The step size of `us` (us); `None` outside 1 to 20000.
    pub fn from_us(us: f64) -> Option<Self> {
        (SHORTEST_US..=LONGEST_US)
            .contains(&us)
            .then_some(Self { us })
    }

    /// The step that a target reports in single precision (s), which stands for the shortest decimal that
    /// rounds to it; `None` outside 1 us to 20 ms.
    pub fn from_target(step_s: f32) -> Option<Self> {
        let decimal: f64 = step_s.to_string().parse().ok()?;
        // Free of the rounding of the product, to the picosecond.
        Self::from_us((decimal * 1e12).round() / 1e6)
    }

    /// As [`Self::from_target`], for building a target's dampers.
    ///
    /// # Errors
    /// The step is outside 1 us to 20 ms.
    pub fn of_target(step_s: f32) -> Outcome<Self> {
        Self::from_target(step_s).ok_or_else(|| {
            Failure::new(format!(
                "the target steps {step_s} s; allowed: 1 us to 20 ms"
            ))
        })
    }

    /// In microseconds.
    pub fn us(self) -> f64 {
        self.us
    }

    /// In seconds.
    pub fn seconds(self) -> f64 {
        self.us / 1e6
    }
}

impl FromStr for StepSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.parse()
            .ok()
            .and_then(Self::from_us)
            .ok_or_else(|| format!("allowed: {SHORTEST_US} to {LONGEST_US} us"))
    }
}

impl fmt::Display for StepSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.us.fmt(f)
    }
}
