//! The rows that the vehicle's validation is written from, and its documents.

use std::fs;

use crate::run::{Outcome, cargo, cargo_with, repository};

/// Studies whose rows are kept in `data/studies/rows/`.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

/// Seeds of the irregularity: five times those of the studies, so that few rows are left to chance.
pub const SEEDS: u64 = 40;

/// Runs the studies anew, some six minutes on two cores, keeps their rows, and writes the documents.
///
/// # Errors
/// A study does not run, a file cannot be written, or rows do not repeat.
pub fn vehicle_validation() -> Outcome {
    let bless = |filter: &[&str]| {
        let test = [
            "test",
            "--package",
            "dashpot",
            "--test",
            "vehicle_validation",
        ];
        cargo_with(&[&test[..], filter].concat(), &[("DASHPOT_BLESS", "1")])
    };
    // Rows carry the digest of physics, which must be right before they are written.
    bless(&["physics"])?;
    let seeds = SEEDS.to_string();
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
        let options = [
            "--anew",
            "--no-page",
            "--seeds",
            &seeds,
            "--output",
            &folder,
        ];
        cargo(&[&sweep[..], &options].concat())?;
        let from = repository().join(&folder).join("rows.csv");
        let to = repository().join(format!("data/studies/rows/{study}.csv"));
        fs::copy(&from, &to).map_err(|error| format!("{}: {error}", to.display()))?;
    }
    bless(&[])
}
