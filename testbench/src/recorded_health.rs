//! Condition of a damper over a recording file: the noise of its sensors, and the estimates along it.

use dashpot_core::health::{Baseline, Estimate, HealthModel};

use super::health::{History, Noise, watch};
use dashpot_files::FileError;
use dashpot_recording::tick_grid::MeasuredGrid;
use dashpot_recording::{Interpolation, Measurement};

/// Number of samples used to estimate the noise.
const NOISE_SAMPLES: usize = 20_000;

/// Ticks between two checks for a cancellation.
const TICKS_BETWEEN_CHECKS: u64 = 10_000;

/// The error if the noise cannot be estimated, in words.
pub const NOISE_NEEDS: &str =
    "cannot estimate the noise: this needs motion and at least 100 samples without a gap";

/// Estimates the noise of a recording from its first samples, as it appears at ticks of `step_s` (s); `None` if there
/// is no motion, or no stretch that is long enough.
///
/// # Errors
/// The recording cannot be read.
pub fn noise(mut measurement: Measurement, step_s: f64) -> Result<Option<Noise>, FileError> {
    let (mut times_s, mut displacements_m, mut forces_n) = (Vec::new(), Vec::new(), Vec::new());
    while times_s.len() < NOISE_SAMPLES {
        let Some(sample) = measurement.next_sample()? else {
            break;
        };
        times_s.push(sample.time_s);
        displacements_m.push(sample.displacement_m);
        forces_n.push(sample.force_n);
    }
    let found = Noise::estimate(&times_s, &displacements_m, &forces_n, step_s);
    Ok(found.filter(|noise| noise.displacement_m > 0.0 && noise.force_n > 0.0))
}

/// Returns the estimates along the recording, one every `every_s` (s) and one at its end, and how its force was
/// interpolated if it is in another group; times are those of the recording.
///
/// # Errors
/// The recording cannot be read.
pub fn history(
    measurement: Measurement,
    model: &HealthModel,
    step_s: f64,
    every_s: f64,
) -> Result<(History, Option<Interpolation>), FileError> {
    history_cancellable(measurement, model, step_s, every_s, &|| false)
}

/// Like [`history`], up to the time when `is_unwanted` returns true.
///
/// # Errors
/// Same errors as [`history`].
pub fn history_cancellable(
    measurement: Measurement,
    model: &HealthModel,
    step_s: f64,
    every_s: f64,
    is_unwanted: &dyn Fn() -> bool,
) -> Result<(History, Option<Interpolation>), FileError> {
    let mut count = 0_u64;
    let mut ticks = MeasuredGrid::new(measurement, step_s)?;
    let start_s = ticks.start_s();
    let mut failed = None;
    let samples = std::iter::from_fn(|| {
        count += 1;
        if count.is_multiple_of(TICKS_BETWEEN_CHECKS) && is_unwanted() {
            return None;
        }
        match ticks.next_tick() {
            Ok(tick) => tick.map(|tick| (tick.displacement_m, tick.force_n)),
            Err(error) => {
                failed = Some(error);
                None
            }
        }
    });
    let mut history = watch(model, samples, every_s);
    if let Some(error) = failed {
        return Err(error);
    }
    for reading in &mut history.readings {
        reading.time_s += start_s;
    }
    for (_, time_s) in &mut history.alarms {
        *time_s += start_s;
    }
    Ok((history, ticks.measurement().gaps().interpolation))
}

/// Returns the baseline that a reading of the damper when it was healthy gives.
///
/// # Errors
/// The reading used no samples, or left out more than it used; the message says so.
pub fn baseline(
    [flow_factor, compliance_m_per_n, clearance_m]: [Estimate; 3],
    samples: u32,
    rejected: u32,
) -> Result<Baseline, String> {
    if samples == 0 || rejected > samples {
        return Err(format!(
            "its reading used {samples} samples and left out {rejected}"
        ));
    }
    let mut baseline = Baseline::new(
        flow_factor.value,
        compliance_m_per_n.value,
        clearance_m.value,
    );
    baseline.flow_factor_sd = flow_factor.sd;
    baseline.compliance_sd_m_per_n = compliance_m_per_n.sd;
    baseline.clearance_sd_m = clearance_m.sd;
    Ok(baseline)
}
