//! Regression: an oil temperature of 20 degC entered for a recording at 45 degC shifted the discharge coefficient by 4
//! %, with an interval of 0.0004 and no message.

use std::path::Path;

use serde_json::Value;

use crate::common::bench::{self, TRUTH, VARY};
use crate::common::{dashpot, json_of, text_of};

fn line(more: &[&str]) -> Vec<String> {
    bench::calibrate("in-service", &[&VARY[..], more].concat())
}

fn report(folder: &Path, more: &[&str]) -> Value {
    let line = line(&[more, &["--format", "json"]].concat());
    let line: Vec<&str> = line.iter().map(String::as_str).collect();
    json_of(&dashpot(&line, folder).success())
}

/// Returns the estimate and the interval of the discharge coefficient, and its shifts at both ends of the temperature
/// interval.
fn discharge(report: &Value) -> (f64, [f64; 2], [f64; 2]) {
    let number = &report["numbers"][0];
    let value = |key: &str| number[key].as_f64().unwrap();
    let shift = &report["assumed"][0]["shifts"][0];
    assert_eq!(shift[0], TRUTH[0].0);
    let shifts = [0, 1].map(|end| shift[1][end].as_f64().unwrap());
    (value("found"), [value("least"), value("greatest")], shifts)
}

#[test]
fn the_interval_includes_the_temperature_and_a_wrong_one_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bench::write_from(0.0, &folder.join("run.csv"), |sample| sample);
    let (truth, cold) = (TRUTH[0].1, ["--set", "oil.temperature_c=20"]);

    let warm = report(folder, &[]);
    let (found, interval, shifts) = discharge(&warm);
    assert!((interval[0]..interval[1]).contains(&truth), "{interval:?}");
    // The predicted change for 5 K agrees with a calibration at 50 degC.
    let hot = discharge(&report(folder, &["--set", "oil.temperature_c=50"])).0;
    assert!(
        (hot - found - shifts[1]).abs() < 0.1 * shifts[1].abs(),
        "{hot}, {found}, {shifts:?}"
    );
    assert!(
        interval[0] < hot && hot < interval[1],
        "{hot}: {interval:?}"
    );

    // 25 K off: the true value is outside the interval for 5 K, and a warning says that another temperature fits
    // better.
    let wrong = report(folder, &cold);
    let (_, interval, _) = discharge(&wrong);
    assert!(interval[1] > truth && interval[0] > truth, "{interval:?}");
    let warnings = wrong["warnings"].as_array().unwrap();
    let better = warnings
        .iter()
        .find(|one| one["kind"] == "fits_better")
        .unwrap();
    assert_eq!(better["better"], 25.0, "{better}");
    assert!(
        warnings
            .iter()
            .any(|one| one["kind"] == "assumed" && one["key"] == TRUTH[0].0),
        "{wrong}"
    );
    // With an uncertainty of 30 K, the interval includes the true value.
    let stated = report(
        folder,
        &[&cold[..], &["--temperature-uncertainty-k", "30"]].concat(),
    );
    let (_, interval, _) = discharge(&stated);
    assert!((interval[0]..interval[1]).contains(&truth), "{interval:?}");

    let line = line(&cold);
    let line: Vec<&str> = line.iter().map(String::as_str).collect();
    let text = text_of(&dashpot(&line, folder).success());
    for words in [
        "assumed: oil.temperature_c 20 +- 5 (95 %, --temperature-uncertainty-k), which shifts \
         orifice.discharge_coefficient by",
        "the recordings fit better with oil.temperature_c 25 than with 20",
    ] {
        assert!(text.contains(words), "{text}");
    }
    let head = std::fs::read_to_string(folder.join("found.toml")).unwrap();
    assert!(
        head.contains("# Assumed: oil.temperature_c 20 +- 5"),
        "{head}"
    );
}
