//! Bench test: repeats a harmonic motion until the force is periodic, and computes the indices of one cycle.

use std::f64::consts::TAU;

use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_core::{CheckedParameters, Status};
use serde::Serialize;

use dashpot_files::harmonic::Harmonic;

pub use super::limits::STEPS_PER_CYCLE;

use super::TestbenchError;

/// The force counts as periodic when no sample changes from one cycle to the next by more than this fraction of the
/// peak.
const PERIODIC_TOLERANCE: f64 = 1e-9;

/// Maximum number of cycles until the force is periodic; after them the run ends with an error.
const MAX_CYCLES: usize = 200;

/// Ticks between two checks for cancellation.
const TICKS_PER_CHECK: usize = 1 << 16;

/// Indices of one periodic cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Indices {
    /// Maximum force in extension F_e (N).
    pub max_extension_force_n: f64,
    /// Maximum force in compression F_c (N), as a magnitude.
    pub max_compression_force_n: f64,
    /// `(F_e - F_c)/(F_e + F_c)` (1); `None` if the force is zero.
    pub asymmetry_rate: Option<f64>,
    /// Energy dissipated per cycle, the integral of F dx (J).
    pub energy_per_cycle_j: f64,
    /// Mean of F_e and F_c, divided by the peak velocity (N s/m).
    pub damping_coefficient_n_s_per_m: f64,
}

/// One periodic cycle, sampled at each step.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// The motion.
    pub motion: Harmonic,
    /// Displacements (m); the first is one step after the displacement passes zero.
    pub displacements_m: Vec<f64>,
    /// Forces (N) at these displacements.
    pub forces_n: Vec<f64>,
    /// Step used (s): the requested step, shortened so that a cycle has a whole number of steps.
    pub step_s: f64,
    /// Number of cycles until the force was periodic.
    pub cycles: usize,
}

/// Runs a damper in double precision through `motion` with steps of at most `step_s` (s) until the force is periodic.
///
/// # Errors
/// Returns an error for a motion or step out of range, a motion beyond the damper's limits, a damper that cannot be
/// built, or a force that does not become periodic.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::bench_test;
/// let damper = damper::load("reduced-vertical", &["mount.clearance_m=0.0".into()])?;
/// let motion = dashpot_files::harmonic::Harmonic { amplitude_m: 1e-3, frequency_hz: 1.0 };
/// let indices = bench_test::run_until_periodic(&damper, motion, 1e-4)?.indices();
/// // Spring K in series with dashpot C: C w A/sqrt(1 + (w C/K)^2).
/// assert!((indices.max_extension_force_n / 750.65 - 1.0).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run_until_periodic(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
) -> Result<Cycle, TestbenchError> {
    run_cancellable(parameters, motion, step_s, &|| false)
}

