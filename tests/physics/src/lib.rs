//! Bits of the model's results: the forces of all presets, and every index of a few runs of vehicles.
//!
//! The runs cover every element of a vehicle, elastically supported rails, events, a damper that changes during the
//! run, and both laws of a damper.

use dashpot_core::Damper;
use dashpot_files::damper::{self, PRESETS};
use dashpot_files::study::StudyParameters;
use dashpot_study::sweep::{Shared, Study, digest_of_cells, row};
use dashpot_testbench::excitation::Excitation;

/// The study of the runs, in the repository.
pub const STUDY: &str = "tests/physics/study/study.toml";

/// Number of ticks of the synthetic ride that drives each preset.
const TICKS: usize = 3000;

/// Loads the study of the runs from its file.
///
/// # Panics
/// If the file is not a study.
pub fn study(path: &str) -> Study {
    let parameters = StudyParameters::load(path).expect("the study of physics");
    Study::new(parameters).expect("the study of physics")
}

/// Digest of the results.
///
/// # Panics
/// If a run ends early or an index is missing.
pub fn digest(study: &Study) -> String {
    let mut results = forces();
    results.extend(indices(study));
    digest_of_cells(results.iter().map(String::as_str))
}

fn bits(number: f64) -> String {
    format!("{:016x}", number.to_bits())
}

/// Forces of all presets in single and in double precision.
fn forces() -> Vec<String> {
    let motion = Excitation::Ride.displacements_m(1e-3);
    let mut results = Vec::new();
    for (name, _) in PRESETS {
        let parameters = damper::load(name, &[]).expect("a preset");
        let single: Damper<f32> = parameters.build(1e-3).expect("a preset");
        let double: Damper<f64> = parameters.build(1e-3).expect("a preset");
        let start = motion[0];
        let (mut in_single, mut in_double) = (single.at_rest(start as f32), double.at_rest(start));
        for displacement_m in motion.iter().take(TICKS) {
            let force = single.step(&mut in_single, *displacement_m as f32);
            results.push(bits(f64::from(force)));
            results.push(bits(double.step(&mut in_double, *displacement_m)));
        }
    }
    results
}

/// Every index of every run.
fn indices(study: &Study) -> Vec<String> {
    let shared = Shared::default();
    let mut results = Vec::new();
    for number in 0..study.cases() {
        let row = row(study, number, &shared, &|| false)
            .expect("a run")
            .expect("a case");
        assert_eq!(row.ending, "completed", "case {number}");
        for (index, value) in study.observed.iter().zip(&row.observed) {
            let value = value.unwrap_or_else(|| panic!("case {number}: no {}", index.name));
            results.push(bits(value));
        }
    }
    results
}
