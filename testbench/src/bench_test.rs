//! Bench test: a harmonic motion until the force is periodic, and the indices of one periodic cycle.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_core::{CheckedParameters, Status};
use serde::Serialize;

use dashpot_files::harmonic::Harmonic;

use super::TestbenchError;

/// The force is periodic when none differs from the cycle before by more than this fraction of the peak.
const PERIODIC: f64 = 1e-9;

/// A force that is not periodic after so many cycles will not become so.
const MOST_CYCLES: usize = 200;

/// Ticks between two looks whether the cycle is still wanted.
const TICKS_A_LOOK: usize = 1 << 16;

/// Steps that a cycle may have.
pub const STEPS_PER_CYCLE: RangeInclusive<f64> = 20.0..=2e7;

/// Indices of one periodic cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Indices {
    /// Largest force in extension F_e (N).
    pub max_extension_force_n: f64,
    /// Largest force in compression F_c (N), as a magnitude.
    pub max_compression_force_n: f64,
    /// `(F_e - F_c)/(F_e + F_c)` (1); `None` without force.
    pub asymmetry_rate: Option<f64>,
    /// Energy taken from the motion in the cycle, the integral of F dx (J).
    pub energy_per_cycle_j: f64,
    /// Mean of both largest forces over the peak velocity (N s/m).
    pub damping_coefficient_n_s_per_m: f64,
}

/// One periodic cycle: displacement (m) and force (N) at each step.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// The motion.
    pub motion: Harmonic,
    /// Displacements (m), from the first step after zero.
    pub displacements_m: Vec<f64>,
    /// Forces (N) at them.
    pub forces_n: Vec<f64>,
    /// Step used (s): the requested one, shortened to a whole number of steps a cycle.
    pub step_s: f64,
    /// Cycles run until the force was periodic.
    pub cycles: usize,
}

/// Runs a damper in double precision through `motion` with steps of at most `step_s` (s) until the
/// force is periodic.
///
/// # Errors
/// A motion or step outside its range or faster than the damper's limit; a damper that does not build;
/// a force that does not become periodic.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::bench_test;
/// let damper = damper::load("reduced-vertical", &["mount.clearance_m=0.0".into()])?;
/// let motion = dashpot_files::harmonic::Harmonic { amplitude_m: 1e-3, frequency_hz: 1.0 };
/// let indices = bench_test::run_until_periodic(&damper, motion, 1e-4)?.indices();
/// // A spring K behind a damper C: C w A/sqrt(1 + (w C/K)^2).
/// assert!((indices.max_extension_force_n / 750.65 - 1.0).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run_until_periodic(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
) -> Result<Cycle, TestbenchError> {
    run_unless(parameters, motion, step_s, &|| false)
}

/// As [`run_until_periodic`], until it is unwanted.
///
/// # Errors
/// As [`run_until_periodic`]; [`TestbenchError::Unwanted`].
pub fn run_unless(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
    is_unwanted: &dyn Fn() -> bool,
) -> Result<Cycle, TestbenchError> {
    let ticks = ticks_of(motion, step_s)?;
    let period = 1.0 / motion.frequency_hz;
    let step_s = period / ticks as f64;
    let damper = parameters.build::<f64>(step_s)?;
    check_range(parameters, motion)?;
    let displacements: Vec<f64> = (1..=ticks)
        .map(|tick| motion.amplitude_m * (TAU * tick as f64 / ticks as f64).sin())
        .collect();
    let mut state = damper.at_rest(0.0);
    let mut forces = vec![0.0; ticks];
    for cycle in 1..=MOST_CYCLES {
        let (mut peak, mut change) = (0.0_f64, 0.0_f64);
        for (tick, (force, &x)) in forces.iter_mut().zip(&displacements).enumerate() {
            if tick.is_multiple_of(TICKS_A_LOOK) && is_unwanted() {
                return Err(TestbenchError::Unwanted);
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
        if cycle > 1 && change <= PERIODIC * peak {
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
        cycles: MOST_CYCLES,
        motion,
    })
}

/// What a damper latches at a displacement that it does not take as it comes.
pub(super) const NOT_FOLLOWED: Status = Status::INPUT_LIMITED
    .union(Status::INPUT_HELD)
    .union(Status::RESTARTED);

/// Steps of a cycle.
fn ticks_of(motion: Harmonic, step_s: f64) -> Result<usize, TestbenchError> {
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

/// Whether [`run_until_periodic`] can begin, without its run.
///
/// # Errors
/// As [`run_until_periodic`], but for a force that does not become periodic.
pub fn check_steps(
    parameters: &CheckedParameters,
    motion: Harmonic,
    step_s: f64,
) -> Result<(), TestbenchError> {
    let ticks = ticks_of(motion, step_s)?;
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

/// Refuses a motion out of the damper's range; one that is too fast too is refused for that.
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
    /// Velocities (m/s) at the displacements: `2 pi f A cos(2 pi f t)`.
    pub fn velocities_m_per_s(&self) -> Vec<f64> {
        let ticks = self.displacements_m.len();
        let peak = self.motion.peak_velocity_m_per_s();
        (1..=ticks)
            .map(|tick| peak * (TAU * tick as f64 / ticks as f64).cos())
            .collect()
    }

    /// Force (N) at the peak velocity, in extension where `sign` is positive, else in compression: where the displacement passes zero.
    pub fn force_at_peak_velocity_n(&self, sign: f64) -> f64 {
        let ticks = self.forces_n.len();
        if sign > 0.0 {
            // The last step of the cycle ends there.
            return self.forces_n.last().copied().unwrap_or(0.0);
        }
        // Half a cycle is at a step or midway between two.
        let [before, after] = [ticks / 2, ticks.div_ceil(2)].map(|tick| tick.max(1) - 1);
        0.5 * (self.forces_n[before] + self.forces_n[after])
    }

    /// The indices of this cycle; its energy by the trapezoidal rule.
    pub fn indices(&self) -> Indices {
        let (forces, x) = (&self.forces_n, &self.displacements_m);
        let extension = forces.iter().fold(0.0, |most: f64, &force| most.max(force));
        let compression = forces
            .iter()
            .fold(0.0, |most: f64, &force| most.max(-force));
        let ticks = forces.len();
        let energy = (0..ticks)
            .map(|tick| {
                let last = (tick + ticks - 1) % ticks;
                0.5 * (forces[tick] + forces[last]) * (x[tick] - x[last])
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
