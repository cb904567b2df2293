//! `dashpot vehicle --outside`: dampers on a simulated target, or recorded forces.

use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_core::Damper;
use dashpot_core::link::Response;
use dashpot_files::case::Case;
use dashpot_host_link::Link;
use dashpot_rail::vehicle::Law;
use predicates::str::contains;
use serde_json::Value;

use crate::common::{dashpot, error_of, json_of};
use crate::pil_common::{altered, desk, serve_tcp};

const LATERAL: &str = "front lateral damper 1";
const VERTICAL: &str = "front vertical damper 2";

/// Runs the locomotive briefly on straight track, with `options`.
fn vehicle(options: &[&str], folder: &Path) -> Assert {
    let case = ["vehicle", "--case", "straight-180", "--duration-s", "0.6"];
    let output = ["--output", ".", "--format", "json"];
    dashpot(&[&case[..], &output, options].concat(), folder)
}

fn outside(damper: &str, source: &str) -> String {
    format!("{damper}={source}")
}

/// A column of the history.
fn column(name: &str, folder: &Path) -> Vec<f64> {
    let mut rows = csv::Reader::from_path(folder.join("history.csv")).unwrap();
    let names = rows.headers().unwrap().clone();
    let number = names.iter().position(|other| other == name);
    let number = number.unwrap_or_else(|| panic!("{name} in {names:?}"));
    rows.records()
        .map(|row| row.unwrap()[number].parse().unwrap())
        .collect()
}

/// Displacements and forces of a damper.
fn history(damper: &str, folder: &Path) -> [Vec<f64>; 2] {
    ["displacement_m", "force_n"]
        .map(|what| column(&format!("{}_{what}", damper.replace(' ', "_")), folder))
}

/// The damper with this name, in single precision.
fn built(name: &str, step_s: f64) -> Damper<f32> {
    let case = Case::load("straight-180").unwrap();
    let element = case.vehicle.elements.iter().find(|e| e.name == name);
    let Law::Damper { parameters, .. } = &element.unwrap().law else {
        panic!("{name} is a damper")
    };
    parameters.build(step_s).unwrap()
}

/// Returns the forces of a damper that starts at rest and takes `steps` steps to each displacement, in a straight line
/// from the previous one.
fn forces(damper: &Damper<f32>, displacements_m: &[f64], steps: u32) -> Vec<f64> {
    let mut state = damper.at_rest(0.0);
    let mut from_m = 0.0;
    let mut forces = Vec::new();
    for to_m in displacements_m {
        for step in 1..steps {
            let share = f64::from(step) / f64::from(steps);
            let on_the_way_m: f64 = from_m + share * (to_m - from_m);
            damper.step(&mut state, on_the_way_m as f32);
        }
        forces.push(f64::from(damper.step(&mut state, *to_m as f32)));
        from_m = *to_m;
    }
    forces
}

#[test]
fn a_damper_on_a_target_answers_one_tick_late() {
    let folder = tempfile::tempdir().unwrap();
    let both = [outside(LATERAL, "desk"), outside(VERTICAL, "desk")];
    let options = ["--outside", &both[0], "--outside", &both[1]];
    let report = json_of(&vehicle(&options, folder.path()).success());
    for damper in [LATERAL, VERTICAL] {
        let [displacements_m, found_n] = history(damper, folder.path());
        let expected_n = forces(&built(damper, 1e-3), &displacements_m, 1);
        assert_eq!(found_n.len(), 600);
        assert_eq!(found_n[0], 0.0, "{damper}");
        assert_eq!(found_n[1..], expected_n[..599], "{damper}");
        assert!(found_n.iter().any(|force_n| force_n.abs() > 500.0));
    }
    let found = &report["outside"];
    assert_eq!(found["exchange_step_s"], 1e-3);
    assert_eq!(found["delay_s"], 1e-3);
    assert_eq!(found["dampers"][1]["damper"], VERTICAL);
    // Both dampers are in one bank behind one link.
    assert_eq!(found["targets"].as_array().unwrap().len(), 1);
    let target = &found["targets"][0];
    assert_eq!(
        [
            &target["ticks"],
            &target["mismatches"],
            &target["steps_a_tick"]
        ],
        [600, 0, 1]
    );
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("External dampers") && page.contains("force delayed by 1000 us"));
}

