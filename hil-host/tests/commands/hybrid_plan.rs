//! `dashpot hybrid plan`, and the start of `dashpot vehicle --actuator` that it decides about.

use std::fs;
use std::path::Path;

use dashpot_files::actuator::ACTUATORS;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

use crate::common::{dashpot, json_of};

fn plan(folder: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let fixed = ["hybrid", "plan", "--case", "straight-180"];
    dashpot(&[&fixed, arguments].concat(), folder)
}

/// At 180 km/h a bogie has enough other dampers of each kind; near its critical speed it has not.
#[test]
fn each_position_has_its_critical_delay_or_none() {
    let here = Path::new(".");
    let common = ["--actuator", "servo", "--no-run", "--format", "json"];
    let report = json_of(&plan(here, &common).success());
    let positions = report["positions"].as_array().unwrap();
    assert_eq!(positions.len(), 20);
    assert!(
        positions
            .iter()
            .all(|position| position["critical"]["kind"] == "any"),
        "{report}"
    );
    let fast = ["--speed-km-h", "400", "--outside", "front lateral damper 1"];
    let report = json_of(&plan(here, &[&common[..], &fast].concat()).success());
    let position = &report["positions"][0];
    let delay_s = |margin: &Value| margin["delay_s"].as_f64().unwrap();
    assert!(
        (delay_s(&position["critical"]) - 43.5e-3).abs() < 0.5e-3,
        "{position}"
    );
    let left = delay_s(&position["critical"]) - position["actuator_delay_s"].as_f64().unwrap();
    // The exchange of a tick and half a held command, and a gain below 1, change the margin a little.
    assert!(
        (delay_s(&position["uncompensated"]) - left).abs() < 3e-3,
        "{position}"
    );
    assert!(delay_s(&position["margin"]) > 40e-3, "{position}");
}

#[test]
fn what_the_actuator_cannot_do_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let servo = ACTUATORS[0].1;
    let small = servo
        .replace("stroke_m = 0.1", "stroke_m = 2e-3")
        .replace("force_n = 60e3", "force_n = 5e3");
    fs::write(folder.path().join("small.toml"), small).unwrap();
    let wild = servo.replace("loop_gain_per_s = 50", "loop_gain_per_s = 700");
    fs::write(folder.path().join("wild.toml"), wild).unwrap();
    let yaw = ["--outside", "front yaw damper 1"];
    let with = |actuator: &'static str| [&yaw[..], &["--actuator", actuator]].concat();
    plan(folder.path(), &with("small.toml"))
        .failure()
        .stderr(contains("stroke 3.1").and(contains("force 20.5")));
    for (actuator, more, reason) in [
        (
            "wild.toml",
            "ats",
            "the actuator itself is unstable with this damper",
        ),
        ("slow", "none", "no margin (UNSTABLE)"),
    ] {
        let arguments = [&with(actuator)[..], &["--no-run", "--compensate", more]].concat();
        plan(folder.path(), &arguments)
            .failure()
            .stderr(contains(reason));
    }
    for (arguments, message) in [
        (
            &["--actuator", "servo", "--outside", "front yaw damper"][..],
            "did you mean `front yaw damper",
        ),
        (&["--actuator", "sorvo"], "did you mean `servo`?"),
        (
            &["--actuator", "servo", "--vehicle", "freight-wagon"],
            "the vehicle has no dampers",
        ),
    ] {
        plan(folder.path(), arguments)
            .failure()
            .stderr(contains(message));
    }
}

/// The slow actuator makes the locomotive unstable without compensation; with it the same test runs.
#[test]
fn a_slow_actuator_goes_wrong_only_without_compensation() {
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &'static str, more: &[&str]| {
        let fixed = [
            "vehicle",
            "--case",
            "straight-180",
            "--duration-s",
            "5",
            "--no-page",
            "--format",
            "json",
            "--outside",
            "front yaw damper 1=desk",
            "--actuator",
            "slow",
            "--output",
            name,
        ];
        dashpot(&[&fixed, more].concat(), folder.path())
    };
    let rig = |report: &Value| report["outside"]["rigs"][0].clone();
    let added_j = |rig: &Value| rig["added_energy_j"].as_f64().unwrap();
    let guarded = run("guarded", &["--compensate", "none", "--without-margin"]).failure();
    let guarded = rig(&json_of(&guarded));
    assert!(guarded["guarded_s"].as_f64().unwrap() < 1.5, "{guarded}");
    let wild = run(
        "wild",
        &[
            "--compensate",
            "none",
            "--without-margin",
            "--without-guard",
        ],
    )
    .success();
    let wild = rig(&json_of(&wild));
    assert!(
        added_j(&wild) > 500.0 && wild["relative_error"].as_f64().unwrap() > 1.0,
        "{wild}"
    );
    let tame = rig(&json_of(&run("tame", &[]).success()));
    assert!(added_j(&tame).abs() < 0.02 * added_j(&wild), "{tame}");
    assert!(tame["relative_error"].as_f64().unwrap() < 0.06, "{tame}");
    let rows = fs::read_to_string(folder.path().join("tame/hybrid.csv")).unwrap();
    assert_eq!(rows.lines().count(), 5001);
}
