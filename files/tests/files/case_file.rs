//! Case files: keys, built-in cases, faults, and errors with file, line and name.

use std::fs;

use dashpot_files::case::{CASES, Case, CaseOptions, FaultOptions};
use dashpot_files::contact::ContactParameters;
use dashpot_files::track::{self, IrregularityParameters};
use dashpot_files::{damper, vehicle};
use dashpot_rail::vehicle::RailSupport;

fn case(text: &str) -> Case {
    CaseOptions::parse("case.toml", text)
        .unwrap()
        .case()
        .unwrap()
}

const CASE: &str = "name = \"ride\"
vehicle = \"coach\"
track = \"straight\"
speed_km_h = 90
";

#[test]
fn every_key_is_read() {
    let all = "duration_s = 4
        start_m = -20
        friction = 0.25
        normal_damping_s_per_m = 0.5
        step_us = 500
        push_m = 4e-3
        set = [\"body.mass_kg=35e3\"]
        [rails]
        mass_kg = 60
        lateral_stiffness_n_per_m = 40e6
        lateral_damping_n_s_per_m = 50e3
        vertical_stiffness_n_per_m = 80e6
        vertical_damping_n_s_per_m = 60e3
        [dampers]
        vertical = \"in-service\"\n";
    let found = case(&format!("{CASE}{all}"));
    let replaced = ["vertical=in-service".parse().unwrap()];
    let vehicle = vehicle::load_with("coach", &replaced, &["body.mass_kg=35e3".into()]).unwrap();
    let expected = Case {
        name: "ride".into(),
        contact: ContactParameters::standard(&vehicle),
        vehicle,
        track: track::load("straight").unwrap(),
        speed_m_per_s: 25.0,
        duration_s: 4.0,
        start_m: -20.0,
        friction: 0.25,
        normal_damping_s_per_m: 0.5,
        step_s: 500e-6,
        push_m: 4e-3,
        rails: Some(
            RailSupport::new(60.0)
                .with_lateral(40e6, 50e3)
                .with_vertical(80e6, 60e3),
        ),
        faults: Vec::new(),
        events: Vec::new(),
    };
    assert_eq!(found, expected);
    assert_eq!(found.end_m(), 80.0);
    // Missing keys have the defaults of `CaseOptions::new`.
    let mut options = CaseOptions::new("coach", "straight", 90.0);
    options.name = Some("ride".into());
    assert_eq!(case(CASE), options.case().unwrap());
}

#[test]
fn shipped_cases_start_before_and_end_within_their_irregularities() {
    let expected = [
        ("straight-180", 50.0, 0.4),
        ("curve-r200", 100.0 / 3.6, 0.3),
        ("curve-r300", 70.0 / 3.6, 0.3),
        ("curve-r600", 100.0 / 3.6, 0.3),
    ];
    for ((name, _), (expected_name, speed_m_per_s, friction)) in CASES.into_iter().zip(expected) {
        assert_eq!(name, expected_name);
        let case = Case::load(name).unwrap();
        assert_eq!(case.speed_m_per_s, speed_m_per_s);
        assert_eq!(case.friction, friction);
        assert_eq!(case.step_s, 1e-3);
        let IrregularityParameters::Generated { generation, .. } = &case.track.irregularity else {
            panic!("{name}: not generated");
        };
        let first = case.vehicle.wheelsets.iter().map(|wheelset| wheelset.x_m);
        let first_m = first.fold(f64::MIN, f64::max);
        assert!(case.start_m + first_m < 0.0, "{name}");
        let end_m = case.end_m() + first_m;
        assert!(end_m < generation.length_m - generation.ramp_m, "{name}");
    }
}

#[test]
fn faults_are_sorted_by_time_and_build_on_each_other() {
    let faults = "
        [[fault]]
        time_s = 3
        damper = \"front vertical damper 1\"
        set = [\"mount.stiffness_n_per_m=5e6\"]
        [[fault]]
        time_s = 1
        damper = \"vertical\"
        set = [\"mount.clearance_m=3e-3\"]
        [[fault]]
        time_s = 2
        damper = \"rear lateral damper\"
        damper_file = \"in-service\"
        set = [\"mount.clearance_m=1e-3\"]\n";
    let case = case(&format!("{CASE}{faults}"));
    let found: Vec<(f64, &str)> = case
        .faults
        .iter()
        .map(|fault| (fault.time_s, fault.damper.as_str()))
        .collect();
    let expected = [
        (1.0, "front vertical damper 1"),
        (1.0, "front vertical damper 2"),
        (1.0, "rear vertical damper 1"),
        (1.0, "rear vertical damper 2"),
        (2.0, "rear lateral damper 1"),
        (2.0, "rear lateral damper 2"),
        (3.0, "front vertical damper 1"),
    ];
    assert_eq!(found, expected);
    for fault in &case.faults {
        assert_eq!(case.vehicle.elements[fault.element].name, fault.damper);
    }
    let mounts: Vec<(f64, f64)> = case
        .faults
        .iter()
        .map(|fault| fault.parameters.mount)
        .map(|mount| (mount.clearance_m, mount.stiffness_n_per_m))
        .collect();
    assert_eq!(mounts[0], (3e-3, 6e6));
    assert_eq!(mounts[6], (3e-3, 5e6));
    let in_service = damper::load("in-service", &["mount.clearance_m=1e-3".into()]).unwrap();
    assert_eq!(case.faults[4].parameters, *in_service);
}

#[test]
fn file_names_are_relative_to_the_case_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = include_str!("../../../data/vehicles/locomotive.toml");
    fs::write(at("own.toml"), text).unwrap();
    let text = include_str!("../../../data/tracks/curve-r300.toml");
    fs::write(at("line.toml"), text).unwrap();
    let text = include_str!("../../../data/dampers/paper.toml");
    fs::write(at("worn.toml"), text).unwrap();
    let text = "name = \"own\"
        vehicle = \"own.toml\"
        track = \"line.toml\"
        speed_km_h = 50
        [dampers]
        lateral = \"worn.toml\"
        [[fault]]
        time_s = 1
        damper = \"vertical\"
        damper_file = \"worn.toml\"\n";
    fs::write(at("case.toml"), text).unwrap();
    let case = Case::load(at("case.toml").to_str().unwrap()).unwrap();
    let paper = ["lateral=paper".parse().unwrap()];
    let expected = vehicle::load_with("locomotive", &paper, &[]).unwrap();
    assert_eq!(case.vehicle, expected);
    assert_eq!(case.track.layout, track::load("curve-r300").unwrap().layout);
    assert_eq!(case.faults.len(), 8);
    assert_eq!(
        case.faults[0].parameters,
        *damper::load("paper", &[]).unwrap()
    );
}

#[test]
fn errors_have_file_line_and_name() {
    let with = |lines: &str| format!("{CASE}{lines}\n");
    let fault = |lines: &str| with(&format!("\n[[fault]]\n{lines}"));
    let event = |lines: &str| with(&format!("\n[[event]]\n{lines}"));
    let cases = [
        (with("speed = 3"), "line 5, column 1"),
        (with("speed = 3"), "did you mean `speed_km_h`?"),
        (
            with("friction = 3"),
            "case.toml:5: friction 3, allowed: 0 to 2",
        ),
        (
            with("\nduration_s = 0"),
            "case.toml:6: duration_s 0, allowed: 0.001 to 36000",
        ),
        (
            with("start_m = nan"),
            "case.toml:5: start_m NaN, allowed: -1000000 to",
        ),
        (
            with("step_us = 0.5"),
            "case.toml:5: step_us 0.5, allowed: 20 to 2000",
        ),
        (
            with("normal_damping_s_per_m = -1"),
            "case.toml:5: normal_damping_s_per_m -1, allowed: 0 to 100",
        ),
        (
            with(
                "[rails]\nmass_kg = 0\nlateral_stiffness_n_per_m = 4e7\nlateral_damping_n_s_per_m = 0\n\
                 vertical_stiffness_n_per_m = 8e7\nvertical_damping_n_s_per_m = 0",
            ),
            "case.toml:5: rails: lateral_mass_kg = 0, allowed: 1 to 100000",
        ),
        (
            CASE.replace("90", "900"),
            "case.toml:4: speed_km_h 900, allowed: 3.6 to 540",
        ),
        (
            CASE.replace("coach", "coch"),
            "case.toml:2: vehicle `coch`: no such vehicle or file",
        ),
        (
            CASE.replace("coach", "none.toml"),
            "case.toml:2: none.toml: cannot read",
        ),
        (
            CASE.replace("straight", "strait"),
            "case.toml:3: track `strait`: no such track or file",
        ),
        (
            with("set = [\n  \"body.mass_kg=30e3\",\n  \"bdy.mass_kg=30e3\",\n]"),
            "case.toml:7: override bdy.mass_kg=30e3: no part `bdy`; did you mean `body`?",
        ),
        (
            with("[dampers]\nlateral = \"in-service\"\nverticl = \"paper\""),
            "case.toml:7: dampers verticl=paper: no damper `verticl`; did you mean `vertical`?",
        ),
        (
            with("[dampers]\nlateral = \"none.toml\""),
            "case.toml:6: dampers lateral=none.toml: none.toml: cannot read",
        ),
        (
            fault("time_s = 11\ndamper = \"vertical\"\nset = [\"mount.clearance_m=0\"]"),
            "case.toml:6: fault 1: time_s 11, allowed: 0 to 10",
        ),
        (
            fault(
                "time_s = 1\ndamper = \"front vertical dampr 1\"\nset = [\"mount.clearance_m=0\"]",
            ),
            "case.toml:6: fault 1: no damper `front vertical dampr 1`; did you mean `front vertical damper 1`?",
        ),
        (
            fault("time_s = 1\ndamper = \"vertical\"\nset = [\"mount.clearence_m=0\"]"),
            "did you mean `clearance_m`?",
        ),
        (
            fault("time_s = 1\ndamper = \"vertical\""),
            "case.toml:6: fault 1: no effect without `damper_file` or `set`",
        ),
        (
            event("time_s = 1\nspeed_km_h = 100"),
            "case.toml:6: event 1: ramp_s 0, allowed: at least",
        ),
        (
            event("time_s = 1\nramp_s = 99\nspeed_km_h = 1000"),
            "case.toml:6: event 1: speed_km_h 1000, allowed: 3.6 to 540",
        ),
        (
            event("time_s = -1\nfriction_factor = 1"),
            "case.toml:6: event 1: time_s -1, allowed: 0 to 10",
        ),
        (
            event("time_s = 1\nfriction_factor = nan"),
            "case.toml:6: event 1: friction_factor NaN, allowed: 0 to 5",
        ),
        (
            event("time_s = 1\nfriction_factor = 0.5\nforce_on = \"body\""),
            "case.toml:6: event 1: allowed: one of `speed_km_h`, `friction_factor`, or `force_on` with `force_at_m`",
        ),
        (
            event("time_s = 1\nforce_on = \"roof\"\nforce_at_m = [0, 0, 4]\nforce_n = [1, 0]"),
            "case.toml:6: event 1: force_on `roof`, allowed: body, front bogie, rear bogie",
        ),
        (
            event("time_s = 1\nforce_on = \"body\"\nforce_at_m = [0, 0, 400]\nforce_n = [1, 0]"),
            "case.toml:6: event 1: force_at_m 400, allowed: -50 to 50",
        ),
        (
            event("time_s = 1\nforce_on = \"body\"\nforce_at_m = [0, 0, 4]\nforce_n = [1, 2e6]"),
            "case.toml:6: event 1: force_n 2000000, allowed: -1000000 to 1000000",
        ),
    ];
    for (text, expected) in cases {
        let options = CaseOptions::parse("case.toml", &text);
        let error = options.and_then(|options| options.case()).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("case.toml"), "{message}");
        assert!(message.contains(expected), "{message}\nexpected {expected}");
    }
}

#[test]
fn a_fault_may_be_given_without_a_file() {
    let mut options = CaseOptions::new("locomotive", "ideal", 100.0);
    options.faults.push(FaultOptions {
        time_s: 0.0,
        damper: "rear vertical damper 4".into(),
        replacement: Some("paper".into()),
        overrides: Vec::new(),
    });
    let case = options.case().unwrap();
    assert_eq!(case.faults.len(), 1);
    assert_eq!(
        case.faults[0].parameters,
        *damper::load("paper", &[]).unwrap()
    );
}
