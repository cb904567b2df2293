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

/// Every patch of a report with `under_load`, with its shift and its wheel.
fn patches(report: &serde_json::Value) -> Vec<(f64, &'static str, serde_json::Value)> {
    let mut found = Vec::new();
    for shift in report["under_load"]["shifts"].as_array().unwrap() {
        for side in ["left", "right"] {
            for patch in shift[side]["patches"].as_array().unwrap() {
                found.push((number(&shift["lateral_shift_m"]), side, patch.clone()));
            }
        }
    }
    found
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_load_adds_patches_forces_and_the_elastic_conicity() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "contact",
        "--load-kn",
        "100",
        "--friction",
        "0.3",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&arguments, folder.path()).success());
    let loaded = &report["under_load"];
    assert_eq!(number(&loaded["load_n"]), 100e3);
    assert_eq!(number(&loaded["friction"]), 0.3);
    // The keys without a load stay.
    let plain = json_of(&dashpot(
        &["contact", "--no-plots", "--format", "json"],
        folder.path(),
    ));
    assert!(plain["under_load"].is_null());
    for key in [
        "conicity",
        "shifts",
        "conicity_at_3mm",
        "wheel_file",
        "gauge_m",
    ] {
        assert_eq!(report[key], plain[key], "{key}");
    }
    assert_eq!(report["warnings"], serde_json::json!([]));
    // Both wheels of a symmetric wheelset at 0 to 8 mm.
    let patches = patches(&report);
    let shifts: Vec<f64> = patches.iter().map(|patch| patch.0).collect();
    assert_eq!((shifts[0], shifts[shifts.len() - 1]), (0.0, 8e-3));
    for shift in loaded["shifts"].as_array().unwrap() {
        for side in ["left", "right"] {
            let wheel = &shift[side];
            assert!(
                (number(&wheel["vertical_force_n"]) / 100e3 - 1.0).abs() < 1e-3,
                "{shift}"
            );
            let ratio = number(&wheel["lateral_force_n"]) / number(&wheel["vertical_force_n"]);
            assert!((ratio - number(&wheel["derailment_coefficient"])).abs() < 1e-9);
        }
    }
    for (shift_m, side, patch) in &patches {
        let [load_n, along_n, across_n] = [
            "load_n",
            "longitudinal_creep_force_n",
            "lateral_creep_force_n",
        ]
        .map(|key| number(&patch[key]));
        assert!(
            along_n.hypot(across_n) < 0.3 * load_n * 1.001,
            "{shift_m} {side} {patch}"
        );
    }
    let svg = std::fs::read_to_string(folder.path().join("contact-plots/patches.svg")).unwrap();
    assert!(svg.contains("right wheel, shift 8.00 mm") && svg.contains("polygon"));
    assert!(
        std::fs::read_to_string(folder.path().join("contact-plots/conicity.svg"))
            .unwrap()
            .contains("elastic: 0.")
    );
}

#[test]
fn the_text_lists_the_elastic_conicity_beside_the_rigid_one() {
    let arguments = [
        "--no-plots",
        "--load-kn",
        "80",
        "--lateral-mm",
        "-1.5,6.2",
        "--yaw-mrad",
        "3",
    ];
    let text = text_of(&contact(&arguments).success());
    for part in [
        "of the rigid wheelset, and on elastic patches under 80 kN per wheel",
        "wheelset under load: 80 kN per wheel, 100 km/h, yaw 3 mrad, friction 0.4, neither driven nor braked",
        "     -1.50    left    80.0",
        "      6.20   right    80.0",
        "estimates: ",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
}

#[test]
fn patches_are_those_of_exact_theory_but_for_the_roll() {
    // The exact cases have a wheel without roll, the command a wheelset that rests on both rails. Centred, both are
    // equal: 100 kN, friction 0.3, 20 m/s.
    let options = [
        "--load-kn",
        "100",
        "--friction",
        "0.3",
        "--speed-km-h",
        "72",
        "--lateral-mm",
        "0",
    ];
    let report = json_of(&contact(
        &[&["--no-plots", "--format", "json"], &options[..]].concat(),
    ));
    for (_, side, patch) in patches(&report) {
        let off_mm = 1e3 * number(&patch["track_y_m"]) - 750.3847;
        assert!(off_mm.abs() < 0.25, "{side}: {off_mm} mm");
        let pressure = number(&patch["peak_pressure_pa"]) / 893.7e6;
        assert!((pressure - 1.0).abs() < 0.2, "{side}: {pressure}");
        let angle = number(&patch["contact_angle_rad"]) - 0.0351;
        assert!(angle.abs() < 3e-3, "{side}: {angle}");
        // The force of the spin depends on the width of the ellipse, which stands for two summits of pressure here.
        let across = number(&patch["lateral_creep_force_n"]) - 2925.0;
        assert!(across.abs() < 800.0, "{side}: {across}");
    }
}

#[test]
fn an_unequal_left_side_is_reported_apart() {
    let folder = folder_of(&[WHEEL, RAIL]);
    let arguments = [
        "contact",
        "--left-wheel",
        "x.whl",
        "--left-rail",
        "y.ban",
        "--load-kn",
        "60",
        "--lateral-mm",
        "0",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&arguments, folder.path()).success());
    assert_eq!(
        (&report["wheel"], &report["left_wheel"]),
        (&"S1002".into(), &"x".into())
    );
    assert_eq!(report["left_rail_file"]["format"], "miniprof");
    assert!(report["wheel_file"].is_null());
    // The file has the same profile, so both sides are nearly mirrored.
    let [left, right] =
        ["left", "right"].map(|side| report["under_load"]["shifts"][0][side]["patches"][0].clone());
    assert!(
        (number(&left["wheel_y_m"]) - number(&right["wheel_y_m"])).abs() < 0.3e-3,
        "{left} {right}"
    );
    assert!(
        folder
            .path()
            .join("contact-plots/contact-points-left.svg")
            .exists()
    );
}

