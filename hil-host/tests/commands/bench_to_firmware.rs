//! The four commands of docs/tutorials/recording.md: from a recorded bench test to a damper file, a firmware constant
//! and a page, and the detection of a worn damper in a replay; and the inputs they reject. The recordings are
//! synthetic (hil-host/examples/make_bench.rs), so the right values are known.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use dashpot_core::Damper;
use dashpot_files::damper;
use predicates::str::contains;

use crate::common::{dashpot, error_of, json_of, text_of};

fn data(file: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../data")
        .join(file);
    path.to_str().unwrap().into()
}

const VARIED: [&str; 8] = [
    "--vary",
    "orifice.discharge_coefficient",
    "--vary",
    "mount.stiffness_n_per_m",
    "--vary",
    "mount.clearance_m",
    "--vary",
    "valves.piston_extension.preload_pa",
];

fn calibrate(folder: &Path, more: &[&str]) -> assert_cmd::assert::Assert {
    let bench = data("bench/bench_made.mf4");
    let line = [
        "calibrate",
        "--damper",
        "in-service",
        "--starts",
        "2",
        "--input",
        &bench,
    ];
    dashpot(&[&line[..], &VARIED, more].concat(), folder)
}

#[test]
fn four_commands_lead_from_a_recording_to_firmware_and_find_a_worn_damper() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let channels =
        text_of(&dashpot(&["channels", &data("bench/bench_made.mf4")], folder).success());
    assert!(
        channels.contains("force_n") && channels.contains("500 Hz"),
        "{channels}"
    );

    let files = [
        "--output",
        "found.toml",
        "--page",
        "found.html",
        "--format",
        "json",
    ];
    let report = json_of(&calibrate(folder, &files).success());
    // True values in examples/make_bench.rs; the force is recorded one sample (2 ms) late.
    let truths = [0.68, 7.5e6, 0.6e-3, 7e5, 2e-3];
    let tolerances = [0.01 * 0.68, 0.03 * 7.5e6, 0.05e-3, 0.05 * 7e5, 0.2e-3];
    for ((number, truth), tolerance) in report["numbers"]
        .as_array()
        .unwrap()
        .iter()
        .zip(truths)
        .zip(tolerances)
    {
        let found = number["found"].as_f64().unwrap();
        assert!((found - truth).abs() < tolerance, "{number}");
        assert!(number["least"].as_f64().unwrap() < number["greatest"].as_f64().unwrap());
        assert_eq!(number["by_tests"], true);
    }
    for row in report["loops"].as_array().unwrap() {
        let value = |key: &str| row[key].as_f64().unwrap();
        // The recording has noise of 1 % of the rms of both signals.
        assert!(
            value("missed_after_n") < 0.02 * value("peak_force_n"),
            "{row}"
        );
        assert!(
            value("missed_after_n") < 0.5 * value("missed_before_n"),
            "{row}"
        );
    }
    let text = std::fs::read_to_string(folder.join("found.toml")).unwrap();
    assert!(text.starts_with("# Calibrated by dashpot"), "{text}");
    let found = damper::parse("found", &text, &[]).unwrap();
    assert!((found.mount.clearance_m - 0.6e-3).abs() < 0.05e-3);
    let page = std::fs::read_to_string(folder.join("found.html")).unwrap();
    assert!(page.contains("Calibrated damper") && page.contains("bench_made.mf4 (4 of 4)"));

    let export = [
        "export",
        "--damper",
        "found.toml",
        "--lang",
        "rust",
        "--output",
        "found.rs",
    ];
    dashpot(&export, folder).success();
    assert!(folder.join("found.rs").is_file());

    // The bench test is of a healthy damper, including the pauses between the tests.
    let bench = data("bench/bench_made.mf4");
    let replay = [
        "replay",
        "--damper",
        "found.toml",
        "--input",
        &bench,
        "--output",
        "bench.csv",
        "--health",
        "bench.html",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&replay, folder).success());
    let health = &report["health"];
    assert_eq!(health["alarms"].as_array().unwrap().len(), 0, "{health}");
    let status = health["status"].as_array().unwrap();
    assert!(!status.contains(&"restarted".into()), "{health}");

    let worn = data("bench/worn_made.mf4");
    let replay = [
        "replay",
        "--damper",
        "found.toml",
        "--input",
        &worn,
        "--output",
        "force.csv",
        "--health",
        "health.html",
    ];
    let report =
        json_of(&dashpot(&[&replay[..], &["--format", "json"]].concat(), folder).success());
    let health = &report["health"];
    // From 10 s on, the clearance is 1 mm larger than on the bench; nothing else changes.
    let clearance_m = health["clearance_m"]["value"].as_f64().unwrap();
    assert!((clearance_m - 1.6e-3).abs() < 0.15e-3, "{health}");
    assert!(
        (health["damping_factor"]["value"].as_f64().unwrap() - 1.0).abs() < 0.03,
        "{health}"
    );
    let alarms = health["alarms"].as_array().unwrap();
    assert_eq!(alarms.len(), 1, "{health}");
    assert_eq!(alarms[0]["parameter"], "clearance");
    assert!((10.0..20.0).contains(&alarms[0]["time_s"].as_f64().unwrap()));
    let page = std::fs::read_to_string(folder.join("health.html")).unwrap();
    assert!(page.contains("Alarm: clearance"));

    // Compared with itself, the recording shows no wear.
    std::fs::write(folder.join("healthy.json"), report.to_string()).unwrap();
    let again = ["--health-baseline", "healthy.json", "--format", "json"];
    let report = json_of(&dashpot(&[&replay[..], &again].concat(), folder).success());
    let clearance_alarm_s = report["health"]["alarms"][0]["time_s"].as_f64().unwrap();
    // The healthy half differs from that baseline by the same amount.
    assert!(clearance_alarm_s < 10.0, "{report}");
}

