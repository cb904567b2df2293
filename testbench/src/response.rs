//! Frequency response of a damper: the describing function, which is the first harmonic of the periodic force divided
//! by that of the displacement, and the linearised response.

use std::f64::consts::TAU;

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{Element, STEP_RANGE_S};
use serde::Serialize;

use super::TestbenchError;
use super::bench_test::{Cycle, run_until_periodic};
use dashpot_files::harmonic::Harmonic;

/// Steps per cycle, if the minimum step allows that many; the first harmonic is then accurate to 1e-5.
const STEPS_PER_CYCLE: f64 = 4000.0;

/// Peak velocity of the linearised response (m/s); the modal analysis of vehicles linearises dampers by a secant at the
/// same velocity.
pub const SMALL_VELOCITY_M_PER_S: f64 = 1e-4;

/// Minimum force amplitude (N); a smaller force counts as a rounding error.
const ROUNDING_N: f64 = 1e-9;

/// Response of a damper to a harmonic motion `x = A sin w t`: the first harmonic of the force,
/// `F_1 = A (K' sin w t + K'' cos w t)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Response {
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Amplitude A (m).
    pub amplitude_m: f64,
    /// Storage stiffness K', in phase with the displacement (N/m).
    pub storage_n_per_m: f64,
    /// Loss stiffness K'', in phase with the velocity (N/m); the energy per cycle is `pi A^2 K''`.
    pub loss_n_per_m: f64,
}

impl Response {
    /// Computes the response from a periodic cycle.
    pub fn from_cycle(cycle: &Cycle) -> Self {
        let Harmonic {
            amplitude_m,
            frequency_hz,
        } = cycle.motion;
        let ticks = cycle.forces_n.len() as f64;
        let (mut sine, mut cosine) = (0.0, 0.0);
        for (tick, force) in (1..).zip(&cycle.forces_n) {
            let angle = TAU * f64::from(tick) / ticks;
            sine += force * angle.sin();
            cosine += force * angle.cos();
        }
        let scale = 2.0 / (ticks * amplitude_m);
        Self {
            frequency_hz,
            amplitude_m,
            storage_n_per_m: scale * sine,
            loss_n_per_m: scale * cosine,
        }
    }

    /// Returns the dynamic stiffness, the magnitude of force over displacement `|K' + i K''|` (N/m).
    pub fn stiffness_n_per_m(&self) -> f64 {
        self.storage_n_per_m.hypot(self.loss_n_per_m)
    }

    /// Returns the phase by which the force leads the displacement (rad): 0 for a spring, pi/2 for a dashpot.
    pub fn phase_rad(&self) -> f64 {
        self.loss_n_per_m.atan2(self.storage_n_per_m)
    }

    /// Returns the loss angle, which is the phase in degrees; `None` if there is no force.
    pub fn loss_angle_deg(&self) -> Option<f64> {
        self.has_force().then(|| self.phase_rad().to_degrees())
    }

    /// Returns the relative difference from `other` at the same motion, `|K - K_o|/|K_o|` of the complex stiffnesses
    /// (1); `None` if `other` has no force.
    pub fn difference_from(&self, other: &Self) -> Option<f64> {
        let storage = self.storage_n_per_m - other.storage_n_per_m;
        let loss = self.loss_n_per_m - other.loss_n_per_m;
        other
            .has_force()
            .then(|| storage.hypot(loss) / other.stiffness_n_per_m())
    }

    /// True if there is a force; there is none within the clearance.
    pub fn has_force(&self) -> bool {
        self.stiffness_n_per_m() * self.amplitude_m > ROUNDING_N
    }

    /// Returns the damping, the component of force over velocity in phase with the velocity, `K''/w` (N s/m).
    pub fn damping_n_s_per_m(&self) -> f64 {
        self.loss_n_per_m / (TAU * self.frequency_hz)
    }

