//! Compensation by the inverse of a known actuator.

use super::compensator::Compensator;
use super::limits;
use super::motion::Motion;
use crate::BuildError;

/// The command `u = a0 x + a1 x' + a2 x'' + a3 x'''`, the inverse of an actuator at low frequencies.
///
/// The coefficients are those of the Taylor series of `1/G(s)`, with the transfer function `G` from command to measured
/// displacement. For a pure delay `tau` they are `tau^n/n!`.
///
/// ```
/// use dashpot_core::hybrid::{Compensator, InverseModel, Motion};
///
/// let mut inverse = InverseModel::of_delay(0.01)?;
/// let motion = Motion { velocity_m_per_s: 0.1, ..Motion::at_rest(0.0) };
/// assert!((inverse.command_m(&motion) - 0.001).abs() < 1e-9);
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseModel {
    coefficients: [f32; 4],
}

impl InverseModel {
    /// The inverse with the coefficients `a0` (1) to `a3` (s^3).
    ///
    /// # Errors
    /// `a0` is not between 0.2 and 5, or another coefficient exceeds 0.2 s, 0.02 s^2 or 0.002 s^3 in magnitude.
    pub fn new(coefficients: [f32; 4]) -> Result<Self, BuildError> {
        check("inverse", coefficients)?;
        Ok(Self { coefficients })
    }

    /// The inverse of a pure delay (s), 0 to 0.2, to the third order.
    ///
    /// # Errors
    /// The delay is outside its range.
    pub fn of_delay(delay_s: f32) -> Result<Self, BuildError> {
        limits::within(("inverse", "delay_s"), delay_s, (0.0, 0.2), "0 to 0.2")?;
        let square = delay_s * delay_s;
        Self::new([1.0, delay_s, square / 2.0, square * delay_s / 6.0])
    }

    /// The coefficients `a0` (1) to `a3` (s^3).
    pub const fn coefficients(&self) -> [f32; 4] {
        self.coefficients
    }
}

impl Compensator for InverseModel {
    fn command_m(&mut self, desired: &Motion) -> f32 {
        desired.series(self.coefficients)
    }

    fn rest_at(&mut self, _: f32) {}
}

/// Checks the coefficients of an inverse.
pub(super) fn check(section: &'static str, a: [f32; 4]) -> Result<(), BuildError> {
    limits::within((section, "a0"), a[0], (0.2, 5.0), "0.2 to 5")?;
    limits::within((section, "a1_s"), a[1], (-0.2, 0.2), "-0.2 to 0.2")?;
    limits::within((section, "a2_s2"), a[2], (-0.02, 0.02), "-0.02 to 0.02")?;
    limits::within((section, "a3_s3"), a[3], (-0.002, 0.002), "-0.002 to 0.002")
}
