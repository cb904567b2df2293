//! `dashpot vehicle` as a command.

use std::fs;
use std::path::Path;

use dashpot_rail::indices::{RideDirection, sperling, welch};
use tempfile::tempdir;

use crate::common::{dashpot, error_of, files_in, json_of, text_of};

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap()
}

/// Columns of a history by name, as text.
fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines();
    let place = lines
        .next()
        .unwrap()
        .split(',')
        .position(|column| column == name);
    let place = place.unwrap_or_else(|| panic!("no column {name}"));
    lines
        .map(|line| line.split(',').nth(place).unwrap().parse().unwrap())
        .collect()
}

#[test]
fn a_case_writes_histories_indices_and_a_page() {
    let folder = tempdir().unwrap();
    let arguments = [
        "vehicle",
        "--case",
        "curve-r600",
        "--format",
        "json",
        "--output",
        "results",
    ];
    let report = json_of(&dashpot(&arguments, folder.path()).success());
    let results = folder.path().join("results");
    assert_eq!(
        files_in(&results),
        [
            "history.csv",
            "indices.json",
            "report.html",
            "spectra.csv",
            "wear.csv"
        ]
    );
    assert_eq!(report["ending"]["reason"], "completed");
    assert_eq!(report["ticks"], 10_000);
    let saved: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(results.join("indices.json")).unwrap()).unwrap();
    assert_eq!(saved["indices"], report["indices"]);
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let times = column(&history, "time_s");
    assert_eq!((times.len(), times[0], times[9999]), (10_000, 0.001, 10.0));
    let distances = column(&history, "distance_m");
    assert!((distances[9999] - (100.0 / 3.6 * 10.0 - 15.0)).abs() < 1e-6);
    // The indices agree with the history.
    let lateral = column(&history, "body_lateral_acceleration_m_per_s2");
    let rms = (lateral.iter().map(|a| a * a).sum::<f64>() / lateral.len() as f64).sqrt();
    let reported = number(&report["indices"]["bodies"][0]["lateral_rms_m_per_s2"]);
    assert!((rms / reported - 1.0).abs() < 1e-9, "{rms} {reported}");
    let loads = column(&history, "wheelset_1_right_load_n");
    let min_load_n = loads.iter().copied().fold(f64::MAX, f64::min);
    // The history has the loads at the ends of ticks, the index all steps inside them.
    let least_n = number(&report["indices"]["wheelsets"][0]["wheels"][1]["load_least_n"]);
    assert!(
        least_n <= min_load_n && least_n > min_load_n - 5e3,
        "{least_n} {min_load_n}"
    );
    let filtered = column(&history, "wheelset_1_right_filtered_load_n");
    assert_eq!(
        filtered.iter().copied().fold(f64::MIN, f64::max),
        number(&report["indices"]["wheelsets"][0]["wheels"][1]["filtered_load_greatest_n"])
    );
    // Above the front bogie, 5.39 m ahead of the centre, pitch adds to the acceleration; there are two windows of 5 s.
    let vertical = column(&history, "body_vertical_acceleration_m_per_s2");
    let middle = sperling(&vertical, 1000.0, 5.0, RideDirection::Vertical).unwrap();
    let ride = report["indices"]["ride"].as_array().unwrap();
    assert_eq!(
        (ride.len(), &ride[1]["point"]),
        (3, &"floor, over the front bogie".into())
    );
    assert_eq!(ride[0]["windows"], 2);
    let reported = number(&ride[0]["sperling_vertical"]);
    assert!(
        (reported / middle - 1.0).abs() < 1e-9,
        "{reported} {middle}"
    );
    assert!(number(&ride[1]["sperling_vertical"]) > reported);
    // The history has the acceleration of an accelerometer above the front bogie.
    let over = column(
        &history,
        "floor_over_the_front_bogie_vertical_acceleration_m_per_s2",
    );
    let found = sperling(&over, 1000.0, 5.0, RideDirection::Vertical).unwrap();
    assert!((number(&ride[1]["sperling_vertical"]) / found - 1.0).abs() < 1e-9);
    // The spectra agree with the history.
    let spectra = fs::read_to_string(results.join("spectra.csv")).unwrap();
    assert_eq!(column(&spectra, "frequency_hz")[..3], [0.0, 0.5, 1.0]);
    let derailment = column(&history, "wheelset_1_left_derailment");
    for (signal, name) in [
        (
            &over,
            "floor_over_the_front_bogie_vertical_acceleration_m2_per_s4_per_hz",
        ),
        (&derailment, "wheelset_1_left_derailment_per_hz"),
    ] {
        let found = column(&spectra, name);
        let expected = welch(signal, 1000.0, 2.0).unwrap();
        assert_eq!(found.len(), expected.len());
        for (found, [_, expected]) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        }
    }
    // The wear over the profiles agrees with the summary, which says that it is an estimate.
    let wear = &report["wear"];
    assert!(wear["note"].as_str().unwrap().starts_with("Estimate"));
    assert_eq!(wear["law"], "Archard, KTH chart");
    let profiles = fs::read_to_string(results.join("wear.csv")).unwrap();
    let depths = column(&profiles, "depth_um_per_1000km");
    let wheels = wear["wheels"].as_array().unwrap();
    assert_eq!((wheels.len(), depths.len() % 12), (12, 0));
    for (wheel, depths) in wheels.iter().zip(depths.chunks(depths.len() / 12)) {
        let deepest = depths.iter().copied().fold(0.0, f64::max);
        let reported = number(&wheel["max_depth_um_per_1000km"]);
        assert!(reported > 0.0 && (deepest / reported - 1.0).abs() < 1e-9);
    }
    // In the curve, the rails carry weight and centripetal force.
    let sum: f64 = (1..=6)
        .flat_map(|axle| ["left", "right"].map(|side| format!("wheelset_{axle}_{side}_load_n")))
        .map(|name| column(&history, &name)[8000..].iter().sum::<f64>() / 2000.0)
        .sum();
    let speed: f64 = 100.0 / 3.6;
    let expected = 123_960.0 * (9.81 * 0.9968 + speed * speed / 600.0 * 0.08);
    assert!((sum / expected - 1.0).abs() < 1e-3, "{sum} {expected}");
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    for part in [
        "curve of 600 m, 100 km/h",
        "wheelset 6",
        "front lateral damper 2",
        "Spectra",
        "Nadal's limit is 1.34",
        "<svg",
        "aria-label=\"wheelset 1: Q, kN over time, s. Curves: left, right, standstill\"",
        "<a href=\"#track-under-the-vehicle\">Track under the vehicle</a>",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn parts_of_a_case_are_changed_by_options() {
    let folder = tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let all = [
            &[
                "vehicle",
                "--no-page",
                "--duration-s",
                "2",
                "--format",
                "json",
            ],
            arguments,
        ];
        json_of(&dashpot(&all.concat(), folder.path()).success())
    };
    let plain = run(&["--case", "straight-180"]);
    assert_eq!(plain["ticks"], 2000);
    let fewer = run(&[
        "--case",
        "straight-180",
        "--speed-km-h",
        "90",
        "--step-us",
        "500",
    ]);
    assert_eq!(fewer["ticks"], 4000);
    let vertical = |report: &serde_json::Value| {
        number(&report["indices"]["bodies"][0]["vertical_rms_m_per_s2"])
    };
    assert!(vertical(&fewer) < vertical(&plain));
    let soft = run(&["--case", "straight-180", "--damper", "lateral=in-service"]);
    assert_ne!(soft["indices"], plain["indices"]);
    let coach = run(&[
        "--vehicle",
        "coach",
        "--track",
        "ideal",
        "--speed-km-h",
        "120",
    ]);
    assert_eq!(coach["case"], "coach on ideal at 120 km/h");
    let load = number(&coach["indices"]["wheelsets"][3]["wheels"][0]["load_least_n"]);
    assert!((load / 54.5e3 - 1.0).abs() < 0.01, "{load}");
    // On ideal track, everything is at rest except for the initial displacement, which the first row still shows.
    run(&["--track", "ideal", "--speed-km-h", "30", "--push-m", "3e-3"]);
    let rows = fs::read_to_string(folder.path().join("dashpot-vehicle/history.csv")).unwrap();
    for (name, expected_m) in [("wheelset_4", 3e-3), ("front_bogie", 3e-3), ("body", 0.0)] {
        let lateral = column(&rows, &format!("{name}_lateral_m"))[0];
        assert!((lateral - expected_m).abs() < 1e-4, "{name}: {lateral}");
    }
}

