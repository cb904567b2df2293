//! `dashpot hybrid` as a command: the benchmark, its records and its errors.

use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::str::contains;
use serde_json::Value;
use xtask::tools::{GCC, have};

use crate::common::dashpot;

fn benchmark(arguments: &[&str], folder: &Path) -> Assert {
    dashpot(&[&["hybrid", "benchmark"], arguments].concat(), folder)
}

fn here() -> &'static Path {
    Path::new(".")
}

#[test]
fn the_adaptive_compensator_follows_and_none_is_unstable() {
    let output = benchmark(
        &["--case", "1", "--plants", "2", "--format", "json"],
        here(),
    )
    .success();
    let rows: Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
    assert_eq!(rows[0]["runs"], 3);
    assert_eq!(rows[0]["unstable"], 0);
    assert!(rows[0]["first"]["j2_percent"].as_f64().unwrap() < 1.0);
    assert!(rows[0]["worst"]["j2_percent"].as_f64().unwrap() < 2.0);
    benchmark(
        &["--case", "1", "--plants", "0", "--compensate", "none"],
        here(),
    )
    .success()
    .stdout(contains("1 of 1 unstable"));
}

/// A record of rows far apart is followed on straight lines, and its scale does not change relative errors.
#[test]
fn a_record_is_read_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let row = |n: u32| {
        format!(
            "{},{:.5}\n",
            f64::from(n) * 0.02,
            (f64::from(n) * 0.4).sin()
        )
    };
    let rows: String = (0..500).map(row).collect();
    fs::write(
        folder.path().join("record.csv"),
        format!("time_s,acceleration_m_per_s2\n{rows}"),
    )
    .unwrap();
    let j4 = |scale: &str| {
        let options = [
            "--record",
            "record.csv",
            "--plants",
            "0",
            "--case",
            "2",
            "--sensors",
            "perfect",
        ];
        let more = [
            "--compensate",
            "inverse",
            "--scale",
            scale,
            "--format",
            "json",
        ];
        let output = benchmark(&[&options[..], &more].concat(), folder.path()).success();
        let rows: Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
        rows[0]["first"]["j4_percent"].as_f64().unwrap()
    };
    let (one, half) = (j4("1"), j4("0.5"));
    assert!(one > 0.0 && (one - half).abs() < 1e-3, "{one} {half}");
}

#[test]
fn bad_input_is_refused_with_what_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    for (text, message) in [
        (
            "time,acceleration\n0,0\n",
            "record.csv, line 1: must be time_s,acceleration_m_per_s2",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n1,x\n",
            "record.csv, line 3: `x` is not a number",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n0,1\n",
            "line 3: time_s must increase",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n1,101\n",
            "line 3: acceleration_m_per_s2 must be -100 to 100",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n601,1\n",
            "must not be longer than 600 s",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n",
            "must have at least two rows",
        ),
        (
            "time_s,acceleration_m_per_s2\n0,0\n1,0\n",
            "the ground does not move",
        ),
    ] {
        fs::write(folder.path().join("record.csv"), text).unwrap();
        benchmark(&["--record", "record.csv"], folder.path())
            .code(1)
            .stderr(contains(message));
    }
    benchmark(&["--record", "missing.csv"], folder.path()).code(1);
    benchmark(&["--case", "5"], here()).code(2);
    benchmark(&["--stiffness-n-per-m", "nan"], here())
        .code(2)
        .stderr(contains("--stiffness-n-per-m NaN is not allowed"));
}

/// The source and its header are written together, and compile with any C99 compiler.
#[test]
fn the_transfer_system_is_exported_as_portable_c() {
    let folder = tempfile::tempdir().unwrap();
    let export =
        |arguments: &[&str]| dashpot(&[&["hybrid", "export"], arguments].concat(), folder.path());
    export(&["--name", "FRONT", "--output", "front.c"])
        .success()
        .stdout("FRONT in front.c, declared in front.h\n");
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("front.c").contains("dashpot hybrid export --name FRONT --output 'front.c'"));
    assert!(read("front.c").contains("#include \"front.h\""));
    assert!(read("front.h").contains("front_command front_tick(front_system *system,"));
    let whole = export(&["--output", "-"]).success();
    let whole = String::from_utf8_lossy(&whole.get_output().stdout).into_owned();
    assert!(whole.contains("transfer_tick(") && !whole.contains("#include \"transfer.h\""));
    if have(&[GCC], "the exported transfer system") {
        let mut gcc = std::process::Command::new(GCC.program);
        gcc.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "front.c"]);
        assert!(gcc.current_dir(folder.path()).status().unwrap().success());
    }
    export(&["--name", "front", "--output", "x.c"])
        .failure()
        .stderr(contains("front"));
    export(&["--output", "front.h"])
        .code(2)
        .stderr(contains("allowed: another extension, such as .c"));
    assert!(!folder.path().join("x.c").exists());
}