/// With a force in the wrong unit, all samples are left out. Such a reading is not trusted and is no baseline.
#[test]
fn a_force_in_the_wrong_unit_is_no_healthy_damper() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let worn = data("bench/worn_made.mf4");
    let replay = [
        "replay",
        "--damper",
        "in-service",
        "--input",
        &worn,
        "--output",
        "force.csv",
        "--health",
        "health.html",
    ];
    let wrong = [&replay[..], &["--force-unit", "kN"]].concat();
    let text = text_of(&dashpot(&wrong, folder).success());
    assert!(text.contains("no alarm, but do not trust it"), "{text}");
    assert!(
        text.contains("12253 samples were left out and only 0 used"),
        "{text}"
    );
    let report = json_of(&dashpot(&[&wrong[..], &["--format", "json"]].concat(), folder).success());
    assert_eq!(report["health"]["trusted"], false);
    std::fs::write(folder.join("useless.json"), report.to_string()).unwrap();
    let with_baseline = [&replay[..], &["--health-baseline", "useless.json"]].concat();
    let error = error_of(&dashpot(&with_baseline, folder).failure());
    assert!(
        error.contains("useless.json: its reading used 0 samples and left out 12253"),
        "{error}"
    );
    // The force is read only for the health.
    let unread = [
        "replay",
        "--input",
        &worn,
        "--output",
        "force.csv",
        "--force",
        "none",
    ];
    let error = error_of(&dashpot(&unread, folder).failure());
    assert!(
        error.contains("only --health reads the measured force"),
        "{error}"
    );
}

