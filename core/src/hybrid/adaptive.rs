//! Compensation by an inverse that adapts (Chae, Kazemibidokhti and Ricles, 2013).

use super::compensator::Compensator;
use super::inverse;
use super::limits::{self, clamped, credible};
use super::motion::{Chain, Motion};
use crate::BuildError;

/// Number of coefficients.
const COUNT: usize = 4;
const SECTION: &str = "adaptive";

/// Settings of an [`AdaptiveTimeSeries`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveSettings {
    /// Coefficients at the start, 1 to s^3; see [`InverseModel`](super::InverseModel).
    pub nominal: [f32; 4],
    /// Largest change of each coefficient in either direction, 1 to s^3; 0 keeps a coefficient.
    pub largest_change: [f32; 4],
    /// Misfit of command and measurement that says nothing about the coefficients (m), root mean square: sensor noise
    /// and everything that four coefficients cannot describe. 1e-7 to 0.01.
    pub noise_m: f32,
    /// Motion below which the coefficients are frozen (m), 0 to 1: velocity over the pole of the filters. A steady
    /// displacement is no motion, whatever its size.
    pub least_motion_m: f32,
    /// Pole of the low-pass filters before the comparison (Hz), 0.1 to 1000 and to a tenth of the rate of the ticks.
    /// Coefficients are fitted to motion below it.
    pub pole_hz: f32,
    /// Time after which a past motion counts 1/e (s), 0.1 to 1000.
    pub memory_s: f32,
    /// Shortest time for the largest change of a coefficient (s), 0.01 to 1000.
    pub change_s: f32,
}

impl AdaptiveSettings {
    /// Settings for an actuator whose nominal inverse is `nominal` and whose delay may differ by `delay_error_s`.
    ///
    /// ```
    /// use dashpot_core::hybrid::{AdaptiveSettings, AdaptiveTimeSeries};
    ///
    /// let settings = AdaptiveSettings::new([1.0, 0.02, 2e-4, 0.0], 0.005);
    /// let compensator = AdaptiveTimeSeries::new(&settings, 1e-3)?;
    /// assert_eq!(compensator.coefficients(), settings.nominal);
    /// # Ok::<(), dashpot_core::BuildError>(())
    /// ```
    pub fn new(nominal: [f32; 4], delay_error_s: f32) -> Self {
        let delay = nominal[1].abs() + delay_error_s.abs();
        Self {
            nominal,
            largest_change: [
                0.1,
                delay_error_s,
                delay * delay_error_s,
                0.5 * delay * delay * delay_error_s,
            ],
            noise_m: 1e-5,
            least_motion_m: 2e-5,
            pole_hz: 20.0,
            memory_s: 2.0,
            change_s: 1.0,
        }
    }
}

/// The command `u = a0 x + a1 x' + a2 x'' + a3 x'''`, with coefficients that follow the actuator.
///
/// The coefficients minimise, over the fading past, the squared difference between the low-passed command and the same
/// series of the low-passed measurement, in units of `noise_m`, plus the squared change from `nominal` in units of
/// `largest_change`. Motion that says nothing about a coefficient thus leaves it at its nominal value. In each tick one
/// coefficient in turn takes the products of the tick into its means, and moves towards the minimum along it, within
/// its bounds and at most at its rate. This coordinate descent has a fixed cost and divides by at least 1.
///
/// ```
/// use dashpot_core::hybrid::{AdaptiveSettings, AdaptiveTimeSeries, Compensator, Motion};
///
/// // The actuator moves 4 % too little, 5 ticks late.
/// let mut compensator = AdaptiveTimeSeries::new(&AdaptiveSettings::new([1.0, 0.0, 0.0, 0.0], 0.01), 1e-3)?;
/// let mut commands_m = [0.0; 6];
/// let mut worst_m = 0.0_f32;
/// for tick in 0..8000 {
///     let (sine, cosine) = (15.0e-3 * tick as f32).sin_cos();
///     let desired = Motion {
///         displacement_m: 0.005 * sine,
///         velocity_m_per_s: 0.075 * cosine,
///         acceleration_m_per_s2: -1.125 * sine,
///         jerk_m_per_s3: -16.875 * cosine,
///     };
///     let sent_m = compensator.command_m(&desired);
///     commands_m.rotate_right(1);
///     commands_m[0] = sent_m;
///     let measured_m = 0.96 * commands_m[5];
///     compensator.observe(sent_m, measured_m);
///     if tick > 4000 {
///         worst_m = worst_m.max((measured_m - desired.displacement_m).abs());
///     }
/// }
/// assert!(worst_m < 0.002 * 0.005, "{worst_m}"); // 8.5 % without compensation
/// # Ok::<(), dashpot_core::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AdaptiveTimeSeries {
    nominal: [f32; COUNT],
    largest_change: [f32; COUNT],
    /// Nominal coefficients for low-passed derivatives that are divided by powers of the pole.
    scaled_nominal: [f32; COUNT],
    /// Factors of those derivatives: largest change of the coefficient over noise (1/m).
    sensitivity: [f32; COUNT],
    noise_per_m: f32,
    least_square: f32,
    /// Share of the past that fades from one turn of a coefficient to the next.
    fading: f32,
    /// Largest move of a coefficient in its turn, as a share of its largest change.
    largest_move: f32,
    commands: Chain<3>,
    measurements: Chain<3>,
    /// Means of the products of the sensed derivatives; each row is taken at the turns of its coefficient.
    products: [[f32; COUNT]; COUNT],
    /// Means of the products of sensed derivative and misfit.
    misfits: [f32; COUNT],
    /// Changes of the coefficients as shares of the largest change, -1 to 1.
    shares: [f32; COUNT],
    /// The coefficient whose turn it is.
    turn: usize,
    /// Fading peak of the squared motion (m^2).
    motion_square: f32,
    is_frozen: bool,
}