    /// Returns the impedance, the magnitude of force over velocity (N s/m).
    pub fn impedance_n_s_per_m(&self) -> f64 {
        self.stiffness_n_per_m() / (TAU * self.frequency_hz)
    }
}

/// Returns `count` (at least 2) logarithmically spaced frequencies (Hz).
///
/// ```
/// let decades = dashpot_testbench::response::frequencies(0.1, 10.0, 3);
/// assert!(decades.iter().zip([0.1, 1.0, 10.0]).all(|(found, expected)| (found / expected - 1.0).abs() < 1e-15));
/// ```
pub fn frequencies(from_hz: f64, to_hz: f64, count: usize) -> Vec<f64> {
    let ratio = (to_hz / from_hz).ln() / (count.max(2) - 1) as f64;
    let at = |i: usize| match i {
        0 => from_hz,
        _ if i + 1 == count => to_hz,
        _ => from_hz * (ratio * i as f64).exp(),
    };
    (0..count).map(at).collect()
}

/// Computes the describing function at each frequency (Hz) for an amplitude (m).
///
/// Runs the core's step in double precision until the force is periodic.
///
/// # Errors
/// Same errors as [`run_until_periodic`].
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::response;
/// // Spring of 8 MN/m in series with a dashpot of 120 kN s/m: C w/sqrt(1 + (C w/K)^2).
/// let damper = damper::load("reduced-vertical", &["mount.clearance_m=0.0".into()])?;
/// for response in response::at_amplitude(&damper, 0.5e-3, &[0.5, 2.0, 8.0])? {
///     let dashpot = 120e3 * std::f64::consts::TAU * response.frequency_hz;
///     let expected = dashpot / (1.0 + (dashpot / 8e6).powi(2)).sqrt();
///     assert!((response.stiffness_n_per_m() / expected - 1.0).abs() < 1e-3);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn at_amplitude(
    parameters: &CheckedParameters,
    amplitude_m: f64,
    frequencies_hz: &[f64],
) -> Result<Vec<Response>, TestbenchError> {
    let motion = |frequency_hz: f64| Harmonic {
        amplitude_m,
        frequency_hz,
    };
    let frequencies = frequencies_hz.iter().copied();
    responses(parameters, frequencies.map(motion))
}

/// Computes the linearised response at each frequency (Hz). The motions have a peak velocity of
/// [`SMALL_VELOCITY_M_PER_S`]; the clearance is taken up, and seal friction is omitted because it would block such
/// small motions.
///
/// # Errors
/// Same errors as [`run_until_periodic`].
pub fn linearised(
    parameters: &CheckedParameters,
    frequencies_hz: &[f64],
) -> Result<Vec<Response>, TestbenchError> {
    let mut taken_up = (**parameters).clone();
    taken_up.mount.clearance_m = 0.0;
    if let Element::Physical(hydraulics) = &mut taken_up.element {
        hydraulics.seal = None;
    }
    let motion = |frequency_hz: f64| Harmonic {
        amplitude_m: SMALL_VELOCITY_M_PER_S / (TAU * frequency_hz),
        frequency_hz,
    };
    let frequencies = frequencies_hz.iter().copied();
    responses(&taken_up.check()?, frequencies.map(motion))
}

fn responses(
    parameters: &CheckedParameters,
    motions: impl Iterator<Item = Harmonic>,
) -> Result<Vec<Response>, TestbenchError> {
    let of_motion = |motion: Harmonic| {
        let period_s = 1.0 / motion.frequency_hz;
        // A whole number of steps per cycle, for a step at which a damper can be built.
        let steps = STEPS_PER_CYCLE
            .min((period_s / STEP_RANGE_S.start()).floor())
            .max((period_s / STEP_RANGE_S.end()).ceil());
        let step_s = period_s / steps;
        let cycle = run_until_periodic(parameters, motion, step_s)?;
        Ok(Response::from_cycle(&cycle))
    };
    motions.map(of_motion).collect()
}
