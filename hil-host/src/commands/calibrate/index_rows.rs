//! Indices of tests, measured and computed with the damper before and after calibration.

use serde::Serialize;

use super::CalibrateArguments;
use crate::commands::failure::Outcome;
use dashpot_calibration::{Calibrated, Calibration, IndexTest, Recorded, TEMPERATURE};
use dashpot_core::CheckedParameters;
use dashpot_core::parameters::Element;
use dashpot_files::damper::{DamperError, KeyedParameters};
use dashpot_testbench::TestbenchError;
use dashpot_testbench::bench_test::{Indices, run_until_periodic};

/// Indices of a test before and after calibration.
#[derive(Serialize)]
pub(super) struct IndexRow {
    /// Name of the recording with this motion; `None` for a test of a table.
    pub(super) recording: Option<String>,
    pub(super) measured: IndexTest,
    pub(super) before: Indices,
    pub(super) after: Indices,
}

/// Compares the indices of tables, and those of each steady motion in the recordings, with those of the dampers before
/// and after calibration.
///
/// # Errors
/// A damper's force in a test of a table does not become periodic.
pub(super) fn rows(
    arguments: &CalibrateArguments,
    calibration: &Calibration,
    inputs: &[Recorded],
    dampers: [&CheckedParameters; 2],
    found: &Calibrated,
) -> Outcome<Vec<IndexRow>> {
    let step_s = calibration.step_s;
    let tabled = calibration.indices.iter();
    let tabled = tabled.map(|measured| IndexRow::new(None, measured.clone(), dampers, step_s));
    let mut indices = tabled.collect::<Result<Vec<_>, _>>()?;
    let rig = found.rig(calibration);
    for (recorded, temperature_c) in inputs.iter().zip(arguments.temperatures_c()?) {
        let [before, after] = dampers.map(|damper| at_temperature(damper, temperature_c));
        let (before, after) = (before?, after?);
        // A motion that the damper cannot follow forever has no indices to compare with.
        let motions = recorded.index_tests(rig).into_iter();
        let compared = motions.filter_map(|measured| {
            let name = Some(recorded.name.clone());
            IndexRow::new(name, measured, [&before, &after], step_s).ok()
        });
        indices.extend(compared);
    }
    Ok(indices)
}

/// Returns the damper at the oil temperature of a recording.
fn at_temperature(
    damper: &CheckedParameters,
    temperature_c: Option<f64>,
) -> Result<CheckedParameters, DamperError> {
    match (temperature_c, &damper.element) {
        (Some(temperature_c), Element::Physical(_)) => {
            KeyedParameters::new("damper", damper)?.with(&[(TEMPERATURE, temperature_c)])
        }
        _ => Ok(damper.clone()),
    }
}

impl IndexRow {
    /// Compares measured indices with those of the damper before and after calibration.
    fn new(
        recording: Option<String>,
        measured: IndexTest,
        dampers: [&CheckedParameters; 2],
        step_s: f64,
    ) -> Result<Self, TestbenchError> {
        let indices_of = |damper| {
            let cycle = run_until_periodic(damper, measured.motion(), step_s)?;
            Ok::<Indices, TestbenchError>(cycle.indices())
        };
        let [before, after] = dampers.map(indices_of);
        Ok(Self {
            recording,
            before: before?,
            after: after?,
            measured,
        })
    }

    /// Describes the motion, with its recording.
    pub(super) fn motion(&self, sign: &str) -> String {
        let amplitude_mm = self.measured.amplitude_m * 1e3;
        let frequency_hz = self.measured.frequency_hz;
        match &self.recording {
            None => format!("{sign}{amplitude_mm:.3} mm at {frequency_hz} Hz"),
            Some(name) => format!("{name}: {sign}{amplitude_mm:.3} mm at {frequency_hz:.4} Hz"),
        }
    }

    /// Returns, for each measured index, its name, its measured value, and its values before and after calibration.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&'static str, String, f64, f64)> {
        let IndexRow {
            measured,
            before,
            after,
            ..
        } = self;
        let largest = |indices: &Indices| {
            indices
                .max_extension_force_n
                .max(indices.max_compression_force_n)
        };
        let lines = [
            (
                "largest force in extension, N",
                measured
                    .max_extension_force_n
                    .map(|force| format!("{force:.1}")),
                before.max_extension_force_n,
                after.max_extension_force_n,
            ),
            (
                "largest force in compression, N",
                measured
                    .max_compression_force_n
                    .map(|force| format!("{force:.1}")),
                before.max_compression_force_n,
                after.max_compression_force_n,
            ),
            (
                "energy per cycle, J",
                measured
                    .energy_per_cycle_j
                    .map(|energy| format!("{energy:.1}")),
                before.energy_per_cycle_j,
                after.energy_per_cycle_j,
            ),
            (
                "largest force, N",
                measured
                    .force_at_most_n
                    .map(|force| format!("<= {force:.1}")),
                largest(before),
                largest(after),
            ),
        ];
        lines
            .into_iter()
            .filter_map(|(name, measured, before, after)| Some((name, measured?, before, after)))
    }
}
