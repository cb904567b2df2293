//! `dashpot modes` as a command, and the modes of the locomotive against an independent computation.

use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_files::vehicle;
use dashpot_rail::vehicle::{Mode, Standstill};

use crate::common::{dashpot, json_of, text_of};

fn modes(arguments: &[&str]) -> Assert {
    dashpot(&[&["modes"], arguments].concat(), Path::new("."))
}

/// The shipped locomotive with dashpots instead of its dampers: 120 kN s/m vertical and 90 kN s/m lateral per side and
/// bogie, at the middle of the bogie.
fn with_dashpots() -> Vec<Mode> {
    let file = include_str!("../../../data/vehicles/locomotive-without-yaw-dampers.toml");
    let (parts, _dampers) = file.split_once("# Four vertical and two lateral").unwrap();
    let mut parts = parts.to_owned();
    for (place, x) in [("front", 5.39), ("rear", -5.39)] {
        parts += &format!(
            "[[spring_damper]]
            name = \"{place} dashpot\"
            between = [\"{place} bogie\", \"body\"]
            stiffness_n_per_m = [0, 0, 0]
            damping_n_s_per_m = [0, 90e3, 120e3]
            at_m = [[{x}, -1.323, 0.684], [{x}, 1.323, 0.684]]\n"
        );
    }
    let vehicle = vehicle::parse("dashpots", &parts, &[]).unwrap();
    Standstill::new(&vehicle).unwrap().modes().unwrap()
}

/// Checks frequency and damping ratio of the first mode whose name contains these words, within a relative error of
/// `part`.
fn check(modes: &[Mode], words: &str, expected: [f64; 2], part: f64) {
    let names: Vec<String> = modes.iter().map(Mode::description).collect();
    let number = names.iter().position(|name| name.contains(words));
    let mode = &modes[number.unwrap_or_else(|| panic!("no {words} in {names:?}"))];
    for (found, expected) in [mode.undamped_hz(), mode.damping_ratio()]
        .into_iter()
        .zip(expected)
    {
        assert!(
            (found / expected - 1.0).abs() < part,
            "{words}: {found} for {expected}"
        );
    }
}

/// Independent computation of the same locomotive at standstill.
#[test]
fn the_locomotives_modes_are_those_of_an_independent_computation() {
    let modes = with_dashpots();
    check(&modes, "body bounce", [1.428, 0.290], 0.01);
    check(&modes, "body yaw", [0.870, 0.545], 0.01);
    check(&modes, "body pitch", [1.572, 0.316], 0.01);
    check(&modes, "body lower sway", [0.499, 0.292], 0.01);
    check(&modes, "body upper sway", [1.477, 0.756], 0.01);
    check(&modes, "bogie pitch", [3.706, 0.433], 0.01);
    let bogies = "front bogie and rear bogie";
    let lateral: Vec<&Mode> = modes
        .iter()
        .filter(|mode| mode.description().contains("lateral"))
        .collect();
    let frequencies: Vec<f64> = lateral.iter().map(|mode| mode.undamped_hz()).collect();
    assert!(
        (frequencies[0] / 6.27 - 1.0).abs() < 0.01,
        "{frequencies:?}"
    );
    assert!(
        (frequencies[1] / 6.34 - 1.0).abs() < 0.01,
        "{frequencies:?}"
    );
    let bounce = modes
        .iter()
        .find(|mode| mode.description().contains("bounce") && mode.description().contains("bogie"))
        .unwrap_or_else(|| panic!("no bounce of {bogies}"));
    assert!((bounce.undamped_hz() / 4.456 - 1.0).abs() < 0.01);
}

/// The same computation with each damper as C and Ke in series.
#[test]
fn dampers_stiffen_the_suspension_as_in_an_independent_computation() {
    let vehicle = vehicle::load("locomotive-without-yaw-dampers", &[]).unwrap();
    let modes = Standstill::new(&vehicle).unwrap().modes().unwrap();
    check(&modes, "body bounce", [1.789, 0.452], 0.01);
    check(&modes, "body pitch", [2.075, 0.459], 0.01);
    check(&modes, "body yaw", [0.914, 0.587], 0.01);
    check(&modes, "body lower sway", [0.529, 0.445], 0.01);
    check(
        &modes,
        "front bogie and rear bogie pitch",
        [4.00, 0.59],
        0.01,
    );
    let bounce = modes
        .iter()
        .find(|mode| mode.description().contains("bogie and body bounce"));
    let bounce = bounce.unwrap();
    assert!((bounce.undamped_hz() / 9.25 - 1.0).abs() < 0.01);
    assert!((bounce.damping_ratio() / 0.60 - 1.0).abs() < 0.01);
}

#[test]
fn the_axles_carry_the_published_load() {
    // 20 660 kg per axle.
    let report = json_of(&modes(&["--format", "json"]).success());
    let loads = report["axle_loads_n"].as_array().unwrap();
    assert_eq!(loads.len(), 6);
    for load in loads {
        assert!((load.as_f64().unwrap() / (20_660.0 * 9.81) - 1.0).abs() < 1e-4);
    }
    assert_eq!(report["modes"].as_array().unwrap().len(), 15);
}

#[test]
fn a_heavier_body_bounces_slower() {
    let bounce = |arguments: &[&str]| {
        let report = json_of(&modes(&[arguments, &["--format", "json"]].concat()).success());
        let rows = report["modes"].as_array().unwrap().clone();
        let row = rows
            .iter()
            .find(|row| row["mode"] == "body bounce")
            .unwrap();
        row["undamped_hz"].as_f64().unwrap()
    };
    assert!(bounce(&["--set", "body.mass_kg=80e3"]) < 0.95 * bounce(&[]));
    let text = text_of(&modes(&[]).success());
    assert!(text.contains("body bounce"), "{text}");
}

/// The locomotive without yaw dampers, whose critical speeds are below 230 km/h.
const BARE: [&str; 2] = ["--vehicle", "locomotive-without-yaw-dampers"];

/// Minimum damping ratio of all modes at a speed.
fn least_damping(speed_km_h: f64) -> f64 {
    let speed = format!("{speed_km_h}");
    let arguments = [&BARE[..], &["--speed-km-h", &speed, "--format", "json"]].concat();
    let report = json_of(&modes(&arguments).success());
    let rows = report["modes"].as_array().unwrap();
    let ratios = rows
        .iter()
        .map(|row| row["damping_ratio"].as_f64().unwrap());
    ratios.fold(f64::MAX, f64::min)
}

#[test]
fn hunting_begins_at_the_critical_speed() {
    let arguments = [&BARE[..], &["--hunting", "--format", "json"]].concat();
    let report = json_of(&modes(&arguments).success());
    let critical = report["hunting"]["critical_speed_km_h"].as_f64().unwrap();
    // A displacement up to the flange leads to a limit cycle above a speed that is at most slightly higher than the
    // linear critical speed.
    let nonlinear = report["hunting"]["nonlinear_critical_speed_km_h"]
        .as_f64()
        .unwrap();
    assert!(
        (150.0..=1.02 * critical).contains(&nonlinear),
        "{nonlinear}"
    );
    let amplitude = report["hunting"]["limit_cycle_m"].as_f64().unwrap();
    assert!((0.5e-3..8e-3).contains(&amplitude), "{amplitude}");
    assert!(least_damping(critical - 1.0) > 0.0);
    assert!(least_damping(critical + 1.0) < 0.0);
    assert!(least_damping(50.0) > 0.01);
    // Axleboxes with soft guidance let the wheelsets hunt at a lower speed.
    let soft = [
        "front",
        "front middle",
        "front inner",
        "rear inner",
        "rear middle",
        "rear",
    ]
    .map(|place| format!("{place} primary.stiffness_n_per_m=[2e6, 2e6, 2.15e6]"));
    let mut arguments = [&BARE[..], &["--hunting", "--format", "json"]].concat();
    for assignment in &soft {
        arguments.extend(["--set", assignment]);
    }
    let report = json_of(&modes(&arguments).success());
    let softer = report["hunting"]["critical_speed_km_h"].as_f64().unwrap();
    assert!(softer < critical - 20.0, "{softer} for {critical}");
}

/// At low speed, the wheelsets hold the bogies as at standstill, so the body moves as at standstill.
#[test]
fn at_walking_pace_the_body_moves_as_at_standstill() {
    let frequency_hz = |arguments: &[&str], words: &str| {
        let report = json_of(&modes(&[arguments, &["--format", "json"]].concat()).success());
        let rows = report["modes"].as_array().unwrap().clone();
        let row = rows.iter().find(|row| row["mode"] == words).unwrap();
        row["undamped_hz"].as_f64().unwrap()
    };
    for words in ["body bounce", "body pitch", "body lower sway", "body yaw"] {
        let (slow, still) = (
            frequency_hz(&["--speed-km-h", "5"], words),
            frequency_hz(&[], words),
        );
        assert!((slow / still - 1.0).abs() < 0.01, "{words}: {slow} {still}");
    }
}

#[test]
fn errors_name_the_problem_its_location_and_the_allowed_values() {
    let cases: [(&[&str], i32, &str); 8] = [
        (
            &["--vehicle", "locomotiv"],
            2,
            "vehicle `locomotiv`: no such vehicle or file; give a TOML file or a vehicle: locomotive, coach, \
             locomotive-without-yaw-dampers, freight-wagon; did you \
             mean `locomotive`?",
        ),
        (
            &["--set", "bodi.mass_kg=3"],
            2,
            "--set bodi.mass_kg=3: no part `bodi`; did you mean `body`?",
        ),
        (
            &["--set", "body.mass=3"],
            2,
            "locomotive: after --set: unknown field `mass`",
        ),
        (
            &["--set", "mass_kg=3"],
            2,
            "--set mass_kg=3: it does not name one part and one key; expected part.key=value",
        ),
        (
            &["--speed-km-h", "0"],
            2,
            "--speed-km-h: 0, allowed: 1 to 700 km/h; omit it for standstill",
        ),
        (
            &["--speed-km-h", "80", "--friction", "3"],
            2,
            "--friction: 3, allowed: 0 to 2",
        ),
        (
            &["--set", "body.mass_kg=-3"],
            1,
            "locomotive:11: body: mass_kg = -3, allowed: 1 to 1000000",
        ),
        (
            &["--set", "front lateral damper.damper='none'"],
            1,
            "locomotive:120: front lateral damper: damper `none`: no such preset or file",
        ),
    ];
    for (arguments, code, expected) in cases {
        let output = modes(arguments).code(code).get_output().clone();
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(expected), "{message}\nexpected {expected}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn a_file_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wagon.toml");
    std::fs::write(
        &path,
        "name = \"wagon\"\n\n[[body]]\nname = \"body\"\nmas_kg = 3\n",
    )
    .unwrap();
    let output = dashpot(&["modes", "--vehicle", "wagon.toml"], folder.path());
    let output = output.code(1).get_output().clone();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("line 5, column 1"), "{message}");
    assert!(message.contains("did you mean `mass_kg`?"), "{message}");
}
