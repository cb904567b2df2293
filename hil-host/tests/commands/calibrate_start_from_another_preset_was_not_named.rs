//! Regression: a calibration started from the wrong preset ended with "do not determine sensor_skew_s".

use crate::common::advice::advised;
use crate::common::bench::{self, VARY};
use crate::common::{dashpot, error_of, files_in};

/// Calibrates the recording of an `in-service` damper from `preset` with `vary`: it must be rejected with a start that
/// succeeds.
fn is_named(preset: &str, vary: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bench::write(&folder.join("run.csv"), |sample| sample);
    let line = bench::calibrate(preset, vary);
    let run = |line: &[String]| {
        let line: Vec<&str> = line.iter().map(String::as_str).collect();
        dashpot(&line, folder)
    };
    let text = error_of(&run(&line).code(1));
    let words = "the starting damper is of the wrong kind; `in-service` explains the recordings: \
                 use `--damper in-service";
    assert!(text.contains(words), "{text}");
    assert_eq!(files_in(folder), ["run.csv"]);
    for advised in advised(&line, &text) {
        run(&advised).success();
    }
}

#[test]
fn another_physical_damper_is_named() {
    is_named("paper", &VARY);
}

#[test]
fn a_reduced_damper_is_named_with_the_parameters_to_vary() {
    let vary = [
        "--vary",
        "reduced.damping_n_s_per_m",
        "--vary",
        "mount.stiffness_n_per_m",
    ];
    is_named("reduced-vertical", &vary);
}
