//! Measured motions assigned to the tests of a sheet.

use dashpot_files::harmonic::Harmonic;
use dashpot_files::sheet::{SheetParameters, Test, Tolerance};

use super::steady::{Found, SteadyMotion};

/// A recording for a sheet, and what it contains.
#[derive(Clone, Debug)]
pub struct SheetRecording {
    /// Name used in results.
    pub name: String,
    /// Oil temperature (degC); `None` if unknown.
    pub temperature_c: Option<f64>,
    /// Its motions.
    pub found: Found,
}

/// A motion in one of the recordings.
#[derive(Clone, Copy, Debug)]
pub struct RecordedMotion<'a> {
    /// The recording.
    pub recording: &'a SheetRecording,
    /// The motion.
    pub motion: &'a SteadyMotion,
}

/// Tests of a sheet with their measurements.
#[derive(Clone, Debug, Default)]
pub struct Assigned<'a> {
    /// Measured tests, in the order of the sheet. A test that was measured several times appears as often.
    pub measured: Vec<(&'a Test, RecordedMotion<'a>)>,
    /// Tests without a measurement.
    pub missing: Vec<&'a Test>,
    /// Motions that belong to no test.
    pub others: Vec<RecordedMotion<'a>>,
}

/// A motion fits tests at several temperatures, but the temperature of its recording is unknown.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{recording}: the motion of {amplitude_m:.6} m at {frequency_hz:.4} Hz belongs to tests at several oil \
     temperatures: {}; the temperature of the recording is unknown",
    tests.join(", ")
)]
pub struct TemperatureUnknown {
    /// Name of the recording.
    pub recording: String,
    /// Measured amplitude (m).
    pub amplitude_m: f64,
    /// Measured frequency (Hz).
    pub frequency_hz: f64,
    /// Names of the tests.
    pub tests: Vec<String>,
}

/// Assigns each motion to the test of the sheet that is nearest to it within the sheet's tolerance.
///
/// # Errors
/// A motion fits tests at several temperatures, but the temperature of its recording is unknown.
pub fn assign<'a>(
    sheet: &'a SheetParameters,
    recordings: &'a [SheetRecording],
) -> Result<Assigned<'a>, TemperatureUnknown> {
    let mut assigned = Assigned::default();
    for recording in recordings {
        for motion in &recording.found.motions {
            let recorded = RecordedMotion { recording, motion };
            match nearest(sheet, &recorded)? {
                Some(test) => assigned.measured.push((test, recorded)),
                None => assigned.others.push(recorded),
            }
        }
    }
    assigned.measured.sort_by_key(|(test, _)| test.line);
    let is_measured = |test: &&Test| {
        assigned
            .measured
            .iter()
            .any(|(measured, _)| measured == test)
    };
    assigned.missing = sheet
        .tests
        .iter()
        .filter(|test| !is_measured(test))
        .collect();
    Ok(assigned)
}

fn nearest<'a>(
    sheet: &'a SheetParameters,
    recorded: &RecordedMotion<'_>,
) -> Result<Option<&'a Test>, TemperatureUnknown> {
    let measured = recorded.motion.mean.motion;
    let candidates = sheet.tests.iter().filter_map(|test| {
        let difference = motion_difference(&measured, &test.motion);
        (difference <= 0.01 * sheet.tolerance.motion_percent).then_some((difference, test))
    });
    let candidates: Vec<(f64, &Test)> = candidates.collect();
    let Some(temperature_c) = recorded.recording.temperature_c else {
        let first = candidates.first().map(|(_, test)| test.temperature_c);
        let is_first = |(_, test): &(f64, &Test)| Some(test.temperature_c) == first;
        if candidates.iter().all(is_first) {
            return Ok(least(candidates.into_iter()));
        }
        return Err(TemperatureUnknown {
            recording: recorded.recording.name.clone(),
            amplitude_m: measured.amplitude_m,
            frequency_hz: measured.frequency_hz,
            tests: candidates
                .iter()
                .map(|(_, test)| test.name.clone())
                .collect(),
        });
    };
    let at_temperature = candidates.into_iter().filter_map(|(difference, test)| {
        let share = temperature_share(test, temperature_c, sheet.tolerance);
        (share <= 1.0).then_some((difference + share, test))
    });
    Ok(least(at_temperature))
}

/// Returns the greater of the relative differences of amplitude and frequency.
fn motion_difference(measured: &Harmonic, wanted: &Harmonic) -> f64 {
    let relative = |measured: f64, wanted: f64| (measured / wanted - 1.0).abs();
    relative(measured.amplitude_m, wanted.amplitude_m)
        .max(relative(measured.frequency_hz, wanted.frequency_hz))
}

/// Returns the difference from the temperature of a test as a share of the tolerance; 0 for a test at any temperature.
fn temperature_share(test: &Test, temperature_c: f64, tolerance: Tolerance) -> f64 {
    let wanted = test.temperature_c.unwrap_or(temperature_c);
    (temperature_c - wanted).abs() / tolerance.temperature_k
}

fn least<'a>(candidates: impl Iterator<Item = (f64, &'a Test)>) -> Option<&'a Test> {
    let least = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, test)| test)
}