#[test]
fn outputs_are_complete_distinct_and_never_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let to_stdout = ["--vary", "mount.clearance_m", "--output", "-"];
    let bench = data("bench/bench_made.mf4");
    let line = [
        "calibrate",
        "--damper",
        "in-service",
        "--starts",
        "2",
        "--input",
        &bench,
    ];
    let found = dashpot(&[&line[..], &to_stdout].concat(), folder).success();
    let found = String::from_utf8(found.get_output().stdout.clone()).unwrap();
    assert!(damper::parse("found", &found, &[]).is_ok(), "{found}");
    std::fs::write(folder.join("d.toml"), &found).unwrap();
    let worn = data("bench/worn_made.mf4");
    for line in [
        &[
            "calibrate",
            "--input",
            &bench,
            "--vary",
            "mount.clearance_m",
            "--output",
            "same",
            "--page",
            "./same",
        ][..],
        &[
            "replay", "--damper", "d.toml", "--input", &worn, "--output", "same", "--health",
            "./same",
        ],
        &[
            "replay", "--damper", "d.toml", "--input", &worn, "--output", "d.toml",
        ],
        &[
            "replay", "--damper", "d.toml", "--input", &worn, "--output", "f.csv", "--health",
            "d.toml",
        ],
    ] {
        dashpot(line, folder).code(2);
        assert_eq!(std::fs::read_dir(folder).unwrap().count(), 1, "{line:?}");
        assert_eq!(
            std::fs::read_to_string(folder.join("d.toml")).unwrap(),
            found
        );
    }
    let nowhere = [
        "replay",
        "--damper",
        "d.toml",
        "--input",
        &worn,
        "--output",
        "f.csv",
        "--health",
        "none/h.html",
    ];
    dashpot(&nowhere, folder).code(1);
    assert!(!folder.join("f.csv").exists());
}

#[test]
fn undetermined_parameters_are_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let more = [
        "--vary",
        "relief.opening_pressure_pa=1.5e7:3e7",
        "--set",
        "relief.opening_pressure_pa=2e7",
        "--output",
        "x.toml",
        "--page",
        "x.html",
    ];
    let refused = calibrate(folder.path(), &more).code(1);
    let text = error_of(&refused);
    assert!(
        text.contains("relief.opening_pressure_pa: no force of these tests changes"),
        "{text}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn omitted_samples_of_a_recording_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let parameters = damper::load("reduced-vertical", &[]).unwrap();
    let damper: Damper<f64> = parameters.build(1e-3).unwrap();
    let mut state = damper.at_rest(0.0);
    let mut rows = String::from("time_s,displacement_m,force_n\n");
    for tick in 0..3000 {
        let x = 5e-3 * (6.0 * 1e-3 * f64::from(tick)).sin();
        let force = damper.step(&mut state, x);
        // A gap of one second, and 50 samples after it.
        let time_s = 1e-3 * f64::from(tick) + if tick < 2950 { 0.0 } else { 1.0 };
        writeln!(
            rows,
            "{time_s},{x},{}",
            if tick == 500 {
                String::new()
            } else {
                force.to_string()
            }
        )
        .unwrap();
    }
    std::fs::write(folder.path().join("run.csv"), rows).unwrap();
    let line = [
        "calibrate",
        "--damper",
        "reduced-vertical",
        "--input",
        "run.csv",
        "--skip-invalid",
        "--no-skew",
        "--vary",
        "reduced.damping_n_s_per_m",
        "--output",
        "found.toml",
    ];
    let text = text_of(&dashpot(&line, folder.path()).success());
    assert!(
        text.contains(
            "note: run.csv: omitted 1 row with a missing value; 1 segment between gaps, too short for a test"
        ),
        "{text}"
    );
}

