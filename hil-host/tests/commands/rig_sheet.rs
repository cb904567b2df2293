//! `dashpot rig --sheet` as a command: values, verdicts, the page, and rejected files.

use std::fs;
use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::{contains, starts_with};

use crate::common::{dashpot, dashpot_reading, files_in, json_of, json_on_stderr, text_of};

/// Two motions, with limits filled in by each test.
const SHEET: &str = "title = \"Damper <7>\"

[[field]]
name = \"Part number\"
text = \"4711 & 4712\"

[[test]]
name = \"slow\"
amplitude_m = 24.875e-3
frequency_hz = 0.64

[test.limits.max_extension_force_n]
least = LEAST
clause = \"drawing 12, 3.4\"

[[test]]
name = \"fast\"
frequency_hz = 4
velocity_m_per_s = 0.1
";

fn rig(arguments: &[&str], folder: &Path) -> Assert {
    dashpot(&[&["rig"], arguments].concat(), folder)
}

/// A folder with the sheet, whose limit is `limit_n` (N).
fn with_sheet(limit_n: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = SHEET.replace("LEAST", limit_n);
    fs::write(folder.path().join("sheet.toml"), text).unwrap();
    folder
}

#[test]
fn a_test_of_a_sheet_is_the_bench_test() {
    let folder = with_sheet("1e3");
    let options = ["--sheet", "sheet.toml", "--format", "json"];
    let sheet = json_of(&rig(&options, folder.path()).success());
    let alone = json_of(&rig(&["--format", "json"], folder.path()).success());
    let test = &sheet["tests"][0];
    for key in [
        "max_extension_force_n",
        "max_compression_force_n",
        "asymmetry_rate",
        "energy_per_cycle_j",
        "damping_coefficient_n_s_per_m",
    ] {
        assert_eq!(test["indices"][key], alone[key], "{key}");
    }
    for key in [
        "amplitude_m",
        "frequency_hz",
        "peak_velocity_m_per_s",
        "step_s",
        "cycles",
    ] {
        assert_eq!(test[key], alone[key], "{key}");
    }
    assert_eq!(test["temperature_c"], 45.0);
    assert_eq!(sheet["fields"][0]["text"], "4711 & 4712");
    let limit = &test["limits"][0];
    assert_eq!(limit["value"], alone["max_extension_force_n"]);
    assert_eq!(limit["clause"], "drawing 12, 3.4");
    assert_eq!((&limit["kept"], &limit["most"]), (&true.into(), &().into()));
    assert_eq!(sheet["limits"], 1);
    assert_eq!(sheet["limits_not_kept"], 0);
}

