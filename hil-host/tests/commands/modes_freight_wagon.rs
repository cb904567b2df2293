//! The shipped freight wagon: loads, modes with sticking and with sliding friction, and a run against the reference.

use std::f64::consts::TAU;
use std::path::Path;

use serde_json::Value;

use crate::common::{dashpot, json_of, text_of};

/// Body, kg, kg m^2, and half the wheelbase, m.
const BODY_KG: f64 = 37.2e3;
const PITCH_KG_M2: f64 = 640e3;
const YAW_KG_M2: f64 = 646e3;
const TO_AXLE_M: f64 = 4.5;
/// Four springs along x, y and z, without friction and with the springs of stuck friction elements, N/m.
const SLIDING_N_PER_M: [f64; 3] = [4.0 * 1.5e6, 4.0 * 0.3e6, 4.0 * 1e6];
const STICKING_N_PER_M: [f64; 3] = [4.0 * 11.5e6, 4.0 * 5.3e6, 4.0 * 5e6];

fn report(arguments: &[&str]) -> Value {
    let all = ["modes", "--vehicle", "freight-wagon", "--format", "json"];
    json_of(&dashpot(&[&all, arguments].concat(), Path::new(".")).success())
}

fn hz(report: &Value, mode: &str) -> f64 {
    let modes = report["modes"].as_array().unwrap();
    let found = modes.iter().find(|row| row["mode"] == mode);
    let found = found.unwrap_or_else(|| panic!("no {mode} in {modes:?}"));
    found["undamped_hz"].as_f64().unwrap()
}

#[test]
fn the_friction_sticks_or_slides_in_the_modes() {
    for (arguments, state, [x, y, z]) in [
        (&[][..], "sticking", STICKING_N_PER_M),
        (&["--sliding"][..], "sliding", SLIDING_N_PER_M),
    ] {
        let report = report(arguments);
        assert_eq!(report["dry_friction"]["elements"], 12);
        assert_eq!(report["dry_friction"]["linearised_as"], state);
        for load in report["axle_loads_n"].as_array().unwrap() {
            assert!(
                (load.as_f64().unwrap() - 20e3 * 9.81).abs() < 1e-3,
                "{load}"
            );
        }
        for (mode, stiffness, inertia) in [
            ("body bounce", z, BODY_KG),
            ("body pitch", z * TO_AXLE_M * TO_AXLE_M, PITCH_KG_M2),
            ("body yaw", y * TO_AXLE_M * TO_AXLE_M + x, YAW_KG_M2),
        ] {
            let (found, expected) = (hz(&report, mode), (stiffness / inertia).sqrt() / TAU);
            // The load of the springs, 1.1 m below the centre of gravity, changes the pitch.
            assert!(
                (found / expected - 1.0).abs() < 5e-3,
                "{found} for {expected}"
            );
        }
    }
}

/// The undamped modes of the wagon are not unstable by rounding, and the step has no speed of sliding friction.
#[test]
fn sliding_friction_has_a_linear_critical_speed_only() {
    let hunting = report(&["--hunting", "--sliding"])["hunting"].clone();
    let critical = hunting["critical_speed_km_h"].as_f64().unwrap();
    assert!((15.0..30.0).contains(&critical), "{critical}");
    assert_eq!(hunting["nonlinear_critical_speed_km_h"], Value::Null);
}

#[test]
fn the_report_says_what_the_linear_equations_do_with_friction() {
    let text = |arguments: &[&str]| {
        let all = ["modes", "--vehicle"];
        text_of(&dashpot(&[&all, arguments].concat(), Path::new(".")).success())
    };
    let sticking = text(&["freight-wagon"]);
    assert!(sticking.contains("dry friction: 12 elements, which in these linear equations stick"));
    let sliding = text(&["freight-wagon", "--sliding"]);
    assert!(sliding.contains("dry friction: 12 elements, which in these linear equations slide"));
    assert!(!text(&["coach"]).contains("friction"));
}

#[test]
fn a_run_agrees_with_the_reference() {
    let arguments = [
        "vehicle",
        "--vehicle",
        "freight-wagon",
        "--track",
        "straight",
        "--start-m",
        "-10",
        "--speed-km-h",
        "90",
        "--duration-s",
        "4",
        "--check",
        "--format",
        "json",
    ];
    let report = json_of(&dashpot(&arguments, Path::new(".")).success());
    assert_eq!(report["is_within_bounds"], true);
    let deviation = report["deviations"]["acceleration"]["deviation"].as_f64();
    assert!(deviation.unwrap() < 1e-3, "{deviation:?}");
}
