//! Condition of a damper over a recording file: the noise of its sensors, and the estimates along it.

use std::path::Path;

use dashpot_core::health::HealthModel;

use super::health::{History, Noise, watch};
use dashpot_files::FileError;
use dashpot_recording::tick_grid::MeasuredGrid;
use dashpot_recording::{Channels, Interpolation, Measurement};

/// Number of samples used to estimate the noise.
const NOISE_SAMPLES: usize = 20_000;

/// Estimates the noise of a recording from its first samples, as it appears at ticks of `step_s` (s); `None` if there
/// is no motion, or no stretch that is long enough.
///
/// # Errors
/// The recording cannot be read.
pub fn noise(path: &Path, channels: &Channels, step_s: f64) -> Result<Option<Noise>, FileError> {
    let mut measurement = Measurement::open(path, channels)?;
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
    path: &Path,
    channels: &Channels,
    model: &HealthModel,
    step_s: f64,
    every_s: f64,
) -> Result<(History, Option<Interpolation>), FileError> {
    let measurement = Measurement::open(path, channels)?;
    let mut ticks = MeasuredGrid::new(measurement, step_s)?;
    let start_s = ticks.start_s();
    let mut failed = None;
    let samples = std::iter::from_fn(|| match ticks.next_tick() {
        Ok(tick) => tick.map(|tick| (tick.displacement_m, tick.force_n)),
        Err(error) => {
            failed = Some(error);
            None
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
