//! `dashpot contact` from outside: its numbers, its plots, its failures.

use std::process::{Command, Output};

fn dashpot(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .arg("contact")
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_default_pair_is_told_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let plots = folder.path().join("plots");
    let output = dashpot(&["--format", "json", "--plots", plots.to_str().unwrap()]);
    assert!(output.status.success(), "{output:?}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let conicity = report["conicity_at_3mm"].as_f64().unwrap();
    assert!((0.165..0.185).contains(&conicity), "{conicity}");
    let centred = report["shifts"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["lateral_shift_m"].as_f64().unwrap().abs() < 1e-9)
        .unwrap();
    assert!(
        centred["rolling_radius_difference_m"]
            .as_f64()
            .unwrap()
            .abs()
            < 1e-9
    );
    let mut names: Vec<String> = std::fs::read_dir(&plots)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(
        names,
        ["conicity.svg", "contact-points.svg", "rolling-radius.svg"]
    );
    for name in names {
        let svg = std::fs::read_to_string(plots.join(name)).unwrap();
        assert!(svg.starts_with("<svg width=\"1000\"") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("polyline"));
    }
}

#[test]
fn text_tells_conicity_over_amplitude() {
    let output = dashpot(&["--no-plots"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("S1002 on UIC 60, rails 1:40"), "{text}");
    assert!(text.contains("           3.0     0.18"), "{text}");
}

#[test]
fn failures_say_what_and_what_is_allowed() {
    for (arguments, code, part) in [
        (
            &["--wheel", "none.csv"][..],
            1,
            "none.csv: no such profile, allowed: s1002",
        ),
        (
            &["--gauge-m", "1.2", "--no-plots"][..],
            1,
            "allowed: 0.03 to 0.12 m",
        ),
        (&["--smoothing-m", "-1"][..], 2, "unexpected argument '-1'"),
        (
            &["--smoothing-m=1"][..],
            1,
            "--smoothing-m: 1, allowed: 0 to 0.05 m",
        ),
        (&["--format", "xml"][..], 2, "possible values: text, json"),
    ] {
        let output = dashpot(arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
}