#[test]
fn a_fault_changes_a_damper_during_the_run() {
    let folder = tempdir().unwrap();
    let case = |fault: &str| {
        format!(
            "name = \"fault\"\nvehicle = \"locomotive\"\ntrack = \"straight\"\nspeed_km_h = 100\nduration_s = \
             4\nstart_m = -15\n{fault}"
        )
    };
    let lost = "[[fault]]\ntime_s = 3\ndamper = \"front lateral damper 1\"\nset = [\"mount.clearance_m=0.1\"]\n";
    let history = |name: &str, text: &str| {
        fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        let file = format!("{name}.toml");
        dashpot(
            &["vehicle", "--case", &file, "--output", name, "--no-page"],
            folder.path(),
        )
        .success();
        fs::read_to_string(folder.path().join(name).join("history.csv")).unwrap()
    };
    let (whole, faulty) = (history("whole", &case("")), history("faulty", &case(lost)));
    let force = |text: &str| column(text, "front_lateral_damper_1_force_n");
    assert_eq!(force(&whole)[..3000], force(&faulty)[..3000]);
    let peak = |forces: &[f64]| {
        forces
            .iter()
            .fold(0.0_f64, |peak, force| peak.max(force.abs()))
    };
    // The force has no jump; with 0.1 m of clearance it is zero once the damper is back in the middle of its clearance.
    let jump = (force(&faulty)[3000] - force(&faulty)[2999]).abs();
    assert!(jump < 0.2 * peak(&force(&whole)), "{jump}");
    assert!(peak(&force(&whole)[3500..]) > 500.0);
    assert_eq!(peak(&force(&faulty)[3500..]), 0.0);
}

