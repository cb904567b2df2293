//! Regression: a reversed sign of force or displacement, and millimetres read as metres, all ended with "do not
//! determine sensor_skew_s".

use dashpot_recording::MeasuredSample;

use crate::common::advice::advised;
use crate::common::bench::{self, TRUTH, VARY};
use crate::common::{dashpot, error_of, files_in};

/// Checks that a recording changed by `change` is rejected with `words`, that nothing is written, and that each advised
/// command line succeeds. The first one must recover the damper.
fn is_named(change: impl Fn(MeasuredSample) -> MeasuredSample, more: &[&str], words: &str) {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bench::write(&folder.join("run.csv"), change);
    let line = bench::calibrate("in-service", &[&VARY[..], more].concat());
    let run = |line: &[String]| {
        let line: Vec<&str> = line.iter().map(String::as_str).collect();
        dashpot(&line, folder)
    };
    let text = error_of(&run(&line).code(1));
    assert!(text.contains(words), "{text}");
    assert_eq!(files_in(folder), ["run.csv"]);
    for (number, advised) in advised(&line, &text).iter().enumerate() {
        run(advised).success();
        let found = std::fs::read_to_string(folder.join("found.toml")).unwrap();
        let found = dashpot_files::damper::parse("found", &found, &[]).unwrap();
        let (_, clearance_m, tolerance) = TRUTH[2];
        assert!(
            number > 0 || (found.mount.clearance_m - clearance_m).abs() < tolerance,
            "{advised:?}"
        );
    }
}

#[test]
fn a_reversed_force_is_named() {
    is_named(
        |sample| MeasuredSample {
            force_n: -sample.force_n,
            ..sample
        },
        &[],
        "the force has the opposite sign: use `--reverse-force`",
    );
}

#[test]
fn a_reversed_displacement_is_named() {
    is_named(
        |sample| MeasuredSample {
            displacement_m: -sample.displacement_m,
            ..sample
        },
        &[],
        "the displacement has the opposite sign: use `--reverse-displacement`",
    );
}

#[test]
fn a_needless_reversing_option_is_named() {
    is_named(
        |sample| sample,
        &["--reverse-force"],
        "the force has the opposite sign: remove `--reverse-force`",
    );
}

#[test]
fn millimetres_are_named() {
    is_named(
        |sample| MeasuredSample {
            displacement_m: 1e3 * sample.displacement_m,
            ..sample
        },
        &[],
        "the displacement seems to be in another unit: 1000 times too large: use `--displacement-unit mm`",
    );
}

#[test]
fn kilonewtons_and_a_reversed_sign_are_named_together() {
    is_named(
        |sample| MeasuredSample {
            force_n: -1e-3 * sample.force_n,
            ..sample
        },
        &[],
        "use `--reverse-force --force-unit kN`",
    );
}