/// Same as [`run_until_periodic`], but stops when `is_cancelled` returns true.
///
/// # Errors
/// Same errors as [`run_until_periodic`], and [`TestbenchError::Cancelled`].
pub fn run_cancellable(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Cycle, TestbenchError> {
    let ticks = steps_per_cycle(motion, step_s)?;
    let period = 1.0 / motion.frequency_hz;
    let step_s = period / ticks as f64;
    let damper = parameters.build::<f64>(step_s)?;
    check_range(parameters, motion)?;
    let displacements: Vec<f64> = (1..=ticks)
        .map(|tick| motion.amplitude_m * (TAU * tick as f64 / ticks as f64).sin())
        .collect();
    let mut state = damper.at_rest(0.0);
    let mut forces = vec![0.0; ticks];
    for cycle in 1..=MAX_CYCLES {
        let (mut peak, mut change) = (0.0_f64, 0.0_f64);
        for (tick, (force, &x)) in forces.iter_mut().zip(&displacements).enumerate() {
            if tick.is_multiple_of(TICKS_PER_CHECK) && is_cancelled() {
                return Err(TestbenchError::Cancelled);
            }
            let before = *force;
            *force = damper.step(&mut state, x);
            peak = peak.max(force.abs());
            change = change.max((*force - before).abs());
        }
        if state.status().intersects(NOT_FOLLOWED) {
            return Err(TestbenchError::Velocity {
                velocity_m_per_s: motion.peak_velocity_m_per_s(),
                limit_m_per_s: parameters.limits.rate_m_per_s,
            });
        }
        if cycle > 1 && change <= PERIODIC_TOLERANCE * peak {
            return Ok(Cycle {
                motion,
                displacements_m: displacements,
                forces_n: forces,
                step_s,
                cycles: cycle,
            });
        }
    }
    Err(TestbenchError::NotPeriodic {
        cycles: MAX_CYCLES,
        motion,
    })
}

/// Status bits that a damper sets when it does not follow the given displacement exactly.
pub(super) const NOT_FOLLOWED: Status = Status::INPUT_LIMITED
    .union(Status::INPUT_HELD)
    .union(Status::RESTARTED);

/// Returns the number of steps per cycle.
fn steps_per_cycle(motion: Harmonic, step_s: f64) -> Result<usize, TestbenchError> {
    motion.check()?;
    if !STEP_RANGE_S.contains(&step_s) {
        return Err(TestbenchError::Step { step_s });
    }
    let ticks = (1.0 / motion.frequency_hz / step_s - 1e-9).ceil();
    if !STEPS_PER_CYCLE.contains(&ticks) {
        return Err(TestbenchError::StepsPerCycle {
            steps: ticks,
            step_s,
        });
    }
    Ok(ticks as usize)
}

/// Checks the arguments of [`run_until_periodic`] without running it.
///
/// # Errors
/// Same errors as [`run_until_periodic`], except for a force that does not become periodic.
pub fn check_steps(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
) -> Result<(), TestbenchError> {
    let ticks = steps_per_cycle(motion, step_s)?;
    let velocity_m_per_s = motion.peak_velocity_m_per_s();
    let limit_m_per_s = parameters.limits.rate_m_per_s;
    if velocity_m_per_s > limit_m_per_s {
        return Err(TestbenchError::Velocity {
            velocity_m_per_s,
            limit_m_per_s,
        });
    }
    check_range(parameters, motion)?;
    parameters.build::<f64>(1.0 / motion.frequency_hz / ticks as f64)?;
    Ok(())
}

/// Rejects an amplitude beyond the damper's range, unless the motion is also too fast, which is a separate error.
fn check_range(parameters: &CheckedParameters, motion: Harmonic) -> Result<(), TestbenchError> {
    let amplitude_m = motion.amplitude_m;
    let limit_m = parameters.limits.displacement_m;
    let is_slow = motion.peak_velocity_m_per_s() <= parameters.limits.rate_m_per_s;
    if amplitude_m > limit_m && is_slow {
        return Err(TestbenchError::Displacement {
            amplitude_m,
            limit_m,
        });
    }
    Ok(())
}

impl Cycle {
    /// Returns the velocities (m/s) at the displacements, `2 pi f A cos(2 pi f t)`.
    pub fn velocities_m_per_s(&self) -> Vec<f64> {
        let ticks = self.displacements_m.len();
        let peak = self.motion.peak_velocity_m_per_s();
        (1..=ticks)
            .map(|tick| peak * (TAU * tick as f64 / ticks as f64).cos())
            .collect()
    }

    /// Returns the force (N) at the peak velocity, where the displacement passes zero: in extension if `sign` is
    /// positive, otherwise in compression.
    pub fn force_at_peak_velocity_n(&self, sign: f64) -> f64 {
        let ticks = self.forces_n.len();
        if sign > 0.0 {
            // The last step of the cycle ends at zero displacement.
            return self.forces_n.last().copied().unwrap_or(0.0);
        }
        // Half a cycle ends at a step, or midway between two.
        let [before, after] = [ticks / 2, ticks.div_ceil(2)].map(|tick| tick.max(1) - 1);
        0.5 * (self.forces_n[before] + self.forces_n[after])
    }

    /// Returns the indices of this cycle; the trapezoidal rule gives the energy.
    pub fn indices(&self) -> Indices {
        let (forces, x) = (&self.forces_n, &self.displacements_m);
        let extension = forces.iter().fold(0.0, |max: f64, &force| max.max(force));
        let compression = forces.iter().fold(0.0, |max: f64, &force| max.max(-force));
        let ticks = forces.len();
        let energy = (0..ticks)
            .map(|tick| {
                let previous = (tick + ticks - 1) % ticks;
                0.5 * (forces[tick] + forces[previous]) * (x[tick] - x[previous])
            })
            .sum();
        let sum = extension + compression;
        Indices {
            max_extension_force_n: extension,
            max_compression_force_n: compression,
            asymmetry_rate: (sum > 0.0).then(|| (extension - compression) / sum),
            energy_per_cycle_j: energy,
            damping_coefficient_n_s_per_m: 0.5 * sum / self.motion.peak_velocity_m_per_s(),
        }
    }
}