impl AdaptiveTimeSeries {
    /// A compensator with the nominal coefficients, at rest at 0.
    ///
    /// # Errors
    /// A setting is outside its range.
    pub fn new(settings: &AdaptiveSettings, step_s: f32) -> Result<Self, BuildError> {
        let check =
            |field, value, range, allowed| limits::within((SECTION, field), value, range, allowed);
        limits::step(SECTION, step_s)?;
        inverse::check(SECTION, settings.nominal)?;
        let [c0, c1, c2, c3] = settings.largest_change;
        check("largest_change of a0", c0, (0.0, 0.5), "0 to 0.5")?;
        check("largest_change of a1_s", c1, (0.0, 0.2), "0 to 0.2")?;
        check("largest_change of a2_s2", c2, (0.0, 0.02), "0 to 0.02")?;
        check("largest_change of a3_s3", c3, (0.0, 0.002), "0 to 0.002")?;
        check("noise_m", settings.noise_m, (1e-7, 0.01), "1e-7 to 0.01")?;
        check(
            "least_motion_m",
            settings.least_motion_m,
            (0.0, 1.0),
            "0 to 1",
        )?;
        let tenth = "0.1 to 1000 and to a tenth of the rate of the ticks";
        check(
            "pole_hz",
            settings.pole_hz,
            (0.1, 1000_f32.min(0.1 / step_s)),
            tenth,
        )?;
        check("memory_s", settings.memory_s, (0.1, 1000.0), "0.1 to 1000")?;
        check(
            "change_s",
            settings.change_s,
            (0.01, 1000.0),
            "0.01 to 1000",
        )?;

        let pole_per_s = core::f32::consts::TAU * settings.pole_hz;
        let mut scaled_nominal = settings.nominal;
        let mut sensitivity = settings.largest_change;
        let mut power = 1.0;
        for (nominal, sensitivity) in scaled_nominal.iter_mut().zip(&mut sensitivity) {
            *nominal *= power;
            *sensitivity *= power / settings.noise_m;
            power *= pole_per_s;
            if *sensitivity > 1e8 {
                let allowed = "so large that largest_change times the powers of the pole is at most 1e8 noises a metre";
                let field = (SECTION, "noise_m");
                return Err(limits::refused(field, settings.noise_m, allowed));
            }
        }
        let chain = Chain::new(pole_per_s, step_s);
        Ok(Self {
            nominal: settings.nominal,
            largest_change: settings.largest_change,
            scaled_nominal,
            sensitivity,
            noise_per_m: 1.0 / settings.noise_m,
            least_square: settings.least_motion_m * settings.least_motion_m,
            fading: limits::fading(COUNT as f32 * step_s, settings.memory_s),
            largest_move: COUNT as f32 * step_s / settings.change_s,
            commands: chain,
            measurements: chain,
            products: [[0.0; COUNT]; COUNT],
            misfits: [0.0; COUNT],
            shares: [0.0; COUNT],
            turn: 0,
            motion_square: 0.0,
            is_frozen: true,
        })
    }

    /// The present coefficients, 1 to s^3.
    #[inline]
    pub fn coefficients(&self) -> [f32; 4] {
        let mut coefficients = self.nominal;
        let changes = self.largest_change.iter().zip(&self.shares);
        for (coefficient, (largest, share)) in coefficients.iter_mut().zip(changes) {
            *coefficient += largest * share;
        }
        coefficients
    }

    /// True if the last motion was too small to learn from.
    pub fn is_frozen(&self) -> bool {
        self.is_frozen
    }
}

impl Compensator for AdaptiveTimeSeries {
    #[inline]
    fn command_m(&mut self, desired: &Motion) -> f32 {
        desired.series(self.coefficients())
    }

    #[inline]
    fn observe(&mut self, sent_m: f32, measured_m: f32) {
        // The bounds keep all products finite.
        let [command, ..] = self.commands.push(credible(sent_m, 1.0));
        let low_passed = self.measurements.push(credible(measured_m, 1.0));
        let mut misfit = command;
        let mut sensed = [0.0; COUNT];
        for index in 0..COUNT {
            misfit -= self.scaled_nominal[index] * low_passed[index];
            sensed[index] = self.sensitivity[index] * low_passed[index];
        }
        misfit *= self.noise_per_m;
        let square = low_passed[1] * low_passed[1];
        let faded = self.motion_square - self.fading * self.motion_square;
        self.motion_square = if square > faded { square } else { faded };
        self.is_frozen = self.motion_square < self.least_square;
        if self.is_frozen {
            return;
        }
        let row = self.turn % COUNT;
        self.turn = row + 1;
        let (fading, weight, share) = (self.fading, sensed[row], self.shares[row]);
        let mean = &mut self.misfits[row];
        *mean += fading * (weight * misfit - *mean);
        let mut slope = *mean - share;
        let products = &mut self.products[row];
        for column in 0..COUNT {
            products[column] += fading * (weight * sensed[column] - products[column]);
            slope -= products[column] * self.shares[column];
        }
        let change = slope / (1.0 + products[row]);
        self.shares[row] = clamped(share + clamped(change, self.largest_move), 1.0);
    }

    fn rest_at(&mut self, displacement_m: f32) {
        self.commands.rest_at(self.nominal[0] * displacement_m);
        self.measurements.rest_at(displacement_m);
        self.products = [[0.0; COUNT]; COUNT];
        self.misfits = [0.0; COUNT];
        self.shares = [0.0; COUNT];
        self.motion_square = 0.0;
        self.is_frozen = true;
    }
}
