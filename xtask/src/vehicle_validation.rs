//! Updates the documents of the vehicle's validation and the rows behind them.

use std::fs;

use crate::run::{Outcome, cargo, cargo_with, repository};

/// Studies whose rows are kept in `data/studies/rows/`.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

/// Number of seeds of the irregularity: five times those of the studies, so that chance decides less.
pub const SEEDS: u64 = 40;

/// Runs the studies (some six minutes on two cores), keeps their rows, and writes the documents.
///
/// # Errors
/// A study fails, a file cannot be written, or rows do not repeat.
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
    // Each row has the digest of physics, so that must be up to date first.
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
