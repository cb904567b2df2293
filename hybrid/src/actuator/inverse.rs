//! Coefficients of a compensator for an actuator that is known.

use dashpot_files::actuator::ActuatorParameters;
use nalgebra::{Complex, Matrix2, Vector2};

use super::response::response;

/// Frequencies at which the inverse is fitted.
const FREQUENCIES: u32 = 64;

/// Returns `a0` to `a3` of `u = a0 x + a1 x' + a2 x'' + a3 x'''`, the inverse of the actuator with a specimen of this
/// dynamic stiffness (N/m), from 0 to `highest_hz`. The command is held for `step_s` at a time.
///
/// The squared relative error of the displacement is least over the frequencies.
///
/// ```
/// use dashpot_files::actuator::ActuatorParameters;
/// use dashpot_hybrid::actuator::inverse_series;
/// use nalgebra::Complex;
///
/// let actuator = ActuatorParameters::load("second-order")?;
/// let [a0, a1, ..] = inverse_series(&actuator, |_| Complex::new(0.0, 0.0), 10.0, 1e-3);
/// // 2 z/w, the delay, and half a step.
/// assert!((a0 - 1.0).abs() < 1e-3 && (a1 - (0.010_186 + 0.002 + 0.0005)).abs() < 1e-4);
/// # Ok::<(), dashpot_files::actuator::ActuatorFileError>(())
/// ```
pub fn inverse_series(
    parameters: &ActuatorParameters,
    specimen_n_per_m: impl Fn(Complex<f64>) -> Complex<f64>,
    highest_hz: f64,
    step_s: f64,
) -> [f64; 4] {
    // The real part of the series is a0 - a2 w^2, the imaginary one w (a1 - a3 w^2): two lines over w^2.
    let mut lines = [(Matrix2::zeros(), Vector2::zeros()); 2];
    for number in 1..=FREQUENCIES {
        let share = f64::from(number) / f64::from(FREQUENCIES);
        let w = std::f64::consts::TAU * highest_hz * share;
        let s = Complex::new(0.0, w);
        let held = response(parameters, s, specimen_n_per_m(s)) * (-s * (0.5 * step_s)).exp();
        let inverse = held.inv();
        for ((normal, right), (value, scale)) in
            lines.iter_mut().zip([(inverse.re, 1.0), (inverse.im, w)])
        {
            let row = Vector2::new(scale, -scale * share * share);
            *normal += row * row.transpose() * held.norm_sqr();
            *right += row * value * held.norm_sqr();
        }
    }
    let per_share = 1.0 / libm::pow(std::f64::consts::TAU * highest_hz, 2.0);
    let [even, odd] = lines.map(|(normal, right)| {
        // Two or more frequencies make the equations regular.
        normal
            .try_inverse()
            .map_or(Vector2::zeros(), |inverse| inverse * right)
    });
    [even[0], odd[0], even[1] * per_share, odd[1] * per_share]
}