#[test]
fn a_derailed_run_reports_where_keeps_its_rows_and_has_no_indices() {
    let folder = tempdir().unwrap();
    let arguments = [
        "vehicle",
        "--case",
        "curve-r200",
        "--speed-km-h",
        "160",
        "--output",
        "over",
    ];
    let ended = dashpot(&arguments, folder.path()).failure().code(1);
    let error = error_of(&ended);
    assert!(
        error.contains("wheelset") && error.contains("m along the track"),
        "{error}"
    );
    let text = fs::read_to_string(folder.path().join("over/indices.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(report["indices"].is_null());
    assert_ne!(report["ending"]["reason"], "completed");
    let time = number(&report["ending"]["time_s"]);
    let history = fs::read_to_string(folder.path().join("over/history.csv")).unwrap();
    let times = column(&history, "time_s");
    assert!((times.last().unwrap() - time).abs() < 1e-9 && time < 10.0);
    let spectra = fs::read_to_string(folder.path().join("over/spectra.csv")).unwrap();
    assert!(
        spectra.starts_with("frequency_hz,floor_middle_lateral") && spectra.lines().count() == 1
    );
    let page = fs::read_to_string(folder.path().join("over/report.html")).unwrap();
    assert!(page.contains("The run did not complete"));
}

#[test]
fn the_step_is_within_its_bounds_of_the_reference() {
    let arguments = [
        "vehicle",
        "--case",
        "curve-r600",
        "--duration-s",
        "4",
        "--check",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&arguments, Path::new(".")).success());
    assert_eq!(report["is_within_bounds"], true);
    let deviation = |row: &str, what: &str| number(&report[row][what]["deviation"]);
    assert!(deviation("deviations", "load_n") < 700.0 && deviation("deviations", "load_n") > 0.0);
    // Half the step size gives about a quarter of the error.
    let ratio = deviation("deviations", "load_n") / deviation("with_half_the_inner_step", "load_n");
    assert!((2.5..6.0).contains(&ratio), "{ratio}");
}

/// On rigid rails without normal damping, flange impacts make any two solutions diverge; the distributions over seeds
/// still agree.
#[test]
fn a_chaotic_case_is_compared_over_seeds() {
    let arguments = [
        "vehicle",
        "--case",
        "straight-180",
        "--vehicle",
        "locomotive-without-yaw-dampers",
        "--set",
        "rails=rigid",
        "--normal-damping-s-per-m",
        "0",
        "--duration-s",
        "2.2",
        "--check",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&arguments, Path::new(".")).success());
    assert_eq!(report["is_within_bounds"], false);
    assert!(number(&report["parting"]["extreme"]["deviation"]) > 0.01);
    assert_eq!(report["over_seeds"]["seeds"], 16);
    assert!(number(&report["over_seeds"]["mean"]["greatest"]) < 4.0);
    assert!(number(&report["over_seeds"]["distribution"]["greatest"]) <= 0.75);
}

