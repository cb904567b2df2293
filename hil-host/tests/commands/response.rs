//! `dashpot response` as a command.

use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_files::case::Case;
use dashpot_files::damper;
use dashpot_testbench::response::{at_amplitude, frequencies};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::{contains, starts_with};

use crate::common::{dashpot, files_in, json_of, json_on_stderr, text_of};

fn response(arguments: &[&str], folder: &Path) -> Assert {
    dashpot(&[&["response"], arguments].concat(), folder)
}

/// Row of a CSV file by column name.
fn rows(text: &str) -> Vec<std::collections::HashMap<String, String>> {
    csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .unwrap()
}

#[test]
fn every_value_is_in_the_file_and_in_json() {
    let folder = tempfile::tempdir().unwrap();
    let options = [
        "--damper",
        "in-service",
        "--amplitude-m",
        "1e-3,5e-3",
        "--from-hz",
        "0.5",
        "--to-hz",
        "8",
        "--points",
        "5",
        "--swept",
        "--output",
        "out.csv",
        "--page",
        "page.html",
        "--format",
        "json",
    ];
    let report = json_of(&response(&options, folder.path()).success());
    let rows = rows(&std::fs::read_to_string(folder.path().join("out.csv")).unwrap());
    let series = report["series"].as_array().unwrap();
    let kinds: Vec<&str> = series
        .iter()
        .map(|s| s["response"].as_str().unwrap())
        .collect();
    assert_eq!(
        kinds,
        ["harmonic", "swept", "harmonic", "swept", "linearised"]
    );
    assert_eq!(rows.len(), 25);
    let reported = series.iter().flat_map(|series| {
        let with_series = move |row| (series, row);
        series["rows"].as_array().unwrap().iter().map(with_series)
    });
    for (row, (series, reported)) in rows.iter().zip(reported) {
        assert_eq!(row["response"], series["response"].as_str().unwrap());
        assert_eq!(
            row["amplitude_m"].parse().ok(),
            series["amplitude_m"].as_f64()
        );
        for (key, value) in reported.as_object().unwrap() {
            let (cell, value) = (row[key].parse::<f64>().ok(), value.as_f64());
            assert_eq!(cell.is_some(), value.is_some(), "{key}");
            // The JSON reader may round the last digit.
            let difference = (cell.unwrap_or(0.0) - value.unwrap_or(0.0)).abs();
            assert!(difference <= 1e-15 * cell.unwrap_or(0.0).abs(), "{key}");
        }
    }
    let damper = damper::load("in-service", &[]).unwrap();
    let expected = at_amplitude(&damper, 5e-3, &frequencies(0.5, 8.0, 5)).unwrap();
    for (row, expected) in rows[10..15].iter().zip(&expected) {
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        assert_eq!(number("frequency_hz"), expected.frequency_hz);
        assert_eq!(
            number("dynamic_stiffness_n_per_m"),
            expected.stiffness_n_per_m()
        );
        assert_eq!(number("loss_angle_deg"), expected.loss_angle_deg().unwrap());
        assert_eq!(number("damping_n_s_per_m"), expected.damping_n_s_per_m());
    }
    for series in series {
        let largest = series["largest_difference"].as_f64();
        assert_eq!(largest.is_some(), series["response"] == "swept");
        assert!(largest.is_none_or(|largest| largest < 2e-3), "{largest:?}");
    }
    assert_eq!(report["swept_sine"]["window_cycles"], 2);
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains("Swept compared with harmonic") && page.contains("loss angle, °"));
}

/// The two commands in the help use the dampers of the study `paper`, at the amplitudes of its figures.
#[test]
fn figures_13b_and_18b_are_those_of_the_vehicles_dampers() {
    let folder = tempfile::tempdir().unwrap();
    let help = text_of(&response(&["--help"], folder.path()).success());
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let case = Case::load("straight-180").unwrap();
    for (name, damper_name, key, values, amplitude_m) in [
        (
            "reduced-vertical",
            "front vertical damper 1",
            "mount.stiffness_n_per_m",
            "2e6,6e6,10e6",
            "2e-3",
        ),
        (
            "reduced-lateral",
            "front lateral damper 1",
            "mount.clearance_m",
            "0.5e-3,1e-3,2e-3",
            "5e-3",
        ),
    ] {
        let over = format!("{key}={values}");
        let options = [
            "--damper",
            name,
            "--over",
            &over,
            "--amplitude-m",
            amplitude_m,
        ];
        let words = options.join(" ");
        let help = help.replace("\\ ", "");
        assert!(
            help.contains(&format!("dashpot response {words} --page fig1")),
            "{words}: {help}"
        );
        let csv = [&options[..], &["--points", "3", "--output", "-"]].concat();
        let rows = rows(&text_of(&response(&csv, folder.path()).success()));
        let harmonic: Vec<_> = rows
            .iter()
            .filter(|row| row["response"] == "harmonic")
            .collect();
        assert_eq!(harmonic.len(), 9);
        for (row, value) in harmonic.chunks(3).zip(values.split(',')) {
            let change = [format!("{key}={value}")];
            let damper =
                damper::change(damper_name, case.damper(damper_name).unwrap(), &change).unwrap();
            let amplitude = amplitude_m.parse().unwrap();
            let expected = at_amplitude(&damper, amplitude, &frequencies(0.1, 20.0, 3)).unwrap();
            for (row, expected) in row.iter().zip(&expected) {
                assert_eq!(row[key].parse::<f64>(), value.parse());
                let found: f64 = row["dynamic_stiffness_n_per_m"].parse().unwrap();
                assert_eq!(found, expected.stiffness_n_per_m());
            }
        }
    }
}