/// UIC 60 in two columns, turned as a rail that is laid at 1:40.
fn laid_rail() -> String {
    let (sin, cos) = f64::atan(0.025).sin_cos();
    let rows = include_str!("../../../rail/tests/data/uic60.csv")
        .lines()
        .filter_map(|line| {
            let (y, z) = line.split_once(',')?;
            let (y, z): (f64, f64) = (y.trim().parse().ok()?, z.trim().parse().ok()?);
            Some(format!(
                "{:.3} {:.3}\n",
                y * cos + z * sin,
                z * cos - y * sin
            ))
        });
    rows.collect()
}

#[test]
fn a_rail_file_that_contains_its_inclination_is_recognised() {
    let upright = include_str!("../../../rail/tests/data/uic60.csv");
    let folder = folder_of(&[("laid.csv", &laid_rail()), ("upright.csv", upright)]);
    let read = |options: &[&str]| {
        let arguments = [
            &["contact", "--no-plots", "--format", "json", "--rail"],
            options,
        ]
        .concat();
        json_of(&dashpot(&arguments, folder.path()).success())
    };
    let twice = read(&["laid.csv"]);
    let warning = twice["warnings"][0].as_str().unwrap();
    assert!(
        warning.contains("seems to contain the inclination already"),
        "{warning}"
    );
    assert!(warning.contains("--inclination 0 "), "{warning}");
    let tilt = &twice["rail_tilts"][0];
    assert_eq!(tilt["contains_inclination"], true);
    assert!((number(&tilt["tilt_rad"]) - 0.025).abs() < 2e-3, "{tilt}");
    for (options, name) in [
        (&["laid.csv", "--inclination", "0"][..], "laid"),
        (&["upright.csv"], "upright"),
    ] {
        let once = read(options);
        assert_eq!(once["warnings"], serde_json::json!([]), "{name}");
        let conicity = number(&once["conicity_at_3mm"]);
        assert!((0.17..0.19).contains(&conicity), "{name}: {conicity}");
    }
    let text = text_of(&dashpot(
        &["contact", "--no-plots", "--rail", "laid.csv"],
        folder.path(),
    ));
    assert!(
        text.contains("\nwarning: rail laid: the file seems"),
        "{text}"
    );
}

#[test]
fn a_contact_on_the_last_point_of_a_file_is_named() {
    // A wheel that was measured up to 3 mm beyond its tread datum.
    let wheel: String = include_str!("../../../rail/tests/data/s1002.csv")
        .lines()
        .filter(|line| {
            let y = line
                .split_once(',')
                .and_then(|(y, _)| y.trim().parse::<f64>().ok());
            y.is_none_or(|y| y < 3.0)
        })
        .map(|line| format!("{line}\n"))
        .collect();
    let folder = folder_of(&[("short.csv", &wheel)]);
    let report = dashpot(
        &["contact", "--no-plots", "--wheel", "short.csv"],
        folder.path(),
    )
    .success();
    let text = text_of(&report);
    assert!(
        text.contains("warning: right wheel short: at lateral shifts from -12.00 to "),
        "{text}"
    );
    assert!(
        text.contains("the contact reaches the last point of the profile on the field side"),
        "{text}"
    );
}

#[test]
fn files_in_metres_and_unsorted_files_are_named() {
    let rail = include_str!("../../../rail/tests/data/uic60.csv");
    let mut rows: Vec<(f64, f64)> = rail
        .lines()
        .filter_map(|line| line.split_once(','))
        .filter_map(|(y, z)| Some((y.trim().parse().ok()?, z.trim().parse().ok()?)))
        .collect();
    let text = |rows: &[(f64, f64)]| {
        rows.iter()
            .map(|(y, z)| format!("{y} {z}\n"))
            .collect::<String>()
    };
    let metres: Vec<(f64, f64)> = rows.iter().map(|(y, z)| (1e-3 * y, 1e-3 * z)).collect();
    rows.sort_by(|p, q| p.1.total_cmp(&q.1));
    let folder = folder_of(&[
        ("metres.csv", &text(&metres)),
        ("unsorted.csv", &text(&rows)),
    ]);
    for (name, part) in [
        (
            "metres.csv",
            "the lengths seem to be in metres: multiply them by 1000",
        ),
        ("unsorted.csv", "points out of order"),
    ] {
        dashpot(&["contact", "--no-plots", "--rail", name], folder.path())
            .code(1)
            .stdout("")
            .stderr(contains(name).and(contains(part)));
    }
}
