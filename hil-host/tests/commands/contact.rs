//! `dashpot contact` from outside: its numbers, its plots, its failures.

use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::str::contains;

use crate::common::{dashpot, json_of, text_of};

fn contact(arguments: &[&str]) -> Assert {
    dashpot(&[&["contact"], arguments].concat(), Path::new("."))
}

#[test]
fn the_default_pair_is_reported_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let plots = folder.path().join("plots");
    let output = contact(&["--format", "json", "--plots", plots.to_str().unwrap()]).success();
    let report = json_of(&output);
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
fn text_reports_conicity_over_amplitude() {
    let output = contact(&["--no-plots"]);
    let text = text_of(&output);
    assert!(text.contains("S1002 on UIC 60, rails 1:40"), "{text}");
    assert!(text.contains("           3.0     0.18"), "{text}");
}

#[test]
fn a_refused_profile_leaves_no_plots() {
    let folder = tempfile::tempdir().unwrap();
    let (file, plots) = (folder.path().join("rail.csv"), folder.path().join("plots"));
    for (text, part) in [
        ("y_mm,z_mm\n0,0\n1,0\n", "too few points: 2"),
        ("0,0\n1,nan\n", "rail.csv:2: column z_mm: \"nan\""),
        ("0,0,0\n", "3 columns"),
        ("", "too few points: 0"),
    ] {
        std::fs::write(&file, text).unwrap();
        let output = contact(&[
            "--rail",
            file.to_str().unwrap(),
            "--plots",
            plots.to_str().unwrap(),
        ])
        .code(1);
        output.stdout("").stderr(contains(part));
        assert!(!plots.exists());
    }
}