#[test]
fn the_effect_is_the_difference_from_the_run_with_the_damper_inside() {
    let (with, without) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let option = outside(LATERAL, "desk");
    let report = json_of(&vehicle(&["--outside", &option, "--no-page"], with.path()).success());
    vehicle(&["--no-page"], without.path()).success();
    let effect = &report["outside"]["effect"];
    let rms =
        |values: &[f64]| (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt();
    let is_near =
        |reported: &Value, number: f64| (reported.as_f64().unwrap() / number - 1.0).abs() < 1e-9;
    let difference = |name: &str| -> Vec<f64> {
        let [with, without] = [&with, &without].map(|folder| column(name, folder.path()));
        with.iter().zip(without).map(|(a, b)| a - b).collect()
    };
    let [_, inside_n] = history(LATERAL, without.path());
    let force = &effect["dampers"][0];
    assert!(is_near(&force["force_rms_n"], rms(&inside_n)));
    let name = format!("{}_force_n", LATERAL.replace(' ', "_"));
    let late_n = rms(&difference(&name));
    assert!(is_near(&force["difference_rms_n"], late_n));
    assert!(late_n > 1e-3 * rms(&inside_n) && late_n < 0.1 * rms(&inside_n));
    let lateral = &effect["deviations"]["lateral_m"];
    let wheelset = lateral["of"].as_str().unwrap().replace(' ', "_");
    let moved_m = rms(&difference(&format!("{wheelset}_lateral_m")));
    assert!(is_near(&lateral["deviation"], moved_m));
    assert_eq!(effect["duration_s"], 0.6);
}

#[test]
fn the_effect_of_the_delay_is_as_long_as_the_delay() {
    let option = outside(LATERAL, "desk");
    let [whole, half] = ["1000", "500"].map(|step_us| {
        let folder = tempfile::tempdir().unwrap();
        let options = ["--outside", &option, "--no-page", "--step-us", step_us];
        let report = json_of(&vehicle(&options, folder.path()).success());
        let effect = &report["outside"]["effect"];
        [
            &effect["dampers"][0]["difference_rms_n"],
            &effect["deviations"]["acceleration"]["deviation"],
        ]
        .map(|value| value.as_f64().unwrap())
    });
    for (whole, half) in whole.into_iter().zip(half) {
        assert!((0.45..0.55).contains(&(half / whole)), "{half} of {whole}");
    }
}

#[test]
fn a_target_that_steps_more_often_is_led_along_a_straight_line() {
    let folder = tempfile::tempdir().unwrap();
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let option = outside(LATERAL, &link);
    let wait = ["--timeout-ms", "60000", "--no-page", "--step-us", "2000"];
    let options = [&["--outside", &option], &wait[..]].concat();
    let report = json_of(&vehicle(&options, folder.path()).success());
    assert_eq!(report["outside"]["targets"][0]["steps_a_tick"], 2);
    assert_eq!(report["outside"]["delay_s"], 2e-3);
    let [displacements_m, found_n] = history(LATERAL, folder.path());
    let expected_n = forces(&built(LATERAL, 1e-3), &displacements_m, 2);
    assert_eq!(found_n[1..], expected_n[..299]);
}

#[test]
fn a_target_whose_step_does_not_divide_the_cases_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let option = outside(LATERAL, &link);
    let options = ["--outside", &option, "--timeout-ms", "60000", "--step-us"];
    for step_us in ["500", "1500"] {
        vehicle(&[&options[..], &[step_us]].concat(), folder.path())
            .code(2)
            .stderr(contains(format!(
                "the step of the target is 1000 us, that of the case {step_us} us; allowed: --step-us 1000 or a whole \
                 multiple"
            )));
    }
}

#[test]
fn more_dampers_than_slots_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let link = format!("tcp:{}", serve_tcp(|| Box::new(desk())));
    let four = [1, 2, 3, 4].map(|number| format!("front vertical damper {number}={link}"));
    let mut options = vec!["--timeout-ms", "60000"];
    for option in &four {
        options.extend(["--outside", option.as_str()]);
    }
    vehicle(&options, folder.path()).code(2).stderr(contains(
        "4 dampers, but the target has 3 slots; allowed: 1 to 3",
    ));
}