#[test]
fn text_lists_each_amplitude_and_those_without_force() {
    let options = [
        "--damper",
        "reduced-vertical",
        "--amplitude-m",
        "0.5e-3,2e-3",
        "--points",
        "3",
    ];
    let text = text_of(&response(&options, Path::new(".")).success());
    let line = |start: &str| {
        let found = text
            .lines()
            .find(|line| line.trim_start().starts_with(start));
        found.unwrap_or_else(|| panic!("{start} in {text}"))
    };
    // An amplitude within the clearance of 1 mm.
    assert!(line("0.5 mm").contains(" - "), "{text}");
    assert!(
        line("2 mm").contains("deg") && line("linearised").contains("deg"),
        "{text}"
    );
}

#[test]
fn data_on_standard_output_moves_the_report_to_standard_error() {
    let folder = tempfile::tempdir().unwrap();
    let options = [
        "--points",
        "2",
        "--amplitude-m",
        "1e-3",
        "--output",
        "-",
        "--format",
        "json",
    ];
    let ended = response(&options, folder.path()).success();
    assert_eq!(json_on_stderr(&ended)["files"][0], "standard output");
    assert!(text_of(&ended).starts_with("response,amplitude_m,frequency_hz,"));
}

#[test]
fn wrong_options_are_reported_and_leave_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["--output", "out.csv", "--page", "page.html"];
    for (options, part) in [
        (
            &["--amplitude-m", "1e-3,0"][..],
            "--amplitude-m: 0, allowed: above 0",
        ),
        (&["--amplitude-m", "wide"], "--amplitude-m"),
        (
            &["--from-hz", "0"],
            "--from-hz: 0, allowed: above 0 and at most 1000 Hz",
        ),
        (&["--to-hz", "nan"], "--to-hz: NaN, allowed"),
        (
            &["--from-hz", "5", "--to-hz", "5"],
            "--to-hz: 5, allowed: above --from-hz, 5 Hz",
        ),
        (&["--points", "1"], "2..=10000"),
        (&["--octaves-per-minute", "1"], "--swept"),
        (
            &["--swept", "--octaves-per-minute", "3"],
            "--octaves-per-minute: 3 octaves per minute from 0.1 Hz, allowed",
        ),
        (
            &["--swept", "--octaves-per-minute", "1e-6"],
            "steps, allowed: at most 2e9",
        ),
        (&["--over", "mount.clearance_m"], "allowed: KEY=VALUE,VALUE"),
        (
            &["--over", "mount.clearance_m=1e-3,wide"],
            "allowed: KEY=VALUE,VALUE",
        ),
        (
            &["--over", "mount.clearence_m=1e-3"],
            "did you mean `mount.clearance_m`",
        ),
        (
            &["--over", "mount.clearance_m=-1"],
            "--over mount.clearance_m: paper: mount.clearance_m = -1 is not allowed",
        ),
        (&["--amplitude-m", "0.5"], "limits.rate_m_per_s"),
    ] {
        response(&[options, &files].concat(), folder.path())
            .code(2)
            .stdout("")
            .stderr(starts_with("error: ").and(contains(part)));
        assert!(files_in(folder.path()).is_empty(), "{part}");
    }
    response(&["--output", "a", "--page", "a"], folder.path())
        .code(2)
        .stderr(contains("--output and --page: both are a"));
    // The error occurs while running: no partial file is left.
    let slow = [
        "--damper",
        "reduced-vertical",
        "--set",
        "mount.clearance_m=0.0",
        "--amplitude-m",
        "1e-4",
        "--to-hz",
        "1000",
        "--points",
        "2",
    ];
    response(&[&slow[..], &files].concat(), folder.path())
        .code(1)
        .stderr(contains("does not repeat within 200 cycles"));
    response(&["--output", "none/out.csv"], folder.path())
        .code(1)
        .stderr(contains("there is no folder none"));
    assert!(files_in(folder.path()).is_empty());
}
