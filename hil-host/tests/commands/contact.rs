//! `dashpot contact` as a command: its values, plots and errors.

use std::path::Path;

use assert_cmd::assert::Assert;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use crate::common::{dashpot, dashpot_reading, json_of, text_of};

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

/// Writes a wheel and a rail, as a profile gauge would write them, into an otherwise empty folder.
fn folder_of(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

const WHEEL: (&str, &str) = ("x.whl", include_str!("../../../rail/tests/data/s1002.whl"));
const RAIL: (&str, &str) = ("y.ban", include_str!("../../../rail/tests/data/uic60.ban"));
const GENSYS_RAIL: (&str, &str) = (
    "z.rail",
    include_str!("../../../rail/tests/data/uic60.rail"),
);

#[test]
fn files_of_a_profile_gauge_are_reported_with_omitted_points() {
    let folder = folder_of(&[WHEEL, RAIL]);
    let arguments = ["contact", "--wheel", "x.whl", "--rail", "y.ban"];
    let output = dashpot(&arguments, folder.path()).success();
    let text = text_of(&output);
    for part in [
        "x on y, rails 1:40",
        "x: miniprof, 6 of 200 points removed at the ends\n",
        "y: miniprof, 15 of 169 points removed at the ends, rotated by 180 degrees",
        // S1002 on UIC 60: literature 0.17 to 0.18.
        "           3.0     0.18",
        "plots: contact-plots/contact-points.svg",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let output = dashpot(
        &[&arguments[..], &["--no-plots", "--format", "json"]].concat(),
        folder.path(),
    );
    let report = json_of(&output.success());
    assert_eq!(report["wheel_file"]["format"], "miniprof");
    assert_eq!(report["wheel_file"]["points_overhanging"], 6);
    assert_eq!(report["rail_file"]["turned"], true);
    let built_in = json_of(&contact(&["--no-plots", "--format", "json"]));
    assert!(built_in["rail_file"].is_null());
    let conicity = |report: &serde_json::Value| report["conicity_at_3mm"].as_f64().unwrap();
    let off = conicity(&report) - conicity(&built_in);
    assert!(off.abs() < 2e-3, "{off}");
}

#[test]
fn the_side_of_a_gensys_rail_is_asked_for() {
    let folder = folder_of(&[GENSYS_RAIL]);
    let command = ["contact", "--no-plots", "--rail", "z.rail"];
    dashpot(&command, folder.path())
        .code(1)
        .stdout("")
        .stderr(contains("z.rail: side not stated").and(contains("option mirror")));
    let stated = [&command[..], &["--rail-mirror", "y"]].concat();
    let output = dashpot(&stated, folder.path()).success();
    assert!(text_of(&output).contains("z: gensys, 0 of 154 points"));
    // Standard input has no file extension that indicates the format.
    let piped = [
        "contact",
        "--no-plots",
        "--rail",
        "-",
        "--rail-format",
        "gensys",
        "--rail-mirror",
        "y",
    ];
    let output = dashpot_reading(GENSYS_RAIL.1.as_bytes(), &piped, folder.path()).success();
    assert!(text_of(&output).contains("standard input: gensys, 0 of 154 points"));
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

/// Returns S1002 as two columns, with waves of 10 mm length and 0.15 mm amplitude worn into its tread.
fn worn_wheel() -> String {
    let (_, rows) = include_str!("../../../rail/tests/data/s1002.csv")
        .split_once("y_mm,z_mm\n")
        .unwrap();
    let mut text = String::from("y_mm,z_mm\n");
    for row in rows.lines() {
        let (y, z) = row.split_once(',').unwrap();
        let (y, z): (f64, f64) = (y.parse().unwrap(), z.parse().unwrap());
        let is_tread = (-20.0..40.0).contains(&y);
        let wave = if is_tread {
            0.15 * (std::f64::consts::TAU * y / 10.0).sin()
        } else {
            0.0
        };
        text += &format!("{y},{}\n", z + wave);
    }
    text
}

/// The geometry of a pair whose contact force jumps is reported, but no vehicle can run on it.
#[test]
fn a_pair_whose_force_jumps_is_reported_with_the_location() {
    let folder = folder_of(&[("worn.csv", &worn_wheel())]);
    let command = ["contact", "--no-plots", "--wheel", "worn.csv"];
    let text = text_of(&dashpot(&command, folder.path()).success());
    let said = "contact tables of this pair are rejected: at a lateral shift of";
    assert!(text.contains(said), "{text}");
    let json = [&command[..], &["--format", "json"]].concat();
    let report = json_of(&dashpot(&json, folder.path()).success());
    let jump = &report["force_jump"];
    let number = |name: &str| jump[name].as_f64().unwrap();
    assert!(number("jump_n") > number("allowed_n") + 0.15 * number("load_n"));
    let place = format!("shift of {:.6} m", number("lateral_m"));
    assert!(text.contains(&place), "{place}: {text}");

    let built_in = json_of(&contact(&["--no-plots", "--format", "json"]));
    assert!(built_in["force_jump"].is_null());
    assert!(!text_of(&contact(&["--no-plots"])).contains("rejected"));
}
