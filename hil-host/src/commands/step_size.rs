//! Value of `--step-us`: a step size in microseconds.

use std::fmt;
use std::str::FromStr;

use dashpot_core::parameters::STEP_RANGE_S;

use super::failure::{Failure, Outcome};

/// Returns the shortest and longest step (us).
fn range_us() -> (f64, f64) {
    (STEP_RANGE_S.start() * 1e6, STEP_RANGE_S.end() * 1e6)
}

/// Returns the help text of a step-size option: `what` it is, the allowed range, and `more`.
pub(super) fn help(what: &str, more: &str) -> String {
    let (shortest, longest) = range_us();
    format!("{what}, us; {shortest} to {longest}, fractions allowed{more}")
}

/// A step size within [`STEP_RANGE_S`]; fractions of a microsecond are allowed.
///
/// ```
/// use dashpot_hil::commands::step_size::StepSize;
/// let step: StepSize = "62.5".parse()?;
/// assert_eq!(step.step_s(), 62.5e-6);
/// assert_eq!(step.to_string(), "62.5");
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSize {
    us: f64,
}

impl StepSize {
    /// Creates a step size from microseconds; `None` outside [`STEP_RANGE_S`].
    pub fn from_us(us: f64) -> Option<Self> {
        let step = Self { us };
        STEP_RANGE_S.contains(&step.step_s()).then_some(step)
    }

    /// Converts the step that a target reports in single precision (s).
    ///
    /// The result is the shortest decimal that rounds to it; `None` outside [`STEP_RANGE_S`].
    pub fn from_target(step_s: f32) -> Option<Self> {
        let decimal: f64 = step_s.to_string().parse().ok()?;
        // Round to the picosecond to remove the rounding error of the product.
        Self::from_us((decimal * 1e12).round() / 1e6)
    }

    /// Like [`Self::from_target`], but returns an error; for building the dampers of a target.
    ///
    /// # Errors
    /// The step is outside [`STEP_RANGE_S`].
    pub fn of_target(step_s: f32) -> Outcome<Self> {
        Self::from_target(step_s).ok_or_else(|| {
            let (shortest_us, longest_us) = range_us();
            Failure::new(format!(
                "the step of the target is {step_s} s; allowed: {shortest_us} us to {} ms",
                longest_us * 1e-3
            ))
        })
    }

    /// Returns the step in microseconds.
    pub fn step_us(self) -> f64 {
        self.us
    }

    /// Returns the step in seconds.
    pub fn step_s(self) -> f64 {
        self.us / 1e6
    }
}

impl FromStr for StepSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.parse().ok().and_then(Self::from_us).ok_or_else(|| {
            let (shortest, longest) = range_us();
            format!("allowed: {shortest} to {longest} us")
        })
    }
}

impl fmt::Display for StepSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.us.fmt(f)
    }
}
