//! CSV output of all values.

use std::io::Write;
use std::path::Path;

use super::report::Report;
use crate::commands::failure::Outcome;
use dashpot_files::output::{cannot_write, cannot_write_rows};

/// Writes one row per value.
///
/// # Errors
/// The file at `path` cannot be written.
pub(super) fn write(path: &Path, file: &mut dyn Write, report: &Report) -> Outcome<()> {
    let failed = |error| cannot_write_rows(path, error);
    let mut rows = csv::Writer::from_writer(file);
    let numbers = [
        "amplitude_m",
        "frequency_hz",
        "dynamic_stiffness_n_per_m",
        "loss_angle_deg",
        "storage_n_per_m",
        "loss_n_per_m",
        "damping_n_s_per_m",
        "difference",
    ];
    let header = ["response"]
        .into_iter()
        .chain(report.over.as_deref())
        .chain(numbers);
    rows.write_record(header).map_err(failed)?;
    for series in &report.series {
        for row in &series.rows {
            let value = report.over.as_ref().map(|_| series.value);
            let numbers = [
                series.amplitude_m,
                Some(row.frequency_hz),
                Some(row.dynamic_stiffness_n_per_m),
                row.loss_angle_deg,
                Some(row.storage_n_per_m),
                Some(row.loss_n_per_m),
                Some(row.damping_n_s_per_m),
                row.difference,
            ];
            let cells = value.into_iter().chain(numbers);
            // `Display` of `f64` gives the shortest text that parses to the same number.
            let cells = cells.map(|cell| cell.map_or_else(String::new, |cell| cell.to_string()));
            let kind = series.response.name().to_owned();
            rows.write_record([kind].into_iter().chain(cells))
                .map_err(failed)?;
        }
    }
    rows.flush().map_err(|error| cannot_write(path, error))?;
    Ok(())
}
