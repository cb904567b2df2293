//! What stands between the displacement of a simulated damper and the force that the vehicle feels, in the plan.

use dashpot_files::actuator::ActuatorParameters;
use nalgebra::Complex;

use crate::actuator::{measured_gain, response};
use crate::compensation::Compensation;
use crate::coupling::motion_hz;
use crate::specimen::Specimen;

/// Compensator, held command, actuator and exchange of a [`Coupling`](crate::Coupling) at small motion: the factor `F`
/// of [`stability`](crate::plan::stability).
///
/// A command is held for a tick, which is half a tick late on average, and its force acts a tick later, after the lag
/// of its sensor. The adaptive time series is the inverse that it starts from.
///
/// ```
/// use dashpot_files::actuator::ActuatorParameters;
/// use dashpot_hybrid::{Compensation, LoopFactor, Specimen};
/// use nalgebra::Complex;
///
/// let servo = ActuatorParameters::load("servo")?;
/// let specimen = Specimen { damping_n_s_per_m: 50e3, stiffness_n_per_m: 7e6 };
/// let s = Complex::new(0.0, 20.0);
/// let delay_s = |compensation| {
///     let factor = LoopFactor::new(&servo, specimen, (compensation, specimen), 1e-3);
///     -factor.at(s).arg() / s.im
/// };
/// assert!((delay_s(Compensation::None) - 0.022).abs() < 1e-3);
/// assert!(delay_s(Compensation::Inverse).abs() < 0.5e-3);
/// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct LoopFactor<'a> {
    actuator: &'a ActuatorParameters,
    specimen: Specimen,
    compensation: Compensation,
    series: [f64; 4],
    step_s: f64,
}

impl<'a> LoopFactor<'a> {
    /// The factor for ticks of `step_s`, with a compensator that is made for the specimen `nominal`.
    pub fn new(
        actuator: &'a ActuatorParameters,
        specimen: Specimen,
        (compensation, nominal): (Compensation, Specimen),
        step_s: f64,
    ) -> Self {
        Self {
            actuator,
            specimen,
            compensation,
            series: Compensation::series(actuator, &nominal, step_s),
            step_s,
        }
    }

    /// The factor at `s` (rad/s).
    pub fn at(&self, s: Complex<f64>) -> Complex<f64> {
        let read = (s * self.actuator.force_sensor.lag_s + 1.0).inv();
        self.command(s) * self.moved(s) * read * (-s * (1.5 * self.step_s)).exp()
    }

    /// Delay (s) and gain of the actuator alone at a frequency (Hz).
    pub fn actuator_at(&self, frequency_hz: f64) -> (f64, f64) {
        let s = Complex::new(0.0, std::f64::consts::TAU * frequency_hz);
        let moved = self.moved(s);
        let phase = moved.arg();
        // An actuator is late by less than a period.
        let behind = if phase > 0.0 {
            phase - std::f64::consts::TAU
        } else {
            phase
        };
        (-behind / s.im, moved.norm())
    }

    /// Displacement of the damper over command: that which a sensor reads is larger by its gain.
    fn moved(&self, s: Complex<f64>) -> Complex<f64> {
        let measured = response(self.actuator, s, self.specimen.dynamic_stiffness(s));
        measured / measured_gain(self.actuator)
    }

    /// Command over displacement.
    fn command(&self, s: Complex<f64>) -> Complex<f64> {
        if self.compensation == Compensation::None {
            return Complex::from(1.0);
        }
        // Displacement, velocity, acceleration and jerk from the filter of the motion, which corrects its own delay.
        let w = std::f64::consts::TAU * motion_hz(self.step_s);
        let of_w = s / w;
        let low_passed = (of_w + 1.0).powi(-3);
        let motion = [
            Complex::from(1.0),
            s * low_passed * (of_w * (of_w + 1.0) * 3.0 + 1.0),
            s * s * low_passed * (of_w * 3.0 + 1.0),
            s * s * s * low_passed,
        ];
        let h = self.step_s;
        let lead = [1.0, h, 0.5 * h * h, h * h * h / 6.0];
        let ahead = |order: usize| -> Complex<f64> {
            let terms = motion[order..].iter().zip(lead);
            terms.map(|(value, weight)| value * weight).sum()
        };
        match self.compensation {
            Compensation::Polynomial => ahead(0) * extrapolation(s, self.delay_s(), h),
            _ => (0..4).map(|order| ahead(order) * self.series[order]).sum(),
        }
    }

    fn delay_s(&self) -> f64 {
        self.series[1] / self.series[0]
    }
}

/// Cubic through samples about one delay apart, evaluated one delay ahead.
fn extrapolation(s: Complex<f64>, delay_s: f64, step_s: f64) -> Complex<f64> {
    let spacing_s = libm::round(delay_s / step_s).max(1.0) * step_s;
    let ahead = delay_s / spacing_s;
    let weight = |node: i32| -> f64 {
        let others = (0..4).filter(|other| *other != node);
        let factors = others.map(|other| (ahead + f64::from(other)) / f64::from(other - node));
        factors.product()
    };
    let terms = (0..4).map(|node| (-s * (spacing_s * f64::from(node))).exp() * weight(node));
    terms.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_extrapolated_exactly_at_low_frequency() {
        let s = Complex::new(0.0, 2.0);
        let found = extrapolation(s, 0.0214, 1e-3);
        assert!((found - (s * 0.0214).exp()).norm() < 1e-5, "{found}");
    }
}
