//! The rows that the vehicle's validation is written from, and its documents.

use std::fs;

use crate::run::{Outcome, cargo, cargo_with, repository};

/// Studies whose rows are kept in `data/studies/rows/`.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

/// Runs the studies anew, some two minutes on two cores, keeps their rows, and writes the documents.
///
/// # Errors
/// A study does not run, a file cannot be written, or rows do not repeat.
pub fn vehicle_validation() -> Outcome {
    for study in STUDIES {
        let folder = format!("target/vehicle-validation/{study}");
        let sweep = [
            "run",
            "--release",
            "--package",
            "dashpot-hil",
            "--",
            "sweep",
            study,
        ];
        let options = ["--anew", "--no-page", "--output", &folder];
        cargo(&[&sweep[..], &options].concat())?;
        let from = repository().join(&folder).join("rows.csv");
        let to = repository().join(format!("data/studies/rows/{study}.csv"));
        fs::copy(&from, &to).map_err(|error| format!("{}: {error}", to.display()))?;
    }
    cargo_with(
        &[
            "test",
            "--package",
            "dashpot",
            "--test",
            "vehicle_validation",
        ],
        &[("DASHPOT_BLESS", "1")],
    )
}
