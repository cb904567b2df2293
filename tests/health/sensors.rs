//! Sensor faults, and damper faults that no estimated parameter describes.

use dashpot_core::DamperParameters;
use dashpot_core::health::{Estimate, Health, HealthReading, HealthStatus};
use dashpot_core::parameters::Element;
use dashpot_testbench::health::Noise;

use crate::synthetic::{STEP_S, forces, model, ride};

/// A fault that begins during the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wrong {
    /// An offset (N, m).
    ForceBias(f64),
    DisplacementBias(f64),
    /// Delay in samples of 1 ms.
    ForceLag(usize),
    DisplacementLag(usize),
    /// A wrong scale factor.
    ForceGain(f64),
    DisplacementGain(f64),
    /// An offset that grows (N/s, m/s).
    ForceDrift(f64),
    DisplacementDrift(f64),
    /// During 100 ms of every second the force is 0 or NaN, or the displacement is held.
    ForceDropout,
    ForceLost,
    DisplacementDropout,
    /// A sensor is stuck: the force at this value (N), or the displacement at its last value.
    ForceStuck(f64),
    DisplacementStuck,
    ForceReversed,
    DisplacementReversed,
    /// The sensor delivers only noise.
    ForceDead,
    /// Additional seal friction (N).
    Friction(f64),
    /// Air in the oil column (1).
    Air(f64),
}

/// Result of a run.
pub struct Run {
    pub last: HealthReading,
    /// Largest ratio of error to standard deviation among flow, compliance and clearance at the end.
    pub error: f64,
    /// Time after the fault (s) after which every reading contained the true values or was untrusted.
    pub right_after_s: f64,
    /// Time after the fault (s) at which the missing force was first reported.
    pub no_force_after_s: Option<f64>,
    pub had_alarm: bool,
}

/// Ticks before the fault.
pub const BEFORE: usize = 20_000;
/// Ticks with the fault.
pub const WITH: usize = 40_000;
/// An interval counts as containing the true value if that is within this number of standard deviations.
pub const CONTAINED: f64 = 5.0;

impl Wrong {
    /// The damper with this fault; `None` if the damper lacks the part.
    fn on(self, healthy: &DamperParameters) -> Option<DamperParameters> {
        let mut faulty = healthy.clone();
        let Element::Physical(hydraulics) = &mut faulty.element else {
            let is_sensor = !matches!(self, Self::Friction(_) | Self::Air(_));
            return is_sensor.then_some(faulty);
        };
        match self {
            Self::Friction(more) => hydraulics.seal.as_mut()?.friction_n += more,
            Self::Air(part) => hydraulics.oil.column.as_mut()?.air_fraction = part,
            _ => {}
        }
        Some(faulty)
    }

    /// Sensor readings at a tick with the fault, computed from the correct, noisy `x` and `force`.
    fn sample(self, tick: usize, x: &[f64], force: &[f64], noise: f64) -> (f64, f64) {
        let since_s = (tick - BEFORE) as f64 * STEP_S;
        let drops = tick % 1000 < 100;
        let held = tick - tick % 1000;
        let (now, sensed) = (x[tick], force[tick]);
        match self {
            Self::ForceBias(offset) => (now, sensed + offset),
            Self::DisplacementBias(offset) => (now + offset, sensed),
            Self::ForceLag(ticks) => (now, force[tick - ticks]),
            Self::DisplacementLag(ticks) => (x[tick - ticks], sensed),
            Self::ForceGain(gain) => (now, gain * (sensed - noise) + noise),
            Self::DisplacementGain(gain) => (gain * now, sensed),
            Self::ForceDrift(rate) => (now, sensed + rate * since_s),
            Self::DisplacementDrift(rate) => (now + rate * since_s, sensed),
            Self::ForceDropout if drops => (now, 0.0),
            Self::ForceLost if drops => (now, f64::NAN),
            Self::DisplacementDropout if drops => (x[held], sensed),
            Self::ForceStuck(at) => (now, at),
            Self::DisplacementStuck => (x[BEFORE], sensed),
            Self::ForceReversed => (now, -sensed),
            Self::DisplacementReversed => (-now, sensed),
            Self::ForceDead => (now, noise),
            _ => (now, sensed),
        }
    }

    /// Runs 20 s without and 40 s with the fault, with noise of 2 % of each signal. `None` if the damper cannot have
    /// the fault.
    pub fn run(self, healthy: &DamperParameters, seed: u64) -> Option<Run> {
        let faulty = self.on(healthy)?;
        let ticks = BEFORE + WITH;
        let x = ride(seed, ticks);
        let right = forces(healthy, healthy, ticks, &x);
        let force = if faulty == *healthy {
            right.clone()
        } else {
            forces(healthy, &faulty, BEFORE, &x)
        };
        let noise = Noise::from_rms(0.02, &x, &right);
        let (noisy_x, noisy_force) = noise.add_to(&x, &force, seed + 7000);
        let model = model(healthy, &noise);
        let mut health = Health::new(&model);
        let truth = [
            1.0,
            healthy.mount.compliance_m_per_n(),
            healthy.mount.clearance_m,
        ];
        let error = |reading: &HealthReading| {
            let estimates = [
                reading.flow_factor,
                reading.compliance_m_per_n,
                reading.clearance_m,
            ];
            let errors = estimates.iter().zip(truth);
            errors
                .map(|(Estimate { value, sd }, truth)| {
                    (f64::from(*value) - truth).abs() / f64::from(*sd)
                })
                .fold(0.0, f64::max)
        };
        let mut run = Run {
            last: health.reading(&model),
            error: 0.0,
            right_after_s: 0.0,
            no_force_after_s: None,
            had_alarm: false,
        };
        for tick in 0..ticks {
            let (x, force) = if tick < BEFORE {
                (noisy_x[tick], noisy_force[tick])
            } else {
                let noise = noisy_force[tick] - force[tick];
                self.sample(tick, &noisy_x, &noisy_force, noise)
            };
            health.tick(&model, x as f32, force as f32);
            if tick < BEFORE {
                continue;
            }
            let since_s = (tick - BEFORE) as f64 * STEP_S;
            if health.status().contains(HealthStatus::NO_FORCE) {
                run.no_force_after_s.get_or_insert(since_s);
            }
            if tick % 100 == 0 {
                let reading = health.reading(&model);
                if reading.is_trusted() && error(&reading) > CONTAINED {
                    run.right_after_s = since_s + 0.1;
                }
            }
        }
        run.last = health.reading(&model);
        run.error = error(&run.last);
        run.had_alarm = run.last.status.intersects(crate::synthetic::WEAR);
        Some(run)
    }
}
