//! Results of the demo: two presets on the built-in synthetic ride, accuracy of the fixed step, bench test and cost.

use dashpot_core::CheckedParameters;
use dashpot_core::characteristic::Characteristic;
use serde::Serialize;

use super::cost::median_ns_per_step;
use crate::commands::failure::Outcome;
use dashpot_files::Scalar;
use dashpot_files::damper;
use dashpot_files::harmonic::Harmonic;
use dashpot_testbench::accuracy_limits::{AccuracyLimits, relaxation_time_s};
use dashpot_testbench::bench_test::{self, Cycle, Indices};
use dashpot_testbench::verification::{deviation, fixed_step_forces, reference_forces};

/// Presets shown: the published equations, and the same damper in service.
const DAMPERS: [&str; 2] = ["paper", "in-service"];

/// Steps shown (s): 1 and 10 kHz.
pub(super) const STEPS_S: [f64; 2] = [1e-3, 1e-4];

/// Amplitudes of the bench loops (m), at [`LOOP_FREQUENCY_HZ`].
pub(super) const LOOP_AMPLITUDES_M: [f64; 4] = [1e-3, 2.5e-3, 5e-3, 10e-3];
pub(super) const LOOP_FREQUENCY_HZ: f64 = 1.5;

/// Accuracy of the fixed step relative to the reference, and cost of a step on this machine.
#[derive(Clone, Debug, Serialize)]
pub struct Accuracy {
    /// Preset.
    pub damper: &'static str,
    /// Scalar type of the step.
    pub scalar: Scalar,
    /// Step (s).
    pub step_s: f64,
    /// Rms error over rms force (1).
    pub nrmse: f64,
    /// Promised limit of `nrmse` (1), if there is one.
    pub nrmse_limit: Option<f64>,
    /// Largest error over largest force (1).
    pub largest_error_over_peak: f64,
    /// Median cost of a step, unpaced (ns).
    pub median_ns_per_step: f64,
}

impl Accuracy {
    /// True if the error exceeds the promised limit.
    pub fn over_limit(&self) -> bool {
        self.nrmse_limit.is_some_and(|limit| self.nrmse > limit)
    }
}

/// Forces over the ride at 1 kHz.
pub(super) struct Ride {
    pub(super) damper: &'static str,
    pub(super) step_s: f64,
    pub(super) displacements_m: Vec<f64>,
    pub(super) reference_n: Vec<f64>,
    /// Forces in single precision, as on the target.
    pub(super) fixed_step_n: Vec<f64>,
}

/// A preset on the bench.
pub(super) struct Bench {
    pub(super) damper: &'static str,
    pub(super) parameters: CheckedParameters,
    pub(super) characteristic: Characteristic,
    pub(super) loops: Vec<Cycle>,
    pub(super) table_5: Indices,
}

/// Everything the page shows.
pub struct Demonstration {
    pub(super) samples: usize,
    pub(super) duration_s: f64,
    /// One row per damper, step and scalar type.
    pub accuracy: Vec<Accuracy>,
    pub(super) rides: Vec<Ride>,
    pub(super) benches: Vec<Bench>,
}

/// Number of work items that [`run`] reports.
pub const WORK: u64 = (DAMPERS.len() * (STEPS_S.len() + 1)) as u64;

/// Runs the demo; `report` receives the next work item and the number of finished items.
///
/// # Errors
/// A preset, the recording or the reference fails.
pub fn run(mut report: impl FnMut(String, u64)) -> Outcome<Demonstration> {
    let samples = super::recording::shipped()?;
    let duration_s = match (samples.first(), samples.last()) {
        (Some(first), Some(last)) => last.time_s - first.time_s,
        _ => 0.0,
    };
    let mut shown = Demonstration {
        samples: samples.len(),
        duration_s,
        accuracy: Vec::new(),
        rides: Vec::new(),
        benches: Vec::new(),
    };
    let mut pieces = 0..;
    let mut report = |work| report(work, pieces.next().unwrap_or(WORK));
    for name in DAMPERS {
        let damper = damper::load(name, &[])?;
        for step_s in STEPS_S {
            report(format!("{name}: ride at {:.0} kHz", 1e-3 / step_s));
            shown.ride(name, &damper, step_s)?;
        }
        report(format!("{name}: bench"));
        shown.benches.push(bench(name, &damper)?);
    }
    Ok(shown)
}

impl Demonstration {
    /// Runs the built-in recording at one step size in both precisions.
    fn ride(&mut self, name: &'static str, damper: &CheckedParameters, step_s: f64) -> Outcome<()> {
        let displacements_m = super::recording::at_ticks(step_s)?;
        let reference_n = reference_forces(damper, step_s, &displacements_m)?;
        let relaxation_s = relaxation_time_s(damper, step_s, &displacements_m, &reference_n);
        let promise = AccuracyLimits::for_relaxation_time(relaxation_s);
        let single = fixed_step_forces::<f32>(damper, step_s, &displacements_m)?;
        let double = fixed_step_forces::<f64>(damper, step_s, &displacements_m)?;
        let costs = [
            median_ns_per_step::<f32>(damper, step_s, &displacements_m)?,
            median_ns_per_step::<f64>(damper, step_s, &displacements_m)?,
        ];
        for ((scalar, fixed), median_ns_per_step) in
            [(Scalar::F32, &single), (Scalar::F64, &double)]
                .into_iter()
                .zip(costs)
        {
            let deviation = deviation(step_s, &fixed.forces_n, &reference_n)?;
            self.accuracy.push(Accuracy {
                damper: name,
                scalar,
                step_s,
                nrmse: deviation.nrmse,
                nrmse_limit: promise.and_then(|promise| promise.nrmse(step_s, scalar)),
                largest_error_over_peak: deviation.largest_error_over_peak,
                median_ns_per_step,
            });
        }
        if step_s == STEPS_S[0] {
            self.rides.push(Ride {
                damper: name,
                step_s,
                displacements_m,
                reference_n,
                fixed_step_n: single.forces_n,
            });
        }
        Ok(())
    }
}

fn bench(name: &'static str, damper: &CheckedParameters) -> Outcome<Bench> {
    let loops = LOOP_AMPLITUDES_M
        .iter()
        .map(|&amplitude_m| {
            let motion = Harmonic {
                amplitude_m,
                frequency_hz: LOOP_FREQUENCY_HZ,
            };
            bench_test::run_until_periodic(damper, motion, 1e-3)
        })
        .collect::<Result<_, _>>()?;
    Ok(Bench {
        damper: name,
        parameters: damper.clone(),
        characteristic: Characteristic::new(damper),
        loops,
        table_5: bench_test::run_until_periodic(damper, Harmonic::TABLE_5, 1e-4)?.indices(),
    })
}
