//! Compares the fixed step with the reference solver.

use dashpot_core::{CheckedParameters, DamperParameters};
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::{errors, largest_magnitude, nrmse, root_mean_square};
use serde::Serialize;

use super::TestbenchError;
use super::compiled::Compiled;
use dashpot_files::Scalar;
use dashpot_recording::tick_grid::{Tick, TickGrid, rounding_s};
use dashpot_recording::{Recording, Sample};

/// Deviation of the fixed step from the reference on one motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Deviation {
    /// Step (s).
    pub step_s: f64,
    /// Root mean square error, divided by the root mean square reference force (1).
    pub nrmse: f64,
    /// Maximum error, divided by the maximum reference force (1).
    pub largest_error_over_peak: f64,
    /// Maximum error (N).
    pub largest_error_n: f64,
    /// Root mean square reference force (N).
    pub reference_rms_n: f64,
    /// Maximum magnitude of the reference force (N).
    pub reference_peak_n: f64,
}

/// Result of the fixed step on a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct FixedStep {
    /// Force at each tick (N).
    pub forces_n: Vec<f64>,
    /// Number of ticks whose displacement was held or limited, at most 65535; there the damper followed a different
    /// motion from the reference.
    pub rejected_inputs: u16,
}

/// Errors of the fixed step on a recorded motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RecordedError {
    /// Scalar type.
    pub scalar: Scalar,
    /// Deviation if the reference follows the displacements at the ticks.
    #[serde(flatten)]
    pub deviation: Deviation,
    /// NRMSE if the reference follows the samples of the recording itself.
    pub nrmse_on_recording: f64,
    /// Number of ticks whose displacement was held or limited.
    pub rejected_inputs: u16,
}

/// Compares the fixed step in both scalar types with the reference on a recording, which has the `samples`.
///
/// # Errors
/// The recording cannot be used, the damper cannot be built, or the reference fails.
pub fn on_recording(
    parameters: &CheckedParameters,
    recording: Recording,
    samples: &[Sample],
    step_s: f64,
) -> Result<[RecordedError; 2], TestbenchError> {
    let ticks = TickGrid::new(recording, step_s)?.read_all()?;
    let displacements_m: Vec<f64> = ticks.iter().map(|tick| tick.displacement_m).collect();
    let on_ticks = reference_forces(parameters, step_s, &displacements_m)?;
    let on_recording = reference_forces_on_recording(parameters, step_s, samples, &ticks)?;
    let row = |scalar, fixed: FixedStep| {
        Ok::<_, TestbenchError>(RecordedError {
            scalar,
            deviation: deviation(step_s, &fixed.forces_n, &on_ticks)?,
            nrmse_on_recording: deviation(step_s, &fixed.forces_n, &on_recording)?.nrmse,
            rejected_inputs: fixed.rejected_inputs,
        })
    };
    Ok([
        row(
            Scalar::F32,
            fixed_step_forces::<f32>(parameters, step_s, &displacements_m)?,
        )?,
        row(
            Scalar::F64,
            fixed_step_forces::<f64>(parameters, step_s, &displacements_m)?,
        )?,
    ])
}

/// Runs the fixed step through the displacements (m), starting at rest at the first one.
///
/// # Errors
/// Returns an error if the damper cannot be built.
pub fn fixed_step_forces<T: Compiled>(
    parameters: &CheckedParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Result<FixedStep, TestbenchError> {
    let damper = T::compiled_build(parameters, step_s)?;
    let start = displacements_m.first().copied().unwrap_or(0.0);
    let mut state = damper.at_rest(T::from_f64(start));
    let forces_n = displacements_m
        .iter()
        .map(|&x| T::compiled_step(&damper, &mut state, T::from_f64(x)).to_f64())
        .collect();
    Ok(FixedStep {
        forces_n,
        rejected_inputs: state.rejected_inputs(),
    })
}

/// Returns the reference force (N) at each displacement (m); the motion is linear between ticks of `step_s` (s).
///
/// # Errors
/// Returns the errors of the reference solver.
pub fn reference_forces(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Result<Vec<f64>, TestbenchError> {
    reference_forces_cancellable(parameters, step_s, displacements_m, &|| false)
}

/// Same as [`reference_forces`], but stops when `is_cancelled` returns true.
///
/// # Errors
/// Same errors as [`reference_forces`]; also an error if the computation is cancelled.
pub fn reference_forces_cancellable(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Vec<f64>, TestbenchError> {
    let times: Vec<f64> = (0..displacements_m.len())
        .map(|tick| tick as f64 * step_s)
        .collect();
    let mut reference = Reference::new(parameters)?;
    Ok(reference.forces_unless(&times, displacements_m, is_cancelled)?)
}

/// Returns the reference force (N) at each of `ticks` for the motion of the recording itself, linear between all its
/// samples, including those between ticks.
///
/// `ticks` of `step_s` (s) belong to the same recording: a tick at a sample has the sample's displacement.
///
/// # Errors
/// Returns the errors of the reference solver.
pub fn reference_forces_on_recording(
    parameters: &DamperParameters,
    step_s: f64,
    samples: &[Sample],
    ticks: &[Tick],
) -> Result<Vec<f64>, TestbenchError> {
    let Some(start_s) = ticks.first().map(|tick| tick.time_s) else {
        return Ok(Vec::new());
    };
    let (mut times_s, mut displacements_m) = (Vec::new(), Vec::new());
    let mut indices = Vec::with_capacity(ticks.len());
    let mut samples = samples.iter().peekable();
    for tick in ticks {
        // A sample whose time differs from the tick only by rounding counts as the tick.
        let slack_s = rounding_s(tick.time_s, step_s);
        while let Some(sample) = samples.next_if(|sample| sample.time_s <= tick.time_s + slack_s) {
            if sample.time_s < tick.time_s - slack_s {
                times_s.push(sample.time_s - start_s);
                displacements_m.push(sample.displacement_m);
            }
        }
        indices.push(times_s.len());
        times_s.push(tick.time_s - start_s);
        displacements_m.push(tick.displacement_m);
    }
    let forces = Reference::new(parameters)?.forces(&times_s, &displacements_m)?;
    Ok(indices.into_iter().map(|index| forces[index]).collect())
}

/// Returns the deviation of `forces` from `reference` (N).
///
/// # Errors
/// Returns an error if the lengths differ, or if the reference force is zero throughout.
pub fn deviation(
    step_s: f64,
    forces: &[f64],
    reference: &[f64],
) -> Result<Deviation, TestbenchError> {
    if forces.len() != reference.len() {
        return Err(TestbenchError::Lengths {
            forces: forces.len(),
            references: reference.len(),
        });
    }
    let reference_peak_n = largest_magnitude(reference.iter().copied());
    if reference_peak_n == 0.0 {
        return Err(TestbenchError::NoForce);
    }
    let largest_error_n = largest_magnitude(errors(forces, reference));
    Ok(Deviation {
        step_s,
        nrmse: nrmse(forces, reference),
        largest_error_over_peak: largest_error_n / reference_peak_n,
        largest_error_n,
        reference_rms_n: root_mean_square(reference.iter().copied()),
        reference_peak_n,
    })
}
