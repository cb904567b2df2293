//! Frequency response of a damper: first harmonic of the settled force over that of the displacement (describing function), and the
//! linearised one.

use std::f64::consts::TAU;

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{Element, STEP_RANGE_S};
use serde::Serialize;

use super::TestbenchError;
use super::bench_test::{Cycle, run_until_periodic};
use dashpot_files::harmonic::Harmonic;

/// Steps of a cycle, where the shortest step allows as many: the first harmonic is then within 1e-5.
const STEPS: f64 = 4000.0;

/// Peak velocity that counts as small, m/s: that of the secant by which a vehicle's modes have a damper.
pub const SMALL_VELOCITY_M_PER_S: f64 = 1e-4;

/// A force of this amplitude is rounding (N).
const ROUNDING_N: f64 = 1e-9;

/// Response of a damper to a harmonic motion `x = A sin w t`: of its force `F` the part of the same frequency,
/// `F_1 = A (K' sin w t + K'' cos w t)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Response {
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Amplitude A (m).
    pub amplitude_m: f64,
    /// Storage stiffness K', in phase with the displacement (N/m).
    pub storage_n_per_m: f64,
    /// Loss stiffness K'', in phase with the velocity (N/m); `pi A^2 K''` is the energy of a cycle.
    pub loss_n_per_m: f64,
}

impl Response {
    /// That of a periodic cycle.
    pub fn of(cycle: &Cycle) -> Self {
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

    /// Dynamic stiffness, the magnitude `|K' + i K''|` of force over displacement (N/m).
    pub fn stiffness_n_per_m(&self) -> f64 {
        self.storage_n_per_m.hypot(self.loss_n_per_m)
    }

    /// Phase by which the force leads the displacement (rad): 0 of a spring, a quarter turn of a dashpot.
    pub fn phase_rad(&self) -> f64 {
        self.loss_n_per_m.atan2(self.storage_n_per_m)
    }

    /// Loss angle, that phase in degrees; `None` without force.
    pub fn loss_angle_deg(&self) -> Option<f64> {
        self.has_force().then(|| self.phase_rad().to_degrees())
    }

    /// By how much the force differs from that of `other` at the same motion, over it: `|K - K_o|/|K_o|` of the complex stiffnesses
    /// (1); `None` where the other has no force.
    pub fn difference_from(&self, other: &Self) -> Option<f64> {
        let storage = self.storage_n_per_m - other.storage_n_per_m;
        let loss = self.loss_n_per_m - other.loss_n_per_m;
        other
            .has_force()
            .then(|| storage.hypot(loss) / other.stiffness_n_per_m())
    }

    /// Whether there is a force: within the clearance there is none.
    pub fn has_force(&self) -> bool {
        self.stiffness_n_per_m() * self.amplitude_m > ROUNDING_N
    }

    /// Damping, the part of force over velocity in phase with the velocity, `K''/w` (N s/m).
    pub fn damping_n_s_per_m(&self) -> f64 {
        self.loss_n_per_m / (TAU * self.frequency_hz)
    }

    /// Magnitude of force over velocity (N s/m).
    pub fn impedance_n_s_per_m(&self) -> f64 {
        self.stiffness_n_per_m() / (TAU * self.frequency_hz)
    }
}

/// `count` frequencies with equal ratios, two or more (Hz).
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

/// The response at each frequency (Hz) to a motion of `amplitude_m`: the describing function, by the core's step in double precision until
/// the force is periodic.
///
/// # Errors
/// As [`run_until_periodic`].
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::response;
/// // A spring of 8 MN/m behind a dashpot of 120 kN s/m: C w/sqrt(1 + (C w/K)^2).
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

/// The linearised response at each frequency (Hz): to motions of a peak velocity of [`SMALL_VELOCITY_M_PER_S`], the clearance taken up
/// and without the friction of the seals, which would hold so small a motion.
///
/// # Errors
/// As [`run_until_periodic`].
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
        // A whole number of steps, each within what a damper can be built for.
        let steps = STEPS
            .min((period_s / STEP_RANGE_S.start()).floor())
            .max((period_s / STEP_RANGE_S.end()).ceil());
        let step_s = period_s / steps;
        let cycle = run_until_periodic(parameters, motion, step_s)?;
        Ok(Response::of(&cycle))
    };
    motions.map(of_motion).collect()
}
