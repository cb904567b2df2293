//! The shipped coach: loads and modes against closed forms of its parameters.

use std::f64::consts::TAU;
use std::path::Path;

use dashpot_files::vehicle;
use dashpot_rail::vehicle::{Mode, Standstill};

use crate::common::{dashpot, json_of};

/// Half of the body on two airsprings, on a bogie on four axlebox springs.
const BODY_KG: f64 = 16e3;
const BOGIE_KG: f64 = 2615.0;
const AIRSPRINGS_N_PER_M: f64 = 2.0 * 430e3;
const AXLEBOXES_N_PER_M: f64 = 4.0 * 1.22e6;
/// Distance from the middle of the vehicle to the middle of a bogie, m.
const TO_BOGIE_M: f64 = 9.5;
/// Pitch and yaw inertia of the body, kg m^2.
const BODY_INERTIA_KG_M2: f64 = 1.97e6;

fn modes(overrides: &[String]) -> Vec<Mode> {
    let vehicle = vehicle::load("coach", overrides).unwrap();
    Standstill::new(&vehicle).unwrap().modes().unwrap()
}

/// The coach with almost no damper force and with undamped axlebox springs.
fn undamped() -> Vec<Mode> {
    let mut overrides = Vec::new();
    for end in ["front", "rear"] {
        for damper in ["vertical", "lateral", "yaw"] {
            let set = "['reduced.damping_n_s_per_m=1', 'mount.clearance_m=0']";
            overrides.push(format!("{end} {damper} damper.set={set}"));
        }
        for place in ["", " inner"] {
            overrides.push(format!("{end}{place} primary.damping_n_s_per_m=[0, 0, 0]"));
        }
    }
    modes(&overrides)
}

fn find<'a>(modes: &'a [Mode], words: &str) -> &'a Mode {
    let found = modes.iter().find(|mode| mode.description() == words);
    found.unwrap_or_else(|| panic!("no {words} in {modes:?}"))
}

fn close(found: f64, expected: f64, part: f64) {
    assert!(
        (found / expected - 1.0).abs() < part,
        "{found} for {expected}"
    );
}

/// Squares of the lower and upper angular frequency of two masses in series on springs, rad^2/s^2.
fn two_masses(upper_kg: f64) -> [f64; 2] {
    let sum = AIRSPRINGS_N_PER_M / upper_kg + (AIRSPRINGS_N_PER_M + AXLEBOXES_N_PER_M) / BOGIE_KG;
    let product = AIRSPRINGS_N_PER_M * AXLEBOXES_N_PER_M / (upper_kg * BOGIE_KG);
    let root = (0.25 * sum * sum - product).sqrt();
    [0.5 * sum - root, 0.5 * sum + root]
}

#[test]
fn bounce_and_pitch_are_those_of_two_masses_in_a_row() {
    let modes = undamped();
    let [lower, upper] = two_masses(BODY_KG).map(|square| square.sqrt() / TAU);
    close(find(&modes, "body bounce").undamped_hz(), lower, 1e-3);
    let bogies = modes
        .iter()
        .find(|mode| mode.description().contains("bogie bounce"));
    close(bogies.unwrap().undamped_hz(), upper, 2e-3);
    // For pitch, the effective mass at each end of the body is its inertia over the square of the lever arm.
    let [lower, _] = two_masses(0.5 * BODY_INERTIA_KG_M2 / TO_BOGIE_M.powi(2));
    let pitch = find(&modes, "body pitch").undamped_hz();
    close(pitch, lower.sqrt() / TAU, 2e-3);
}

/// Damping ratio `phi' C phi/(2 omega phi' M phi)` of the undamped mode shape, accurate to second order in the damping.
#[test]
fn the_bounce_is_damped_by_airspring_dampers_and_axleboxes() {
    let [square, _] = two_masses(BODY_KG);
    // Displacement of the bogie for a unit displacement of the body.
    let bogie = 1.0 - BODY_KG * square / AIRSPRINGS_N_PER_M;
    let damping = 2.0 * 20e3 * (1.0 - bogie).powi(2) + 4.0 * 4e3 * bogie.powi(2);
    let mass = BODY_KG + BOGIE_KG * bogie.powi(2);
    let ratio = damping / (2.0 * square.sqrt() * mass);
    let found = find(&modes(&[]), "body bounce").damping_ratio();
    close(found, ratio, 0.03);
}

/// The body yaws on the shear stiffness of its airsprings: laterally at the bogies, in series with the axlebox springs,
/// and longitudinally off the centre line.
#[test]
fn the_body_yaws_on_the_shear_of_its_airsprings() {
    let (shear, axleboxes) = (2.0 * 160e3, 4.0 * 3.884e6);
    let lateral = shear * axleboxes / (shear + axleboxes);
    let stiffness = 2.0 * lateral * TO_BOGIE_M.powi(2) + 2.0 * shear * 1.0;
    let expected_hz = (stiffness / BODY_INERTIA_KG_M2).sqrt() / TAU;
    close(
        find(&undamped(), "body yaw").undamped_hz(),
        expected_hz,
        0.01,
    );
}

#[test]
fn the_axles_carry_the_mass_and_yaw_dampers_raise_the_critical_speed() {
    let report = |arguments: &[&str]| {
        let all = ["modes", "--vehicle", "coach", "--format", "json"];
        json_of(&dashpot(&[&all, arguments].concat(), Path::new(".")).success())
    };
    let loads = report(&[])["axle_loads_n"].as_array().unwrap().clone();
    assert_eq!(loads.len(), 4);
    let mass_kg = 32000.0 + 2.0 * 2615.0 + 4.0 * 1813.0;
    for load in loads {
        close(load.as_f64().unwrap(), 0.25 * mass_kg * 9.81, 1e-4);
    }
    let critical = |arguments: &[&str]| {
        let report = report(&[&["--hunting"], arguments].concat());
        report["hunting"]["critical_speed_km_h"].as_f64().unwrap()
    };
    let without = ["front", "rear"]
        .map(|end| format!("{end} yaw damper.set=['reduced.damping_n_s_per_m=1']"));
    let without = critical(&["--set", &without[0], "--set", &without[1]]);
    let with = critical(&[]);
    assert!(without > 200.0 && with > without + 50.0, "{without} {with}");
}
