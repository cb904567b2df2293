//! A sheet that is measured: its recordings, and the report on them.

use std::path::Path;

use dashpot_files::sheet::SheetParameters;
use dashpot_files::{FileError, input};
use dashpot_recording::{Channels, Measurement, digest};
use dashpot_testbench::measured_sheet::{SheetRecording, TemperatureUnknown, assign};
use dashpot_testbench::steady::{Samples, SensorUncertainty, find};

use super::{RecordingLine, SheetReport};
use crate::doubts::doubts;

/// A recording for a sheet, with its motions.
#[derive(Clone, Debug)]
pub struct SheetInput {
    recording: SheetRecording,
    line: RecordingLine,
    doubts: Vec<String>,
}

impl SheetInput {
    /// Reads the recording at `path`; the oil has `temperature_c` (degC), if that is known.
    ///
    /// # Errors
    /// The recording cannot be read, or its displacement does not oscillate.
    pub fn read(
        path: &Path,
        channels: &Channels,
        temperature_c: Option<f64>,
    ) -> Result<Self, FileError> {
        let mut measurement = Measurement::open(path, channels)?;
        let (mut times_s, mut displacements_m, mut forces_n) = (Vec::new(), Vec::new(), Vec::new());
        while let Some(sample) = measurement.next_sample()? {
            times_s.push(sample.time_s);
            displacements_m.push(sample.displacement_m);
            forces_n.push(sample.force_n);
        }
        let found = find(Samples {
            times_s: &times_s,
            displacements_m: &displacements_m,
            forces_n: &forces_n,
        });
        if found.is_empty() {
            let reason =
                "the displacement does not oscillate; allowed: at least one harmonic motion";
            return Err(FileError::in_file(path, reason));
        }
        let name = input::name(path).file_name().map_or_else(
            || path.display().to_string(),
            |name| name.to_string_lossy().into_owned(),
        );
        let ends = times_s.first().zip(times_s.last());
        Ok(Self {
            line: RecordingLine {
                name: name.clone(),
                sha256: digest::sha256(path)?,
                samples: times_s.len(),
                duration_s: ends.map_or(0.0, |(first, last)| last - first),
                temperature_c,
            },
            doubts: doubts(&measurement.gaps()),
            recording: SheetRecording {
                name,
                temperature_c,
                found,
            },
        })
    }
}

/// Returns the report of a sheet that was measured. `sensors` is the uncertainty that all cycles share.
///
/// # Errors
/// A motion fits tests at several temperatures, but the temperature of its recording is unknown.
pub fn measured(
    sheet: &SheetParameters,
    inputs: Vec<SheetInput>,
    sensors: SensorUncertainty,
) -> Result<SheetReport, TemperatureUnknown> {
    let (mut recordings, mut lines, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    for input in inputs {
        let name = &input.recording.name;
        let doubts = input.doubts.iter();
        warnings.extend(doubts.map(|doubt| format!("{name}: {doubt}")));
        lines.push(input.line);
        recordings.push(input.recording);
    }
    let assigned = assign(sheet, &recordings)?;
    let unused = recordings.iter().flat_map(|recording| {
        let unused = recording.found.unused.iter();
        unused.map(|cycles| (recording.name.clone(), *cycles))
    });
    let mut report = SheetReport::measured(sheet, lines, &assigned, unused.collect(), sensors);
    report.warnings.extend(warnings);
    Ok(report)
}
