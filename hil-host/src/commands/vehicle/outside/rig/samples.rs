//! Signals of a rig, tick by tick: hybrid.csv and the curves of the page.

use std::path::Path;

use dashpot_core::hybrid::HybridStatus;
use dashpot_files::nearest_nanosecond;
use dashpot_files::output::{cannot_write_rows, write_whole};

use crate::commands::failure::{Failure, Outcome};

/// Signals of one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::commands::vehicle) struct Sample {
    pub(super) time_s: f64,
    pub(super) desired_m: f32,
    pub(super) command_m: f32,
    /// Measured displacement; `NaN` if no reading came.
    pub(super) measured_m: f32,
    pub(super) force_n: f32,
    pub(super) delay_s: f32,
    pub(super) amplitude: f32,
    pub(super) relative_error: f32,
    pub(super) added_j: f32,
    pub(super) status: HybridStatus,
}

/// Largest number of samples: ten minutes at 1 ms.
pub(super) const MAX_SAMPLES: usize = 600_000;

/// Signals of the rig of one damper.
#[derive(Debug, Clone)]
pub(in crate::commands::vehicle) struct Samples {
    pub(in crate::commands::vehicle) damper: String,
    pub(super) rows: Vec<Sample>,
}

const COLUMNS: [&str; 11] = [
    "damper",
    "time_s",
    "desired_m",
    "command_m",
    "measured_m",
    "force_n",
    "delay_s",
    "amplitude",
    "relative_error",
    "added_energy_j",
    "status",
];

/// Writes the signals of all rigs.
///
/// # Errors
/// The file cannot be written.
pub(in crate::commands::vehicle) fn write(all: &[Samples], to: &Path) -> Outcome<()> {
    write_whole::<_, Failure>(to, |file| {
        let failed = |error: csv::Error| cannot_write_rows(to, error);
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record(COLUMNS).map_err(failed)?;
        for Samples { damper, rows: rig } in all {
            for sample in rig {
                let is_read = !sample.measured_m.is_nan();
                let row = (
                    damper,
                    nearest_nanosecond(sample.time_s),
                    sample.desired_m,
                    sample.command_m,
                    is_read.then_some(sample.measured_m),
                    sample.force_n,
                    sample.delay_s,
                    sample.amplitude,
                    sample.relative_error,
                    sample.added_j,
                    sample.status.bits(),
                );
                rows.serialize(row).map_err(failed)?;
            }
        }
        Ok(rows.flush().map_err(|error| failed(error.into()))?)
    })
}
