//! `dashpot vehicle --outside` with a target that falls silent.

use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_core::link::Response;
use dashpot_host_link::Link;
use serde_json::Value;

use crate::common::{dashpot, error_of, files_in, json_of, text_of};
use crate::pil_common::{altered, serve_tcp};

const LATERAL: &str = "front lateral damper 1";
const VERTICAL: &str = "front vertical damper 2";

/// Serves a target that answers nothing more from the step of tick `from` on; returns HOST:PORT.
fn falls_silent(from: u32) -> String {
    let target = move || -> Box<dyn Link> {
        let mut is_silent = false;
        Box::new(altered(move |header, response, frame| {
            is_silent |= matches!(&response, Response::Forces(forces) if forces.tick >= from);
            !is_silent && frame.write(&(header, response))
        }))
    };
    serve_tcp(target)
}

/// Runs the locomotive for 0.3 s with the lateral damper on a target that is silent from 0.1 s on, and the vertical one
/// on a target that always answers.
fn vehicle(options: &[&str], folder: &Path) -> Assert {
    let lateral = format!("{LATERAL}=tcp:{}", falls_silent(100));
    let vertical = format!("{VERTICAL}=desk");
    let case = ["vehicle", "--case", "straight-180", "--duration-s", "0.3"];
    // The irregularity of the track begins under the vehicle.
    let case = [&case[..], &["--start-m", "10"]].concat();
    let outside = ["--outside", &lateral, "--outside", &vertical];
    dashpot(
        &[&case[..], &outside, &["--output", "out"], options].concat(),
        folder,
    )
}

/// Checks the results of a run that ended after `ticks` ticks.
fn check(error: &str, report: &Value, folder: &Path, ticks: u64, missing: u64) {
    let ending = &report["ending"];
    assert_eq!(ending["reason"], "outside_lost");
    assert_eq!(ending["time_s"], ticks as f64 * 1e-3);
    assert_eq!(ending["silent_since_s"], 0.1);
    assert_eq!(ending["missing_answers"], missing);
    assert_eq!(ending["dampers"].as_array().unwrap().len(), 1);
    assert_eq!(ending["dampers"][0]["damper"], LATERAL);
    let held_n = ending["dampers"][0]["held_force_n"].as_f64().unwrap();
    let expected = format!(
        "no valid answer since 0.100 s, {missing} missing; last force, held until the end: {LATERAL} {held_n:.1} N"
    );
    assert!(error.contains(&expected), "{error}");
    let [lateral, vertical] = [0, 1].map(|damper| &report["outside"]["dampers"][damper]);
    assert_eq!(lateral["missing_answers"], missing);
    assert_eq!(lateral["most_missing_in_a_row"], missing);
    assert_eq!(lateral["first_missing_s"], 0.1);
    assert_eq!(vertical["missing_answers"], 0);
    assert!(vertical["first_missing_s"].is_null());
    // The target that still answers is closed and compared.
    let targets = report["outside"]["targets"].as_array().unwrap();
    assert_eq!(targets.len(), 1);
    assert_eq!(
        (&targets[0]["link"], &targets[0]["mismatches"]),
        (&"desk".into(), &0.into())
    );
    // All files are whole: the history has a row for each tick, and the last force is the one that was held.
    let out = folder.join("out");
    assert_eq!(
        files_in(&out),
        [
            "history.csv",
            "indices.json",
            "report.html",
            "spectra.csv",
            "wear.csv"
        ]
    );
    let mut rows = csv::Reader::from_path(out.join("history.csv")).unwrap();
    let name = format!("{}_force_n", LATERAL.replace(' ', "_"));
    let column = rows
        .headers()
        .unwrap()
        .iter()
        .position(|other| other == name);
    let forces: Vec<f64> = rows
        .records()
        .map(|row| row.unwrap()[column.unwrap()].parse().unwrap())
        .collect();
    assert_eq!(forces.len() as u64, ticks);
    for force_n in &forces[100..] {
        assert_eq!(*force_n, held_n);
    }
    assert!(held_n.abs() > 10.0);
    let saved = std::fs::read_to_string(out.join("indices.json")).unwrap();
    let saved: Value = serde_json::from_str(&saved).unwrap();
    assert_eq!(saved["ending"], report["ending"]);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("no valid answer since 0.100 s") && page.trim_end().ends_with("</html>"));
}

/// The wait of 5 s is for a busy machine: the target answers every tick before it falls silent.
#[test]
fn in_real_time_the_last_force_is_held_and_then_the_run_ends() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--realtime", "--hold-ticks", "20", "--timeout-ms", "5000"];
    let ended = vehicle(
        &[&options[..], &["--format", "json"]].concat(),
        folder.path(),
    )
    .code(1);
    let error = error_of(&ended);
    assert!(
        error.contains("an external damper was lost at 0.120 s, "),
        "{error}"
    );
    let cause = "after tick 99: 21 answers in a row are missing from the target; allowed: 20; use a longer \
                 --timeout-ms or more --hold-ticks";
    assert!(error.contains(cause), "{error}");
    check(&error, &json_of(&ended), folder.path(), 120, 21);
}

#[test]
fn without_real_time_the_run_ends_at_the_silent_tick() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--timeout-ms", "3000", "--tries", "2", "--format", "json"];
    let ended = vehicle(&options, folder.path()).code(1);
    let error = error_of(&ended);
    assert!(
        error.contains("an external damper was lost at 0.100 s, "),
        "{error}"
    );
    let waited = error
        .split("no answer from the target to 2 tries within ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok());
    // The second wait is twice the first.
    assert!(waited.is_some_and(|seconds| seconds >= 9.0), "{error}");
    check(&error, &json_of(&ended), folder.path(), 100, 1);
}

#[test]
fn the_missing_answers_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--realtime", "--hold-ticks", "0", "--timeout-ms", "5000"];
    let text = text_of(&vehicle(&options, folder.path()).code(1));
    let expected =
        "answers missing: 1, at most 1 in a row, the first at 0.100 s; the last force was held";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn holding_requires_real_time_and_a_target() {
    let folder = tempfile::tempdir().unwrap();
    let desk = format!("{LATERAL}=desk");
    for options in [&["--outside", &desk][..], &["--realtime"], &[]] {
        let case = ["vehicle", "--case", "straight-180", "--hold-ticks", "5"];
        let ended = dashpot(&[&case[..], options].concat(), folder.path()).code(2);
        let error = error_of(&ended);
        assert!(
            error.contains("--hold-ticks requires --outside and --realtime"),
            "{error}"
        );
    }
}