/// Result of a run whose target changes its answers from tick 250 on.
fn lost(change: impl Fn(&mut Response<'_>) + Send + 'static, folder: &Path) -> (String, Value) {
    let target = move || -> Box<dyn Link> {
        Box::new(altered(move |header, mut response, frame| {
            if let Response::Forces(forces) = &response
                && forces.tick == 250
            {
                change(&mut response);
            }
            frame.write(&(header, response))
        }))
    };
    let option = outside(LATERAL, &format!("tcp:{}", serve_tcp(target)));
    let options = ["--outside", &option, "--timeout-ms", "60000", "--no-page"];
    let ended = vehicle(&options, folder).code(1);
    let indices = std::fs::read_to_string(folder.join("indices.json")).unwrap();
    (error_of(&ended), serde_json::from_str(&indices).unwrap())
}

#[test]
fn a_lost_target_ends_the_run_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let (error, report) = lost(|response| *response = Response::Done, folder.path());
    assert!(
        error.contains("an external damper was lost at 0.250 s, -2.5 m along the track: tcp:")
            && error.contains("after tick 249: the target answers in another protocol"),
        "{error}"
    );
    assert_eq!(report["ending"]["reason"], "outside_lost");
    assert_eq!(report["ending"]["time_s"], 0.25);
    assert_eq!(report["ticks"], 250);
    assert_eq!(report["outside"]["effect"]["duration_s"], 0.25);
    // Results computed so far are kept.
    assert_eq!(column("time_s", folder.path()).last(), Some(&0.25));
}

#[test]
fn a_nan_force_ends_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let (error, _) = lost(
        |response| {
            if let Response::Forces(forces) = response {
                forces.forces_n[0] = f32::NAN;
            }
        },
        folder.path(),
    );
    assert!(
        error.contains("at tick 250: the target returned the force NaN N"),
        "{error}"
    );
}

/// Force of the lateral damper in the history of `folder`, as a recording.
fn record(folder: &Path) -> String {
    let times_s = column("time_s", folder);
    let [_, forces_n] = history(LATERAL, folder);
    let rows = times_s.iter().zip(forces_n);
    let rows = rows.map(|(time_s, force_n)| format!("{time_s},{force_n}\n"));
    "time_s,force_n\n".to_owned() + &rows.collect::<String>()
}

#[test]
fn the_recorded_force_of_a_run_replays_it() {
    let (first, again) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    vehicle(&["--no-page"], first.path()).success();
    std::fs::write(again.path().join("force.csv"), record(first.path())).unwrap();
    let option = outside(LATERAL, "force.csv");
    let report = json_of(&vehicle(&["--outside", &option], again.path()).success());
    for (name, tolerance) in [
        ("front_lateral_damper_1_force_n", 1e-6),
        ("body_lateral_m", 1e-12),
        ("wheelset_1_left_load_n", 1e-4),
    ] {
        let [expected, found] = [&first, &again].map(|folder| column(name, folder.path()));
        let worst = expected.iter().zip(&found).map(|(a, b)| (a - b).abs());
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < tolerance, "{name}: {worst}");
    }
    let found = &report["outside"];
    assert_eq!(found["dampers"][0]["is_recorded"], true);
    assert_eq!(found["effect"], Value::Null);
    let page = std::fs::read_to_string(again.path().join("report.html")).unwrap();
    assert!(page.contains("recorded force from force.csv"));
}

#[test]
fn between_its_samples_a_recorded_force_is_a_straight_line() {
    let folder = tempfile::tempdir().unwrap();
    let text = "force_n,time_s\n0,-1\n1000,0.25\n-600,1.05\n";
    std::fs::write(folder.path().join("force.csv"), text).unwrap();
    let option = outside(LATERAL, "force.csv");
    vehicle(&["--outside", &option, "--no-page"], folder.path()).success();
    let [_, forces_n] = history(LATERAL, folder.path());
    for (tick, force_n) in (1..).zip(forces_n) {
        let time_s = f64::from(tick) * 1e-3;
        let expected_n = if time_s <= 0.25 {
            800.0 * (time_s + 1.0)
        } else {
            1000.0 - 2000.0 * (time_s - 0.25)
        };
        assert!((force_n - expected_n).abs() < 1e-6, "{time_s}: {force_n}");
    }
}

