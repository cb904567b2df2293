//! A frequency at which the loop has magnitude 1.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::error::PlanError;

/// Relative width at which the search for a frequency ends.
const WIDTH: f64 = 1e-13;
/// Maximum steps of the search; halving alone needs 43.
const MAX_STEPS: usize = 200;

/// A frequency at which a root of the loop is on the imaginary axis for some delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// Shortest positive delay of such a root, s.
    pub delay_s: f64,
}

impl Crossing {
    /// The crossing at `omega`, where the loop is `u/v`: `exp(j omega delay) = -u/v`.
    pub fn new(omega: f64, u: Complex<f64>, v: Complex<f64>) -> Self {
        let phase = (-u * v.conj()).arg();
        let delay_s = if phase > 0.0 { phase } else { phase + TAU } / omega;
        Self { omega, delay_s }
    }

    /// Finds the crossing between two frequencies, at which `excess` has different signs, by the method of false
    /// position with halved values (Illinois) and bisection.
    pub fn between(
        mut low: f64,
        mut high: f64,
        excess: impl Fn(f64) -> Result<(f64, Self), PlanError>,
    ) -> Result<Self, PlanError> {
        let (mut at_low, mut found) = excess(low)?;
        let (mut at_high, other) = excess(high)?;
        if at_high.abs() < at_low.abs() {
            found = other;
        }
        for step in 0..MAX_STEPS {
            if high - low <= WIDTH * high {
                break;
            }
            let secant = low - at_low * (high - low) / (at_high - at_low);
            // Each third step halves the interval whatever the values.
            let is_inside = step % 3 != 2 && secant > low && secant < high;
            let omega = if is_inside {
                secant
            } else {
                0.5 * (low + high)
            };
            let (value, crossing) = excess(omega)?;
            found = crossing;
            if value == 0.0 {
                break;
            }
            if (value > 0.0) == (at_high > 0.0) {
                (high, at_high) = (omega, value);
                at_low *= 0.5;
            } else {
                (low, at_low) = (omega, value);
                at_high *= 0.5;
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crossing_is_found_to_rounding() {
        let excess = |omega: f64| {
            let crossing = Crossing::new(omega, Complex::new(0.0, 1.0), Complex::from(1.0));
            Ok((1e-3 * (omega.powi(3) - 2.0), crossing))
        };
        let found = Crossing::between(0.1, 40.0, excess).unwrap();
        assert!((found.omega - 2.0_f64.cbrt()).abs() < 1e-12);
        // -j is a quarter turn back, or three quarters ahead.
        assert!((found.delay_s - 0.75 * TAU / found.omega).abs() < 1e-12);
    }
}