#[test]
fn wrong_use_says_what_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("none.csv"), "amplitude_m,frequency_hz\n").unwrap();
    std::fs::write(
        folder.join("wrong.csv"),
        "amplitude_m,frequency_hz,energy_j\n1e-3,1,5\n",
    )
    .unwrap();
    std::fs::write(
        folder.join("short.csv"),
        "time_s,displacement_m,force_n\n0,0,0\n1,1e-3,5\n",
    )
    .unwrap();
    std::fs::write(
        folder.join("wrong_index.csv"),
        "amplitude_m,frequency_hz,max_extension_force_n\n0.01,1,5e3\n# a comment\n0.01,1,-2\n",
    )
    .unwrap();
    std::fs::write(
        folder.join("no_number.csv"),
        "amplitude_m,frequency_hz,energy_per_cycle_j\n0.01,fast,5\n",
    )
    .unwrap();
    let vary = ["--vary", "mount.stiffness_n_per_m", "--output", "x.toml"];
    let cases: [(&[&str], i32, &str); 15] = [
        (
            &["--vary", "mount.clearance_m", "--output", "x.toml"],
            2,
            "give recorded loops with --input",
        ),
        (&["--indices", "none.csv"], 1, "none.csv"),
        (&["--indices", "wrong.csv"], 1, "energy_j"),
        (&["--input", "short.csv"], 1, "100 samples or more"),
        (
            &["--input", "short.csv", "--vary", "mount.stiffnes_n_per_m"],
            2,
            "did you mean `mount.stiffness_n_per_m`",
        ),
        (
            &["--input", "short.csv", "--vary", "geometry.rod_diameter_m"],
            2,
            "measured on the part",
        ),
        (
            &[
                "--input",
                "short.csv",
                "--vary",
                "mount.clearance_m=2e-3:1e-3",
            ],
            2,
            "the smaller first",
        ),
        (
            &[
                "--input",
                "short.csv",
                "--vary",
                "mount.clearance_m=1e-3:2e-3",
            ],
            2,
            "outside the bounds",
        ),
        (
            &["--input", "short.csv", "--vary", "mount.clearance_m=0:2"],
            2,
            "0 to 0.1 m",
        ),
        (
            &["--input", "short.csv", "--prior", "mount.clearance_m=1:1"],
            2,
            "not varied",
        ),
        (
            &[
                "--input",
                "short.csv",
                "--prior",
                "mount.stiffness_n_per_m=6e6",
            ],
            2,
            "KEY=MEAN:DEVIATION",
        ),
        (&["--input", "-", "--damper", "-"], 2, "standard input"),
        (
            &["--input", "short.csv", "--input", "./short.csv"],
            2,
            "given twice",
        ),
        (
            &["--indices", "wrong_index.csv"],
            1,
            "wrong_index.csv:4: max_extension_force_n: -2, allowed: above 0",
        ),
        (
            &["--indices", "no_number.csv"],
            1,
            "no_number.csv:2: column frequency_hz: invalid float literal",
        ),
    ];
    for (more, code, expected) in cases {
        let own_vary: &[&str] = if code == 2 && more.contains(&"x.toml") {
            &[]
        } else {
            &vary
        };
        let line = [&["calibrate"][..], own_vary, more].concat();
        dashpot(&line, folder).code(code).stderr(contains(expected));
    }
    assert!(!folder.join("x.toml").exists());
    let worn = data("bench/worn_made.mf4");
    let ride = data("excitations/ride_made.csv");
    let replay: [(&[&str], &str); 5] = [
        (
            &["--input", "-", "--health", "h.html"],
            "a file, not standard input",
        ),
        (&["--input", &ride, "--health", "h.html"], "force"),
        (
            &[
                "--input",
                &worn,
                "--health",
                "h.html",
                "--health-baseline",
                "none.csv",
            ],
            "the report of a healthy run",
        ),
        (
            &[
                "--input",
                &worn,
                "--health",
                "h.html",
                "--force-noise-n",
                "-1",
            ],
            "1e-3 to 1e6 N",
        ),
        (&["--input", &worn, "--lag-s", "0"], "--health"),
    ];
    for (more, expected) in replay {
        let line = ["replay", "--damper", "in-service", "--output", "f.csv"];
        dashpot(&[&line[..], more].concat(), folder)
            .failure()
            .stderr(contains(expected));
        assert!(
            !folder.join("f.csv").exists() && !folder.join("h.html").exists(),
            "{more:?}"
        );
    }
}
