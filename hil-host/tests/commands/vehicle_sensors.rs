//! `dashpot vehicle-sensors`: the example of docs/vehicle-sensors.md with simulated rides, and wrong use.

use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use serde_json::Value;
use xtask::run::repository;

use crate::common::{dashpot, error_of, json_of, text_of};

const COMMAND: [&str; 4] = [
    "vehicle-sensors",
    "--vehicle",
    "my.toml",
    "--without-gravity",
];
const BASELINE: [&str; 2] = ["--baseline", "baseline.json"];

/// Runs the locomotive over a track with irregularities of this seed, and returns the name of its history.
fn ride(folder: &Path, seed: u32, fault: &str) -> String {
    let track = fs::read_to_string(repository().join("data/tracks/straight.toml")).unwrap();
    let track = track.replace("length_m = 1000", "length_m = 20000");
    let track = track.replace("seed = 1", &format!("seed = {seed}"));
    fs::write(folder.join("track.toml"), track).unwrap();
    let output = format!("ride{seed}");
    let command = [
        "vehicle",
        "--vehicle",
        "my.toml",
        "--track",
        "track.toml",
        "--speed-km-h",
        "180",
        "--no-page",
    ];
    let times = [
        "--start-m",
        "-15",
        "--duration-s",
        "35",
        "--step-us",
        "2000",
        "--output",
        &output,
    ];
    let faults: &[&str] = if fault.is_empty() {
        &[]
    } else {
        &["--set", fault]
    };
    dashpot(&[&command[..], &times, faults].concat(), folder).success();
    format!("{output}/history.csv")
}

/// A folder with the vehicle of the page, a baseline of two rides, and a ride without the force of a damper.
fn locomotive() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let page = fs::read_to_string(repository().join("docs/vehicle-sensors.md")).unwrap();
    let (_, block) = page.split_once("```toml\n").unwrap();
    let (points, _) = block.split_once("```").unwrap();
    let vehicle = fs::read_to_string(repository().join("data/vehicles/locomotive.toml")).unwrap();
    let (vehicle, _) = vehicle.split_once("[[ride_point]]").unwrap();
    fs::write(
        folder.path().join("my.toml"),
        format!("{vehicle}\n{points}"),
    )
    .unwrap();
    let rides = [1, 2].map(|seed| ride(folder.path(), seed, ""));
    let inputs = [
        "--input",
        &rides[0],
        "--input",
        &rides[1],
        "--new-baseline",
        "baseline.json",
    ];
    let written = dashpot(&[&COMMAND[..], &inputs].concat(), folder.path()).success();
    assert!(text_of(&written).contains("baseline from 24 accelerometers, 56 s of ride"));
    ride(
        folder.path(),
        3,
        "front lateral damper 1.reduced.damping_n_s_per_m=90",
    );
    folder
}

fn assessed(folder: &Path, input: &str, more: &[&str]) -> Assert {
    dashpot(
        &[&COMMAND[..], &BASELINE, &["--input", input], more].concat(),
        folder,
    )
}

/// The columns of a history that the sensors need, every fifth row, each line changed.
fn reduced(folder: &Path, name: &str, change: impl Fn(usize, Vec<String>) -> Vec<String>) {
    let text = fs::read_to_string(folder.join("ride3/history.csv")).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let is_wanted =
        |column: &str| column == "time_s" || column.starts_with("at ") || column.starts_with("at_");
    let wanted: Vec<usize> = (0..head.len())
        .filter(|column| is_wanted(head[*column]))
        .collect();
    let rows = std::iter::once(head)
        .chain(lines.step_by(5))
        .enumerate()
        .map(|(number, row)| {
            let cells = wanted
                .iter()
                .map(|column| row[*column].to_owned())
                .collect();
            change(number, cells).join(",")
        });
    fs::write(
        folder.join(name),
        rows.collect::<Vec<_>>().join("\n") + "\n",
    )
    .unwrap();
}

#[test]
fn a_damper_without_force_is_named_from_accelerations_alone() {
    let folder = locomotive();
    let text = text_of(&assessed(folder.path(), "ride3/history.csv", &[]).success());
    assert!(text.contains("worn: front lateral damper 1"), "{text}");
    let found =
        json_of(&assessed(folder.path(), "ride3/history.csv", &["--format", "json"]).success());
    let ratio = |kind: &str, number: usize| found[kind][number]["ratio"].as_f64().unwrap();
    assert!((ratio("bogies", 0) - 0.5).abs() < 0.05, "{found}");
    assert!((ratio("bogies", 1) - 1.0).abs() < 0.05, "{found}");
    assert!(ratio("dampers", 0).abs() < 0.15, "{found}");
    assert_eq!(found["bogies"][1]["condition"], Value::from("as_new"));
    assert!(found["unexplained"].as_f64().unwrap() < 0.03, "{found}");

    // Other names, fewer rows per second.
    reduced(folder.path(), "logger.csv", |number, mut row| {
        if number == 0 {
            row[1] = "A1 [m/s2]".into();
        }
        row
    });
    let signal = "at_front_bogie_lateral_acceleration_m_per_s2=A1";
    let same = text_of(&assessed(folder.path(), "logger.csv", &["--signal", signal]).success());
    assert!(same.contains("worn: front lateral damper 1"), "{same}");

    wrong_use(folder.path());
}

fn wrong_use(folder: &Path) {
    let refused = |name: &str, more: &[&str], words: &[&str]| {
        let error = error_of(&assessed(folder, name, more).failure());
        for word in words {
            assert!(error.contains(word), "{error}");
        }
    };
    refused("logger.csv", &[], &["front bogie", "lateral"]);
    refused(
        "logger.csv",
        &["--signal", "at_front=A1"],
        &["unknown reading at_front"],
    );
    let absent = "at_front_bogie_lateral_acceleration_m_per_s2=B1";
    refused("logger.csv", &["--signal", absent], &["no column B1"]);
    reduced(folder, "gap.csv", |number, mut row| {
        if number == 1200 {
            row[1].clear();
        }
        row
    });
    refused("gap.csv", &[], &["no reading at 1", "without gaps"]);
    reduced(folder, "stuck.csv", |number, mut row| {
        if number > 0 {
            row[2] = "0.5".into();
        }
        row
    });
    refused("stuck.csv", &[], &["always reads 0.5"]);
    reduced(folder, "reversed.csv", |number, mut row| {
        if number > 0 {
            row[1] = format!("-{}", row[1]).replace("--", "");
        }
        row
    });
    let doubt = text_of(&assessed(folder, "reversed.csv", &[]).success());
    assert!(
        doubt.contains("no verdict") && !doubt.contains("worn:"),
        "{doubt}"
    );
    let new = ["--input", "reversed.csv", "--new-baseline", "other.json"];
    let error = error_of(&dashpot(&[&COMMAND[..], &new].concat(), folder).failure());
    assert!(
        error.contains("unexplained") && !folder.join("other.json").exists(),
        "{error}"
    );
    refused(
        "ride3/history.csv",
        &["--set", "body.mass_kg=60e3"],
        &["baseline has another vehicle file"],
    );
    fs::write(folder.join("baseline.json"), "{}").unwrap();
    refused(
        "ride3/history.csv",
        &[],
        &["baseline.json", "--new-baseline"],
    );
    let wagon = [
        "vehicle-sensors",
        "--vehicle",
        "freight-wagon",
        "--new-baseline",
        "b",
    ];
    let input = ["--input", "ride3/history.csv"];
    let error = error_of(&dashpot(&[&wagon[..], &input].concat(), folder).failure());
    assert!(error.contains("lateral damper"), "{error}");
}