#[test]
fn wrong_options_are_reported_with_the_allowed_values() {
    let folder = tempdir().unwrap();
    for (arguments, code, words) in [
        (
            &["--speed-km-h", "100"][..],
            2,
            &["--case", "straight-180"][..],
        ),
        (&["--case", "straight-181"], 2, &["straight-180"]),
        (
            &["--case", "straight-180", "--speed-km-h", "-3"],
            2,
            &["--speed-km-h", "3.6 to 540"],
        ),
        (
            &["--case", "straight-180", "--step-us", "9000"],
            2,
            &["--step-us", "2000"],
        ),
        (
            &["--case", "straight-180", "--damper", "latral=paper"],
            2,
            &["lateral"],
        ),
        (
            &["--case", "straight-180", "--push-m", "0.1"],
            2,
            &["--push-m 0.1", "-0.02 to 0.02"],
        ),
        (
            &["--case", "straight-180", "--push-m", "1e-3", "--check"],
            2,
            &["--check", "push"],
        ),
        (
            &["--track", "nowhere", "--speed-km-h", "100"],
            2,
            &["nowhere", "ideal"],
        ),
        (
            &["--case", "straight-180", "--fifo", "3"],
            2,
            &["--realtime"],
        ),
        (
            &["--case", "straight-180", "--output", "/dev/null/x"],
            1,
            &["/dev/null/x"],
        ),
    ] {
        let ended = dashpot(&[&["vehicle"], arguments].concat(), folder.path())
            .failure()
            .code(code);
        let error = error_of(&ended);
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {error}");
        }
        assert_eq!(text_of(&ended), "");
    }
    assert!(files_in(folder.path()).is_empty());
}

/// The first interruption ends the run with the results so far; the rows are complete.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_run_keeps_what_was_computed() {
    use std::process::{Command, Stdio};

    use crate::common::command;

    let folder = tempdir().unwrap();
    let arguments = [
        "vehicle",
        "--track",
        "ideal",
        "--speed-km-h",
        "36",
        "--duration-s",
        "36000",
    ];
    let mut child = command(&arguments, folder.path())
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let results = folder.path().join("dashpot-vehicle");
    let has_rows = || {
        let entries = fs::read_dir(&results).into_iter().flatten().flatten();
        entries
            .into_iter()
            .any(|entry| entry.metadata().is_ok_and(|data| data.len() > 100_000))
    };
    while !has_rows() {
        assert_eq!(child.try_wait().unwrap(), None, "ended by itself");
        std::thread::yield_now();
    }
    let status = Command::new("kill")
        .args(["-TERM", &child.id().to_string()])
        .status();
    assert!(status.unwrap().success());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    let error = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(error.contains("interrupted at"), "{error}");
    assert_eq!(
        files_in(&results),
        [
            "history.csv",
            "indices.json",
            "report.html",
            "spectra.csv",
            "wear.csv"
        ]
    );
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let fields = |line: &str| line.split(',').count();
    let mut lines = history.lines();
    let columns = fields(lines.next().unwrap());
    assert!(lines.all(|line| fields(line) == columns) && history.ends_with('\n'));
}
