//! Updates the documents about the vehicle's validation and the rows on which they are based.

use std::fs;

use crate::run::{Outcome, cargo, cargo_with, repository};

/// Studies whose rows are kept in `data/studies/rows/`.
const STUDIES: [&str; 4] = ["paper", "curve-r600", "stand-ins", "out-of-service"];

/// Number of seeds of the track irregularity: five times as many as in the studies, to reduce the effect of chance.
pub const SEEDS: u64 = 40;

/// Runs the studies (about six minutes on two cores), keeps their rows, and writes the documents.
///
/// # Errors
/// A study fails, a file cannot be written, or rows are not reproducible.
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
    // Each row contains the digest of physics, so the digest must be up to date first.
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
