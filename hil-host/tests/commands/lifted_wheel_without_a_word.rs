//! Regression: a run whose wheels left the rail for a third of a second ended without a warning.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use crate::common::{dashpot, json_of};

fn ran(arguments: &[&str]) -> (Value, String) {
    let folder = tempdir().unwrap();
    let all = [
        &["vehicle", "--output", ".", "--format", "json", "--no-page"],
        arguments,
    ];
    let report = json_of(&dashpot(&all.concat(), folder.path()).success());
    let history = fs::read_to_string(folder.path().join("history.csv")).unwrap();
    (report, history)
}

/// Longest run of consecutive ticks without load in a column, and the time (s) at which it starts.
fn longest_lift(history: &str, column: &str) -> (u64, f64) {
    let mut rows = csv::Reader::from_reader(history.as_bytes());
    let names = rows.headers().unwrap().clone();
    let at = |name: &str| names.iter().position(|other| other == name).unwrap();
    let (time, load) = (at("time_s"), at(column));
    let (mut now, mut began, mut longest) = (0, 0.0, (0, 0.0));
    for row in rows.records() {
        let row = row.unwrap();
        if row[load].parse::<f64>().unwrap() > 0.0 {
            now = 0;
            continue;
        }
        if now == 0 {
            began = row[time].parse::<f64>().unwrap() - 1e-3;
        }
        now += 1;
        if now > longest.0 {
            longest = (now, began);
        }
    }
    longest
}

#[test]
fn a_wheel_without_load_for_more_than_50_ms_is_a_warning() {
    let (report, history) = ran(&["--case", "curve-r200"]);
    assert_eq!(report["ending"]["reason"], "completed");
    let lifts: Vec<&Value> = report["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|warning| warning["kind"] == "wheel_lift")
        .collect();
    let mut named = 0;
    for wheelset in 1..=6 {
        for side in ["left", "right"] {
            let column = format!("wheelset_{wheelset}_{side}_load_n");
            let (ticks, began_s) = longest_lift(&history, &column);
            let name = format!("wheelset {wheelset}");
            let found = lifts
                .iter()
                .find(|lift| lift["wheelset"] == name.as_str() && lift["side"] == side);
            assert_eq!(found.is_some(), ticks > 50, "{column}: {ticks} ticks");
            let Some(found) = found else { continue };
            named += 1;
            // A wheel may touch the rail for part of a tick.
            let duration_s = found["duration_s"].as_f64().unwrap();
            assert!(duration_s <= ticks as f64 * 1e-3 + 1e-9, "{found}");
            if (duration_s - ticks as f64 * 1e-3).abs() < 1e-9 {
                assert!((found["time_s"].as_f64().unwrap() - began_s).abs() < 1e-6);
            }
        }
    }
    assert!(named >= 2, "{lifts:?}");
}

#[test]
fn a_run_on_its_rails_has_no_warning() {
    let (report, _) = ran(&["--case", "curve-r600"]);
    assert_eq!(report["warnings"], serde_json::json!([]));
}
