//! `dashpot verify`: the fixed step against the reference, at the ticks and at the times of the recording.

use std::io::Cursor;
use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_files::damper;
use dashpot_recording::Recording;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_testbench::verification::{reference_forces, reference_forces_on_recording};
use predicates::str::contains;

use crate::common::{dashpot, error_of, json_of, text_of};

/// 5 mm at 1.4 Hz, sampled at these times (s).
fn sine(times_s: impl Iterator<Item = f64>) -> String {
    let mut text = String::from("time_s,displacement_m\n");
    for time_s in times_s {
        let x = 5e-3 * (std::f64::consts::TAU * 1.4 * time_s).sin();
        text.push_str(&format!("{time_s},{x}\n"));
    }
    text
}

fn verify(recording: &str, more: &[&str]) -> Assert {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), recording).unwrap();
    let arguments = ["verify", "--damper", "paper", "--input", "in.csv"];
    dashpot(&[&arguments[..], more].concat(), folder.path())
}

/// With a sample at every second tick, the ticks contain the whole motion, so both references are the same.
#[test]
fn each_step_is_reported_and_can_fail() {
    let recording = sine((0..=500).map(|i| f64::from(i) * 2e-3));
    let more = ["--step-us", "1000", "--format", "json"];
    let output = verify(&recording, &more).success();
    let report = json_of(&output);
    let rows = report["deviations"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let value = |key: &str| row[key].as_f64().unwrap();
        assert!(value("nrmse") < 1e-3, "{row}");
        assert!(value("largest_error_over_peak") < 1e-2, "{row}");
        let apart = value("nrmse_on_recording") / value("nrmse") - 1.0;
        assert!(apart.abs() < 1e-6, "{row}");
        assert_eq!(row["rejected_inputs"], 0);
    }
    verify(&recording, &[&more[..], &["--at-most", "1e-12"]].concat())
        .code(1)
        .stderr(contains("--at-most"));
}

/// Ticks of 8 ms skip three of four samples; only the comparison with the recording shows this error.
#[test]
fn samples_skipped_by_ticks_show_against_the_recording() {
    let recording = sine((0..=500).map(|i| f64::from(i) * 2e-3));
    let output = verify(&recording, &["--step-us", "8000", "--format", "json"]);
    for row in json_of(&output)["deviations"].as_array().unwrap() {
        let value = |key: &str| row[key].as_f64().unwrap();
        assert!(value("nrmse_on_recording") > 1.05 * value("nrmse"), "{row}");
    }
    let output = verify(&recording, &["--step-us", "8000"]);
    let text = text_of(&output);
    assert!(
        text.contains("NRMSE on ticks  NRMSE on recording"),
        "{text}"
    );
}

/// Uneven time stamps, all multiples of 10 us: a grid of 10 us loses nothing, so the reference on the grid is the
/// reference on the recording.
#[test]
fn the_reference_on_the_recording_is_that_on_a_grid_that_holds_all_stamps() {
    let recording = sine((0..60).map(|i| f64::from(i * 230 + i * i % 7 * 20) * 1e-5));
    let ticks = |step_s: f64| {
        let source = Box::new(Cursor::new(recording.clone().into_bytes()));
        let recording = Recording::read(Path::new("in.csv"), source).unwrap();
        TickGrid::new(recording, step_s)
            .unwrap()
            .read_all()
            .unwrap()
    };
    let samples = Recording::read(
        Path::new("in.csv"),
        Box::new(Cursor::new(recording.clone().into_bytes())),
    )
    .and_then(|mut recording| recording.read_all())
    .unwrap();
    let damper = damper::load("in-service", &[]).unwrap();
    let (coarse, fine) = (ticks(1e-3), ticks(1e-5));
    let x: Vec<f64> = fine.iter().map(|tick| tick.displacement_m).collect();
    let expected = reference_forces(&damper, 1e-5, &x).unwrap();
    let found = reference_forces_on_recording(&damper, 1e-3, &samples, &coarse).unwrap();
    let peak = expected.iter().fold(0.0_f64, |peak, f| peak.max(f.abs()));
    assert!(peak > 1000.0, "{peak}");
    assert_eq!(found.len(), coarse.len());
    for (tick, force) in found.iter().enumerate() {
        let error = (force - expected[100 * tick]).abs();
        assert!(error < 1e-8 * peak, "tick {tick}: {error}");
    }
}

#[test]
fn input_that_the_damper_did_not_follow_is_reported() {
    let output = verify(
        "time_s,displacement_m\n0,0\n0.001,0.005\n0.01,0\n",
        &["--step-us", "1000"],
    );
    let text = text_of(&output);
    assert!(
        text.contains("warning: input held or rate-limited at up to 2 ticks"),
        "{text}{}",
        error_of(&output)
    );
}