#[test]
fn a_violated_limit_exits_with_1_and_the_sheet_is_written() {
    let folder = with_sheet("20e3");
    let options = ["--sheet", "sheet.toml", "--page", "page.html"];
    let ended = rig(&options, folder.path())
        .code(1)
        .stderr("error: 1 of 1 limit violated\n");
    let text = text_of(&ended);
    let line = text
        .lines()
        .find(|line| line.contains("drawing 12, 3.4"))
        .unwrap();
    assert!(
        line.contains("outside") && line.contains("at least 20 "),
        "{text}"
    );
    let page = fs::read_to_string(folder.path().join("page.html")).unwrap();
    for words in [
        "Damper &lt;7&gt;",
        "4711 &amp; 4712",
        "tr class=\"over\"",
        "drawing 12, 3.4",
        "<b>FAILED</b><span>1 of 1 limit violated</span>",
        "computed from its model, not measured",
        "against its peak velocity",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // With one temperature there is no curve over temperature.
    assert!(!page.contains("Forces against temperature"));
}

/// A value outside its limit by less than the usual rounding is printed with enough digits to show it.
#[test]
fn a_value_just_outside_differs_from_its_limit() {
    let folder = with_sheet("1e3");
    let alone = json_of(&rig(&["--format", "json"], folder.path()).success());
    let force = alone["max_extension_force_n"].as_f64().unwrap();
    // The force rounded up to the usual resolution of 10 N.
    let rounded_n = (force / 10.0).ceil() * 10.0;
    assert!(rounded_n > force && rounded_n < force + 10.0);
    let folder = with_sheet(&format!("{:.3}", force + 0.4));
    let ended = rig(&["--sheet", "sheet.toml"], folder.path()).code(1);
    let text = text_of(&ended);
    let line = text.lines().find(|line| line.contains("drawing")).unwrap();
    let printed_kn: f64 = line.split_whitespace().nth(4).unwrap().parse().unwrap();
    assert!(printed_kn * 1e3 < force + 0.4, "{line}");
}

#[test]
fn the_shipped_sheet_lists_temperatures_and_speeds() {
    let folder = tempfile::tempdir().unwrap();
    let options = [
        "--damper",
        "in-service",
        "--sheet",
        "example",
        "--page",
        "-",
        "--format",
        "json",
    ];
    let ended = rig(&options, folder.path()).success();
    let report = json_on_stderr(&ended);
    let tests = report["tests"].as_array().unwrap();
    let force = |name: &str| {
        let test = tests.iter().find(|test| test["name"] == name).unwrap();
        test["indices"]["max_extension_force_n"].as_f64().unwrap()
    };
    // Cold oil is denser and more viscous.
    assert!(force("0.1 m/s, cold") > force("0.1 m/s"));
    assert!(force("0.1 m/s") > force("0.1 m/s, warm"));
    assert!(force("0.2 m/s") > force("0.1 m/s"));
    let page = text_of(&ended);
    assert!(page.contains("Forces against temperature"));
    assert_eq!(report["page"], "standard output");
}

#[test]
fn a_sheet_comes_through_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = SHEET.replace("LEAST", "1e3");
    dashpot_reading(sheet.as_bytes(), &["rig", "--sheet", "-"], folder.path())
        .success()
        .stdout(contains("1 limit, all met"));
    dashpot(&["rig", "--sheet", "-", "--damper", "-"], folder.path())
        .code(2)
        .stderr(contains("--damper and --sheet: `-` is standard input"));
}

#[test]
fn errors_are_reported_with_their_location_and_leave_no_page() {
    let folder = with_sheet("1e3");
    let page = ["--page", "page.html"];
    let sheet = |text: &str| fs::write(folder.path().join("sheet.toml"), text).unwrap();
    let good = SHEET.replace("LEAST", "1e3");
    for (text, damper, part) in [
        (
            "title = 1\n".to_owned(),
            "paper",
            "sheet.toml: TOML parse error at line 1",
        ),
        (
            good.replace("clause", "claus"),
            "paper",
            "did you mean `clause`?",
        ),
        (
            good.replace("name = \"fast\"", "name = \"slow\""),
            "paper",
            "sheet.toml:16: duplicate test name `slow`",
        ),
        (
            good.replace("frequency_hz = 4", "frequency_hz = 4\ntemperature_c = 20"),
            "reduced-vertical",
            "sheet.toml:16: test `fast`: temperature_c: the reduced damper",
        ),
        (
            good.replace("velocity_m_per_s = 0.1", "velocity_m_per_s = 9"),
            "paper",
            "sheet.toml:16: test `fast`: the motion reaches 9.000 m/s",
        ),
    ] {
        sheet(&text);
        let options = [&["--sheet", "sheet.toml", "--damper", damper], &page[..]].concat();
        rig(&options, folder.path())
            .code(1)
            .stdout("")
            .stderr(starts_with("error: ").and(contains(part)));
        assert_eq!(files_in(folder.path()), ["sheet.toml"]);
    }
    sheet(&good);
    for (options, part) in [
        (&["--sheet", "exampel"][..], "did you mean `example`?"),
        (
            &["--sheet", "sheet.toml", "--frequency-hz", "1"],
            "cannot be used with",
        ),
        (
            &["--sheet", "sheet.toml", "--plots", "plots"],
            "cannot be used with",
        ),
        (&["--page", "page.html"], "--sheet"),
        (
            &["--sheet", "sheet.toml", "--page", "sheet.toml"],
            "--page sheet.toml: this is also an input file",
        ),
    ] {
        rig(options, folder.path()).code(2).stderr(contains(part));
        assert_eq!(files_in(folder.path()), ["sheet.toml"]);
    }
    rig(&["--sheet", "none.toml"], folder.path())
        .code(1)
        .stderr(contains("none.toml: cannot read"));
}
