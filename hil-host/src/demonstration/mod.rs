//! The demonstration: two presets on the shipped ride, fixed step against reference, bench test, cost.

mod figures;
mod page;
mod recording;

use std::hint::black_box;
use std::time::Instant;

use dashpot_core::characteristic::Characteristic;
use dashpot_core::{DamperParameters, Real};
use serde::Serialize;

use crate::damper_file;
use crate::failure::Outcome;
use crate::reference::Reference;
use crate::rig::{self, Cycle, Harmonic, Indices};

pub use page::write as page;

/// Presets shown: the published equations as they stand, and the same damper in service.
const DAMPERS: [&str; 2] = ["paper", "in-service"];

/// Steps shown (s): 1 and 10 kHz.
const STEPS_S: [f64; 2] = [1e-3, 1e-4];

/// Amplitudes of the bench loops (m), at [`LOOP_FREQUENCY_HZ`].
const LOOP_AMPLITUDES_M: [f64; 4] = [1e-3, 2.5e-3, 5e-3, 10e-3];
const LOOP_FREQUENCY_HZ: f64 = 1.5;

/// How near the fixed step comes to the reference, and what a step costs here.
#[derive(Clone, Debug, Serialize)]
pub struct Accuracy {
    /// Preset.
    pub damper: &'static str,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// Step (s).
    pub step_s: f64,
    /// rms of the error over rms of the force (1).
    pub nrmse: f64,
    /// The project's limit for it (1).
    pub nrmse_limit: f64,
    /// Largest error over largest force (1).
    pub largest_error_over_peak: f64,
    /// Median cost of a step, unpaced (ns).
    pub median_ns_per_step: f64,
}

impl Accuracy {
    /// Whether the error is above the project's limit.
    pub fn over_limit(&self) -> bool {
        self.nrmse > self.nrmse_limit
    }
}

/// The project's limits of [`Accuracy::nrmse`] for series stiffnesses up to 14 MN/m.
fn nrmse_limit(step_s: f64, scalar: &str) -> f64 {
    match (step_s, scalar) {
        (step_s, _) if step_s > 1.1e-4 => 1e-3,
        (_, "f32") => 6e-5,
        _ => 3e-5,
    }
}

/// Forces over the ride at 1 kHz.
struct Ride {
    damper: &'static str,
    times_s: Vec<f64>,
    displacements_m: Vec<f64>,
    reference_n: Vec<f64>,
    /// Single precision, as on the target.
    fixed_step_n: Vec<f64>,
}

/// A preset on the bench.
struct Bench {
    damper: &'static str,
    characteristic: Characteristic,
    loops: Vec<Cycle>,
    table_5: Indices,
}

/// Everything the page shows.
pub struct Demonstration {
    samples: usize,
    duration_s: f64,
    /// A row for each damper, step and scalar.
    pub accuracy: Vec<Accuracy>,
    rides: Vec<Ride>,
    benches: Vec<Bench>,
}

/// Pieces of work [`run`] tells of.
pub const WORK: u64 = (DAMPERS.len() * (STEPS_S.len() + 1)) as u64;

/// Runs the demonstration; `tell` hears what is about to be done.
///
/// # Errors
/// A preset, the recording or the reference fails.
pub fn run(mut tell: impl FnMut(String)) -> Outcome<Demonstration> {
    let samples = recording::shipped()?;
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
    for name in DAMPERS {
        let damper = damper_file::load(name, &[])?;
        for step_s in STEPS_S {
            tell(format!("{name}: ride at {:.0} kHz", 1e-3 / step_s));
            let (times_s, displacements_m) = recording::at_ticks(step_s)?;
            let reference_n = Reference::new(&damper)?.forces(&times_s, &displacements_m)?;
            let single = measure::<f32>(&damper, step_s, &displacements_m)?;
            let double = measure::<f64>(&damper, step_s, &displacements_m)?;
            for (scalar, measured) in [("f32", &single), ("f64", &double)] {
                let (nrmse, largest) = errors(&measured.forces_n, &reference_n);
                shown.accuracy.push(Accuracy {
                    damper: name,
                    scalar,
                    step_s,
                    nrmse,
                    nrmse_limit: nrmse_limit(step_s, scalar),
                    largest_error_over_peak: largest,
                    median_ns_per_step: measured.median_ns,
                });
            }
            if step_s == STEPS_S[0] {
                shown.rides.push(Ride {
                    damper: name,
                    times_s,
                    displacements_m,
                    reference_n,
                    fixed_step_n: single.forces_n,
                });
            }
        }
        tell(format!("{name}: bench"));
        shown.benches.push(bench(name, &damper)?);
    }
    Ok(shown)
}

fn bench(name: &'static str, damper: &DamperParameters) -> Outcome<Bench> {
    let loops = LOOP_AMPLITUDES_M
        .iter()
        .map(|&amplitude_m| {
            let motion = Harmonic {
                amplitude_m,
                frequency_hz: LOOP_FREQUENCY_HZ,
            };
            rig::settle(damper, motion, 1e-3)
        })
        .collect::<Outcome<_>>()?;
    Ok(Bench {
        damper: name,
        characteristic: Characteristic::new(damper)?,
        loops,
        table_5: rig::settle(damper, Harmonic::TABLE_5, 1e-4)?.indices(),
    })
}

struct Measured {
    forces_n: Vec<f64>,
    median_ns: f64,
}

/// Forces over the motion from rest, and the median cost of a step over blocks of it.
fn measure<T: Real>(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Outcome<Measured> {
    /// Steps timed together: long against the clock's resolution, short against an interruption.
    const BLOCK: usize = 500;
    const STEPS: usize = 200_000;
    let damper = parameters.build::<T>(step_s)?;
    let motion: Vec<T> = displacements_m.iter().map(|&x| T::from_f64(x)).collect();
    let mut state = damper.at_rest(motion[0]);
    let forces_n = motion
        .iter()
        .map(|&x| damper.step(&mut state, x).to_f64())
        .collect();
    let mut costs = Vec::new();
    while costs.len() * BLOCK < STEPS {
        let mut state = damper.at_rest(motion[0]);
        for block in motion.chunks_exact(BLOCK) {
            let start = Instant::now();
            for &x in block {
                black_box(black_box(&damper).step(&mut state, black_box(x)));
            }
            costs.push(start.elapsed().as_secs_f64() * 1e9 / BLOCK as f64);
        }
    }
    costs.sort_by(f64::total_cmp);
    Ok(Measured {
        forces_n,
        median_ns: costs[costs.len() / 2],
    })
}

/// rms error over rms force, and largest error over largest force.
fn errors(forces: &[f64], reference: &[f64]) -> (f64, f64) {
    let (mut square, mut scale, mut largest, mut peak) = (0.0, 0.0, 0.0_f64, 0.0_f64);
    for (force, reference) in forces.iter().zip(reference) {
        let error = force - reference;
        square += error * error;
        scale += reference * reference;
        largest = largest.max(error.abs());
        peak = peak.max(reference.abs());
    }
    ((square / scale).sqrt(), largest / peak)
}
