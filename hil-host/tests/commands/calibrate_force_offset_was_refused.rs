//! Regression: a force offset of 300 N (1.3 % of the peak) was rejected with "do not determine sensor_skew_s", a
//! parameter that nobody had varied.

use std::path::Path;

use crate::common::bench::{self, TRUTH, VARY};
use crate::common::{dashpot, json_of, text_of};

/// Sensor readings of this rig at zero force (N) and in the middle of the motion (m).
const OFFSETS: (f64, f64) = (300.0, 0.8);

fn run(folder: &Path, more: &[&str]) -> assert_cmd::assert::Assert {
    let line = bench::calibrate("in-service", &[&VARY[..], more].concat());
    let line: Vec<&str> = line.iter().map(String::as_str).collect();
    dashpot(&line, folder)
}

#[test]
fn offsets_of_both_sensors_are_found_with_intervals() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bench::write(&folder.join("run.csv"), |mut sample| {
        sample.force_n += OFFSETS.0;
        sample.displacement_m += OFFSETS.1;
        sample
    });
    let report = json_of(&run(folder, &["--page", "found.html", "--format", "json"]).success());
    let numbers = report["numbers"].as_array().unwrap();
    let number = |key: &str| numbers.iter().find(|number| number["key"] == key).unwrap();
    for (key, truth, tolerance) in TRUTH {
        let found = number(key)["found"].as_f64().unwrap();
        assert!((found - truth).abs() < tolerance, "{key}: {found}");
    }
    let offset = number("force_offset_n");
    let value = |key: &str| offset[key].as_f64().unwrap();
    // The recording itself has no offset; noise of 1 % moves the estimate by some newtons.
    assert!((value("found") - OFFSETS.0).abs() < 20.0, "{offset}");
    assert!(
        value("least") < OFFSETS.0 && OFFSETS.0 < value("greatest"),
        "{offset}"
    );
    for row in report["loops"].as_array().unwrap() {
        let value = |key: &str| row[key].as_f64().unwrap();
        let off = value("displacement_offset_m") - OFFSETS.1;
        assert!(off.abs() < 1e-3, "{row}");
        assert!(value("displacement_offset_least_m") < value("displacement_offset_greatest_m"));
    }
    assert_eq!(
        report["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|one| one["kind"] == "missed")
            .count(),
        0
    );
    let page = std::fs::read_to_string(folder.join("found.html")).unwrap();
    assert!(page.contains("force_offset_n") && page.contains("middle, mm"));
    let head = std::fs::read_to_string(folder.join("found.toml")).unwrap();
    assert!(
        head.contains("(parameter of the rig, not of the damper)"),
        "{head}"
    );
}

#[test]
fn rig_parameters_accept_bounds_priors_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bench::write(&folder.join("run.csv"), |mut sample| {
        sample.force_n += OFFSETS.0;
        sample
    });
    let few = |more: &[&str]| {
        let line = ["--vary", "orifice.discharge_coefficient", "--starts", "1"];
        let line = bench::calibrate(
            "in-service",
            &[
                &[
                    "--set",
                    "mount.stiffness_n_per_m=7.5e6",
                    "--set",
                    "mount.clearance_m=0.6e-3",
                ],
                &line[..],
                more,
            ]
            .concat(),
        );
        // The same number of starts.
        let first = line.iter().position(|word| word == "--starts").unwrap();
        let line = [&line[..first], &line[first + 2..]].concat();
        let line: Vec<&str> = line.iter().map(String::as_str).collect();
        dashpot(&line, folder)
    };
    let held = few(&[
        "--hold",
        "force_offset_n=300",
        "--no-skew",
        "--format",
        "json",
    ])
    .success();
    let held = json_of(&held);
    assert_eq!(held["numbers"].as_array().unwrap().len(), 1, "{held}");
    assert_eq!(held["held"]["force_offset_n"], 300.0);
    let given = [
        "--vary",
        "sensor_skew_s=0:5e-3",
        "--prior",
        "sensor_skew_s=2e-3:1e-4",
        "--vary",
        "force_offset_n=-1e3:1e3",
        "--prior",
        "force_offset_n=280:50",
        "--format",
        "json",
    ];
    let given = json_of(&few(&given).success());
    let rows = given["numbers"].as_array().unwrap();
    assert_eq!(rows[1]["bounds"][1], 5e-3, "{given}");
    assert_eq!(rows[2]["prior"]["mean"], 280.0, "{given}");
    // A bound given by the user is kept and reported.
    let bounded = few(&[
        "--vary",
        "force_offset_n=-100:100",
        "--max-misfit-percent",
        "40",
    ])
    .success();
    assert!(
        text_of(&bounded).contains("force_offset_n is at the bound 100"),
        "{}",
        text_of(&bounded)
    );
    for (wrong, words) in [
        (
            &["--hold", "mount.clearance_m"][..],
            "--hold mount.clearance_m: only rig parameters can be held (sensor_skew_s, force_offset_n)",
        ),
        (
            &["--hold", "force_offset_n", "--vary", "force_offset_n"],
            "it is held",
        ),
        (
            &["--no-skew", "--prior", "sensor_skew_s=0:1e-3"],
            "remove `--no-skew`",
        ),
        (
            &["--hold", "force_offset_n=1e9"],
            "allowed: -10000000 to 10000000",
        ),
        (
            &["--hold", "force_offset_n=x"],
            "allowed after `=`: a number",
        ),
        (&["--vary", "sensor_skew_s=-2:2"], "-1 to 1 s"),
        (
            &["--vary", "displacement_offset_m"],
            "no force of a damper depends on it",
        ),
        (
            &["--vary", "sensor_skew_s", "--vary", "sensor_skew_s"],
            "given twice by the same option",
        ),
        (&["--temperature-uncertainty-k", "-1"], "0 to 1000"),
        (&["--max-misfit-percent", "0"], "0.1 to 10000"),
    ] {
        let refused = few(wrong).code(2);
        let text = crate::common::error_of(&refused);
        assert!(text.contains(words), "{wrong:?}: {text}");
    }
}
