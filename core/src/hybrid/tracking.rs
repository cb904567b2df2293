//! How well the measured displacement follows the desired one.

use super::limits::{self, credible};
use super::motion::Motion;
use crate::BuildError;

/// Means over the fading past from which delay, amplitude and error follow.
///
/// The error is fitted by the desired displacement and velocity, all without their means, by least squares. For a sine
/// this gives amplitude and delay exactly, for any delay up to half a period; for other motion it gives those at its
/// main frequency (the frequency evaluation index of Guo and others, 2014).
///
/// ```
/// use dashpot_core::hybrid::{Motion, Tracking};
///
/// let mut tracking = Tracking::new(2.0, 1e-3)?;
/// let omega = 20.0_f32;
/// for tick in 0..10_000 {
///     let t = 1e-3 * tick as f32;
///     let desired = Motion {
///         velocity_m_per_s: 0.1 * (omega * t).cos(),
///         ..Motion::at_rest(0.005 * (omega * t).sin())
///     };
///     tracking.observe(&desired, 0.9 * 0.005 * (omega * (t - 0.012)).sin());
/// }
/// let reading = tracking.reading();
/// assert!((reading.delay_s - 0.012).abs() < 1e-4, "{reading:?}");
/// assert!((reading.amplitude - 0.9).abs() < 2e-3);
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracking {
    fading: f32,
    desired_mean: f32,
    velocity_mean: f32,
    error_mean: f32,
    /// Means of products: desired squared, velocity squared, both, error with each, error squared.
    desired_square: f32,
    velocity_square: f32,
    crossed: f32,
    with_desired: f32,
    with_velocity: f32,
    error_square: f32,
}

/// Result of [`Tracking`] over the fading past.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackingReading {
    /// Time by which the measured displacement is late (s); negative if it is early.
    pub delay_s: f32,
    /// Amplitude of the measured displacement relative to the desired one (1).
    pub amplitude: f32,
    /// Root mean square of measured minus desired displacement, relative to that of the desired one about its mean (1).
    pub relative_error: f32,
    /// Root mean square of measured minus desired displacement (m).
    pub error_m: f32,
}

impl Tracking {
    /// A comparison in which motion `window_s` ago counts 1/e; 0.05 to 1000 s.
    ///
    /// # Errors
    /// A number is outside its range.
    pub fn new(window_s: f32, step_s: f32) -> Result<Self, BuildError> {
        limits::step("tracking", step_s)?;
        let field = ("tracking", "window_s");
        limits::within(field, window_s, (0.05, 1000.0), "0.05 to 1000")?;
        Ok(Self {
            fading: limits::fading(step_s, window_s),
            desired_mean: 0.0,
            velocity_mean: 0.0,
            error_mean: 0.0,
            desired_square: 0.0,
            velocity_square: 0.0,
            crossed: 0.0,
            with_desired: 0.0,
            with_velocity: 0.0,
            error_square: 0.0,
        })
    }

    /// Takes the desired motion and the measured displacement (m) of a tick.
    #[inline]
    pub fn observe(&mut self, desired: &Motion, measured_m: f32) {
        let x = credible(desired.displacement_m, 1.0);
        let v = credible(desired.velocity_m_per_s, 100.0);
        let error = credible(measured_m, 1.0) - x;
        let fading = self.fading;
        for (mean, value) in [
            (&mut self.desired_mean, x),
            (&mut self.velocity_mean, v),
            (&mut self.error_mean, error),
        ] {
            *mean += fading * (value - *mean);
        }
        let about_mean = x - self.desired_mean;
        let (velocity, change) = (v - self.velocity_mean, error - self.error_mean);
        for (mean, product) in [
            (&mut self.desired_square, about_mean * about_mean),
            (&mut self.velocity_square, velocity * velocity),
            (&mut self.crossed, about_mean * velocity),
            (&mut self.with_desired, change * about_mean),
            (&mut self.with_velocity, change * velocity),
            (&mut self.error_square, error * error),
        ] {
            *mean += fading * (product - *mean);
        }
    }

    /// True if the root mean square of the error is above `share` of that of the desired displacement about its mean,
    /// and above `least_m` (m).
    #[inline]
    pub fn is_off(&self, share: f32, least_m: f32) -> bool {
        self.error_square > share * share * self.desired_square
            && self.error_square > least_m * least_m
    }

    /// Delay, amplitude and errors so far. All but `error_m` are 0 if the desired displacement has hardly moved (less
    /// than 1 nm or 0.1 um/s, root mean square).
    pub fn reading(&self) -> TrackingReading {
        let [xx, vv, xv] = [self.desired_square, self.velocity_square, self.crossed];
        let [ex, ev] = [self.with_desired, self.with_velocity];
        let error_m = libm::sqrtf(self.error_square);
        let determinant = xx * vv - xv * xv;
        let has_moved = xx > 1e-18 && vv > 1e-14 && determinant > 1e-4 * xx * vv;
        if !has_moved {
            return TrackingReading {
                error_m,
                ..TrackingReading::default()
            };
        }
        // error = p x + q v; for a sine, v = omega times the displacement a quarter of a period ahead.
        let omega = libm::sqrtf(vv / xx);
        let in_phase = 1.0 + (ex * vv - ev * xv) / determinant;
        let behind = -omega * ((ev * xx - ex * xv) / determinant);
        TrackingReading {
            delay_s: libm::atan2f(behind, in_phase) / omega,
            amplitude: libm::sqrtf(in_phase * in_phase + behind * behind),
            relative_error: error_m / libm::sqrtf(xx),
            error_m,
        }
    }
}
