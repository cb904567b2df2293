//! `dashpot calibrate` over several recordings, each at its temperature, with one held back and a choice of the next.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use dashpot_files::damper::load;
use predicates::str::contains;

use crate::common::{dashpot, json_of, text_of};

const STEP_S: f64 = 1e-3;

/// Writes six cycles of 20 mm of `in-service` with a discharge coefficient of 0.66 at a temperature.
fn record(path: &Path, frequency_hz: f64, temperature_c: f64) {
    let overrides = [
        "orifice.discharge_coefficient=0.66".to_owned(),
        format!("oil.temperature_c={temperature_c:?}"),
    ];
    let damper = load("in-service", &overrides).unwrap();
    let damper = damper.build::<f64>(STEP_S).unwrap();
    let mut state = damper.at_rest(0.0);
    let mut text = String::from("time_s,displacement_m,force_n\n");
    for tick in 0..(6.0 / frequency_hz / STEP_S) as u32 {
        let time_s = f64::from(tick) * STEP_S;
        let x = 0.02 * (TAU * frequency_hz * time_s).sin();
        let force = damper.step(&mut state, x);
        // A little noise that repeats only after the recording.
        let noise = f64::from(tick.wrapping_mul(2_654_435_761) >> 16) / 32_768.0 - 1.0;
        writeln!(text, "{time_s:.3},{x:.9},{:.3}", force + 20.0 * noise).unwrap();
    }
    fs::write(path, text).unwrap();
}

const LINE: &str = "calibrate --damper in-service --input warm.csv --input cold.csv --validate fast.csv \
                    --vary orifice.discharge_coefficient --output found.toml --no-skew";

fn bench() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, frequency_hz, temperature_c) in [
        ("warm.csv", 1.0, 50.0),
        ("cold.csv", 0.7, -10.0),
        ("fast.csv", 2.0, 20.0),
    ] {
        record(&folder.path().join(name), frequency_hz, temperature_c);
    }
    folder
}

#[test]
fn temperatures_held_back_recordings_and_the_next_test() {
    let folder = bench();
    let options = "--temperature-c 50 --temperature-c -10 --temperature-c 20 --vary-each force_offset_n \
                   --plan example --page found.html --format json";
    let line: Vec<&str> = LINE.split(' ').chain(options.split(' ')).collect();
    let report = json_of(&dashpot(&line, folder.path()).success());
    let found = |key: &str| {
        let numbers = report["numbers"].as_array().unwrap();
        let number = numbers.iter().find(|number| number["key"] == key);
        number.unwrap_or_else(|| panic!("no {key}"))["found"]
            .as_f64()
            .unwrap()
    };
    assert!((found("orifice.discharge_coefficient") / 0.66 - 1.0).abs() < 0.01);
    assert!(found("force_offset_n@1").abs() < 20.0 && found("force_offset_n@2").abs() < 20.0);
    let held_back = &report["validation"][0];
    assert_eq!(held_back["test"], "fast.csv");
    assert!(
        held_back["error_share"].as_f64().unwrap() < 0.01,
        "{held_back}"
    );
    let plan = report["plan"].as_array().unwrap();
    assert_eq!(plan[0]["test"], "0.05 m/s");
    let share = plan[0]["shares"][0][1].as_f64().unwrap();
    assert!(share > 0.0 && share < 1.0, "{share}");
    // The indices are those at the temperature of the recording.
    let rows = report["indices"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let measured = row["measured"]["energy_per_cycle_j"].as_f64().unwrap();
        let after = row["after"]["energy_per_cycle_j"].as_f64().unwrap();
        assert!((after / measured - 1.0).abs() < 0.01, "{row}");
    }
    let page = fs::read_to_string(folder.path().join("found.html")).unwrap();
    assert!(page.contains("Held back and predicted") && page.contains("The next test"));
}

#[test]
fn a_wrong_number_of_temperatures_is_refused() {
    let folder = bench();
    let options = "--temperature-c 50 --temperature-c -10";
    let line: Vec<&str> = LINE.split(' ').chain(options.split(' ')).collect();
    let ended = dashpot(&line, folder.path()).code(2);
    let ended = ended.stderr(contains(
        "--temperature-c: 2 values for 3 recordings; give one for all, or one for each --input and each --validate",
    ));
    assert!(text_of(&ended).is_empty());
    assert!(!folder.path().join("found.toml").exists());
}
