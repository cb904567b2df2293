//! `dashpot sheet` as a command: a bench of another house becomes a sheet with a verdict.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::str::contains;
use sha2::{Digest, Sha256};

use crate::common::{dashpot, json_of, text_of};

/// Amplitude (mm) and stiffness and damping of the specimen, `F = K x + C v`.
const AMPLITUDE_MM: f64 = 10.0;
const STIFFNESS_KN_PER_MM: f64 = 0.1;
const DAMPING_KN_S_PER_MM: f64 = 0.02;

const SHEET: &str = r#"title = "Acceptance"
[[field]]
name = "Part number"
text = "SV-25"
[[test]]
name = "one hertz"
amplitude_m = 10e-3
frequency_hz = 1
[test.limits.dynamic_stiffness_n_per_m]
nominal = 160e3
tolerance_percent = TOLERANCE
clause = "drawing 12"
"#;

/// Writes a recording with other names, units and decimal marks: eight cycles at each frequency.
fn record(path: &Path, frequencies_hz: &[f64]) {
    let mut text = String::from("Zeit [ms];Weg [mm];Kraft [kN]\n");
    let mut start_s = 0.0;
    for frequency_hz in frequencies_hz {
        let w = TAU * frequency_hz;
        let ticks = (8.0 / frequency_hz / 2e-3) as u32;
        for tick in 0..ticks {
            let time_s = f64::from(tick) * 2e-3;
            let (sine, cosine) = (w * time_s).sin_cos();
            let x = AMPLITUDE_MM * sine;
            let force = STIFFNESS_KN_PER_MM * x + DAMPING_KN_S_PER_MM * w * AMPLITUDE_MM * cosine;
            let time_ms = 1e3 * (start_s + time_s);
            let line = format!("{time_ms:.1};{x:.6};{force:.6}").replace('.', ",");
            writeln!(text, "{line}").unwrap();
        }
        start_s += 8.0 / frequency_hz + 1.0;
    }
    fs::write(path, text).unwrap();
}

/// A folder with a recording, and the sheet with this tolerance (%).
fn bench(tolerance_percent: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let sheet = SHEET.replace("TOLERANCE", tolerance_percent);
    fs::write(folder.path().join("sheet.toml"), sheet).unwrap();
    record(&folder.path().join("bench.csv"), &[1.0]);
    folder
}

fn sheet(options: &[&str], folder: &Path) -> Assert {
    let channels =
        "sheet --time Zeit --displacement Weg --force Kraft --sheet sheet.toml --input bench.csv";
    let line: Vec<&str> = channels.split(' ').chain(options.iter().copied()).collect();
    dashpot(&line, folder)
}

#[test]
fn a_recording_becomes_a_sheet() {
    let folder = bench("5");
    let options =
        "--temperature-c 20 --operator Miller --serial-number 0815 --date 2026-11-28 --format json";
    let options: Vec<&str> = options.split(' ').collect();
    let report = json_of(&sheet(&options, folder.path()).success());
    assert_eq!(report["verdict"], "passed");
    let w = TAU;
    let stiffness_n_per_m = 1e6 * STIFFNESS_KN_PER_MM.hypot(DAMPING_KN_S_PER_MM * w);
    let test = &report["tests"][0];
    let measured = test["indices"]["dynamic_stiffness_n_per_m"]
        .as_f64()
        .unwrap();
    assert!(
        (measured / stiffness_n_per_m - 1.0).abs() < 1e-3,
        "{measured}"
    );
    assert!((test["amplitude_m"].as_f64().unwrap() / 10e-3 - 1.0).abs() < 1e-3);
    assert_eq!(test["temperature_c"], 20.0);
    assert_eq!(test["recording"], "bench.csv");
    let file = fs::read(folder.path().join("bench.csv")).unwrap();
    let digest: String = Sha256::digest(&file)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    assert_eq!(report["recordings"][0]["sha256"], digest);
    let fields = report["fields"].as_array().unwrap();
    let names: Vec<&str> = fields
        .iter()
        .map(|field| field["name"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "Part number",
            "Serial number",
            "Date of the test",
            "Operator"
        ]
    );
}

#[test]
fn the_verdict_is_stamped_and_is_the_exit_code() {
    let page = ["--page", "page.html"];
    // The stiffness is 160.6 kN/m, 0.37 % above the nominal value.
    for (tolerance, more, word, code) in [
        ("5", "", "PASSED", 0),
        ("0.2", "", "FAILED", 1),
        ("0.5", "--force-uncertainty-percent 1", "UNDECIDED", 1),
    ] {
        let folder = bench(tolerance);
        let options: Vec<&str> = page.into_iter().chain(more.split_whitespace()).collect();
        let ended = sheet(&options, folder.path()).code(code);
        assert!(text_of(&ended).contains(&format!("\n{word}: ")), "{word}");
        let page = fs::read_to_string(folder.path().join("page.html")).unwrap();
        let class = if code == 0 { "stamp good" } else { "stamp bad" };
        assert!(
            page.contains(&format!("<div class=\"{class}\"><b>{word}</b>")),
            "{word}"
        );
        assert!(page.contains("Signature"));
    }
}

#[test]
fn a_missing_test_is_named_and_a_foreign_motion_too() {
    let folder = bench("5");
    record(&folder.path().join("bench.csv"), &[3.0]);
    let ended = sheet(&[], folder.path()).code(1);
    let text = text_of(&ended);
    assert!(text.contains("warning: not measured: one hertz"), "{text}");
    assert!(
        text.contains("±10.000 mm at 3.0000 Hz belongs to no test of the sheet"),
        "{text}"
    );
    assert!(
        text.contains("INCOMPLETE: no limits; 1 test not measured"),
        "{text}"
    );
}

/// A logger that crashed leaves a line without an end.
#[test]
fn a_doubtful_recording_is_named_on_the_sheet() {
    let folder = bench("5");
    let path = folder.path().join("bench.csv");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.trim_end()).unwrap();
    let ended = sheet(&["--page", "page.html"], folder.path()).success();
    let doubt = "bench.csv: the last line, line 4001, has no line end";
    assert!(text_of(&ended).contains(&format!("warning: {doubt}")));
    let page = fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains(doubt));
}

#[test]
fn wrong_use_says_what_to_give() {
    let folder = bench("5");
    let two = ["--temperature-c", "20", "--temperature-c", "30"];
    sheet(&two, folder.path()).code(2).stderr(contains(
        "--temperature-c: 2 values for 1 recording; give one for all, or one for each --input",
    ));
    sheet(&["--input", "-"], folder.path())
        .code(2)
        .stderr(contains("give the name of a file"));
    sheet(&["--input", "./bench.csv"], folder.path())
        .code(2)
        .stderr(contains("given twice"));
    sheet(&["--page", "bench.csv"], folder.path())
        .code(2)
        .stderr(contains("this is also an input file"));
    let still = "Zeit [ms];Weg [mm];Kraft [kN]\n0;1;0\n1;1;0\n2;1;0\n";
    fs::write(folder.path().join("bench.csv"), still).unwrap();
    sheet(&[], folder.path())
        .code(1)
        .stderr(contains("bench.csv: the displacement does not oscillate"));
}
