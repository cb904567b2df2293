//! Regression: a dip of 10 mm over 1 m at 120 km/h gave a wheel load of 11 957 kN, 118 times that at standstill,
//! without a warning and with exit code 0.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use dashpot_files::case::START_M;

use crate::common::{dashpot, error_of, text_of};

const TRACK: &str = "name = \"dip\"\n[[part]]\nkind = \"straight\"\nlength_m = 500\n";

/// Start of the dip, m.
const DIP_M: f64 = 20.0;

/// Track with a dip in both rails.
fn track(depth_m: f64, folder: &Path) {
    let dip = format!(
        "[[defect]]\nkind = \"cosine-dip\"\nrails = \"both\"\nstart_m = {DIP_M}\nlength_m = 1\ndepth_m = {depth_m}\n"
    );
    fs::write(folder.join("dip.toml"), format!("{TRACK}{dip}")).unwrap();
}

/// On rigid rails with a damping far above that of steel, a short deep dip gives loads that no model stands behind.
const RUN: [&str; 13] = [
    "vehicle",
    "--set",
    "rails=rigid",
    "--normal-damping-s-per-m",
    "5",
    "--track",
    "dip.toml",
    "--speed-km-h",
    "120",
    "--duration-s",
    "1",
    "--output",
    ".",
];

fn report(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("indices.json")).unwrap()).unwrap()
}

#[test]
fn a_load_far_beyond_the_model_ends_the_run_with_time_and_place() {
    let folder = tempdir().unwrap();
    track(10e-3, folder.path());
    let ended = dashpot(&RUN, folder.path()).code(1);
    let error = error_of(&ended);
    for words in [
        "beyond the model at ",
        "m along the track: wheelset ",
        "times the static load; allowed: 50 times",
    ] {
        assert!(error.contains(words), "{error}");
    }
    let report = report(folder.path());
    assert_eq!(report["ending"]["reason"], "beyond_model");
    assert!(report["indices"].is_null());
    let number = |key: &str| report["ending"][key].as_f64().unwrap();
    assert!(number("load_n") > 50.0 * number("load_static_n"));
    // Every wheelset is within 10 m of the vehicle's middle.
    let travelled_m = number("time_s") * 120.0 / 3.6;
    assert!((number("distance_m") - START_M - travelled_m).abs() < 1e-6);
    assert!((DIP_M - 10.0..DIP_M + 20.0).contains(&number("distance_m")));
    // The warning names the maximum load up to there with the position of the wheel.
    let warnings = report["warnings"].as_array().unwrap();
    let load = warnings
        .iter()
        .find(|warning| warning["kind"] == "wheel_load")
        .unwrap();
    let place = load["distance_m"].as_f64().unwrap();
    assert!((DIP_M..DIP_M + 10.0).contains(&place), "{load}");
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("The run did not complete: beyond the model at"));
    assert!(page.contains("Results outside the validity of the model"));
}

/// The row of a study contains the same ending and no indices.
#[test]
fn a_row_of_a_study_has_the_ending() {
    let folder = tempdir().unwrap();
    track(10e-3, folder.path());
    let study = "name = \"dip\"\nobserved = [\"derailment_rms\", \"wheel_load_over_static\", \
     \"wheel_lift_longest_s\"]\n\
                 [[sweep]]\nname = \"dip\"\ntrack = \"dip.toml\"\nspeed_km_h = 120\nduration_s = 1\n\
                 set = [\"rails=rigid\"]\nnormal_damping_s_per_m = 5\n\
                 vary = [{ parameter = \"speed_km_h\", values = [20, 120] }]\n";
    fs::write(folder.path().join("study.toml"), study).unwrap();
    let ended = dashpot(
        &["sweep", "study.toml", "--output", ".", "--no-page"],
        folder.path(),
    )
    .success();
    let text = text_of(&ended);
    assert!(
        text.contains("1 case did not complete (beyond the model; no indices): 1"),
        "{text}"
    );
    let mut rows = csv::Reader::from_path(folder.path().join("rows.csv")).unwrap();
    let names = rows.headers().unwrap().clone();
    let rows: Vec<_> = rows.records().map(Result::unwrap).collect();
    let cell = |row: usize, name: &str| {
        let column = names.iter().position(|other| other == name).unwrap();
        rows[row][column].to_owned()
    };
    assert_eq!(cell(0, "ending"), "completed");
    assert!(cell(0, "wheel_load_over_static").parse::<f64>().unwrap() > 1.0);
    assert_eq!(cell(0, "wheel_lift_longest_s"), "0.0");
    assert!(cell(1, "ending").starts_with("beyond the model at "));
    assert_eq!(cell(1, "wheel_load_over_static"), "");
}

/// Between 10 and 50 times, the run continues to its end with a warning: on poor track, flange impacts can be this
/// hard.
#[test]
fn a_load_over_ten_times_that_at_standstill_is_a_warning() {
    let folder = tempdir().unwrap();
    track(5e-3, folder.path());
    let ended = dashpot(&RUN, folder.path()).success();
    let text = text_of(&ended);
    let report = report(folder.path());
    assert_eq!(report["ending"]["reason"], "completed");
    let warnings = report["warnings"].as_array().unwrap();
    assert!(!warnings.is_empty());
    for warning in warnings {
        assert_eq!(warning["kind"], "wheel_load");
        let ratio =
            warning["load_n"].as_f64().unwrap() / warning["load_static_n"].as_f64().unwrap();
        assert!((10.0..50.0).contains(&ratio), "{warning}");
        let message = warning["message"].as_str().unwrap();
        assert!(text.contains(&format!("warning: {message}")), "{text}");
    }
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("Results outside the validity of the model"));
}