#[test]
fn too_short_a_recording_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let rows = [
        (
            "0.002,0\n0.7,0\n",
            "the recording covers 0.002 s to 0.7 s, but the run needs a force from 0.001 s to 0.6 s",
        ),
        ("0,0\n0.599,0\n", "the recording covers 0 s to 0.599 s"),
    ];
    let option = outside(LATERAL, "force.csv");
    for (rows, message) in rows {
        std::fs::write(
            folder.path().join("force.csv"),
            format!("time_s,force_n\n{rows}"),
        )
        .unwrap();
        vehicle(&["--outside", &option], folder.path())
            .code(1)
            .stderr(contains(message));
    }
}

#[test]
fn a_wrong_recording_is_reported_with_its_columns() {
    let folder = tempfile::tempdir().unwrap();
    let texts = [
        (
            "time_s,displacement_m\n0,0\n1,0\n",
            "column force_n is missing",
        ),
        ("", "or `time_s,force_n` and at least one row"),
        (
            "time_s,force_n\n0,0\n1,x\n",
            "force.csv:3: column force_n: `x` is not a finite number",
        ),
        ("time_s,force_n\n1,0\n0,0\n", "time 0 s does not increase"),
    ];
    let option = outside(LATERAL, "force.csv");
    for (text, message) in texts {
        std::fs::write(folder.path().join("force.csv"), text).unwrap();
        vehicle(&["--outside", &option], folder.path())
            .code(1)
            .stderr(contains(message));
    }
    let missing = outside(LATERAL, "no.csv");
    vehicle(&["--outside", &missing], folder.path())
        .code(1)
        .stderr(contains("no.csv: cannot read"));
}

#[test]
fn wrong_use_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two] = [outside(LATERAL, "desk"), outside(LATERAL, "force.csv")];
    let uses: [(&[&str], &str); 7] = [
        (
            &["--outside", "front laterl damper 1=desk"],
            "no damper `front laterl damper 1`; did you mean `front lateral damper 1`?",
        ),
        (
            &["--outside", &one, "--outside", &two],
            "the damper is given twice; allowed: once",
        ),
        (
            &["--outside", LATERAL],
            "allowed: DAMPER=LINK or DAMPER=FILE",
        ),
        (
            &["--outside", "front lateral damper 1=tcp:here"],
            "allowed: tcp:HOST:PORT, serial:DEVICE, qemu, qemu:IMAGE, desk, a file",
        ),
        (&["--outside", &one, "--check"], "cannot be used with"),
        (
            &["--baud", "9600"],
            "--timeout-ms, --tries and --baud require --outside",
        ),
        (
            &["--case", "fault.toml", "--outside", &one],
            "the case changes this damper at 0.1 s; allowed: dampers without faults",
        ),
    ];
    let fault = "name = \"f\"\nvehicle = \"locomotive\"\ntrack = \"straight\"\nspeed_km_h = 100\n\
                 [[fault]]\ntime_s = 0.1\ndamper = \"lateral\"\nset = [\"mount.clearance_m=3e-3\"]\n";
    std::fs::write(folder.path().join("fault.toml"), fault).unwrap();
    for (options, message) in uses {
        let case = if options[0] == "--case" {
            ""
        } else {
            "--case=straight-180"
        };
        let all = [&["vehicle"], options, &[case]].concat();
        let all: Vec<&str> = all.into_iter().filter(|word| !word.is_empty()).collect();
        let ended = dashpot(&all, folder.path()).code(2);
        let error = error_of(&ended);
        assert!(error.contains(message), "{all:?}: {error}");
    }
}

#[test]
fn a_paced_run_exchanges_within_its_ticks() {
    let folder = tempfile::tempdir().unwrap();
    let option = outside(LATERAL, "desk");
    let options = ["--outside", &option, "--realtime", "--no-page"];
    let ended = vehicle(&options, folder.path());
    let report = json_of(&ended);
    let realtime = &report["realtime"];
    assert_eq!(realtime["ticks"], 600);
    assert_eq!(realtime["allowed_missed_deadlines"], 0);
    // The number of misses depends on the load of the machine; the exit code follows from it.
    let missed = realtime["missed_deadlines"].as_u64().unwrap();
    ended.code(i32::from(missed > 0));
    assert_eq!(report["outside"]["targets"][0]["round_trip"]["count"], 600);
    // The work of a tick includes the exchange.
    let figure = |value: &Value| value["mean_ns"].as_f64().unwrap();
    let trip_ns = figure(&report["outside"]["targets"][0]["round_trip"]);
    assert!(figure(&report["realtime"]["work"]) > trip_ns);
}
