//! The delay that each damper position of a shipped vehicle bears.

use dashpot_files::case::CaseOptions;
use dashpot_hybrid::plan::{Complex, LoopStability, PlantWithoutDamper, critical_delay, stability};
use dashpot_rail::vehicle::Running;
use dashpot_vehicle_run::contact::ContactSetup;

use dashpot::document;

use crate::DOCUMENT;
use crate::delay_equation::System;
use crate::plan::check;

/// The vehicle of the case at 180 km/h, and the names of its dampers.
fn running(vehicle: &str, km_h: f64) -> (Running, Vec<String>) {
    let mut options = CaseOptions::load("straight-180").unwrap();
    options.set_vehicle(vehicle);
    options.set_number("speed_km_h", km_h);
    let case = options.case().unwrap();
    let contacts = ContactSetup::of_case(&case).unwrap().exact().unwrap();
    let contacts: Vec<_> = contacts.iter().map(AsRef::as_ref).collect();
    let names = case.vehicle.dampers().map(|damper| damper.name.clone());
    let running = Running::with_contacts(&case.vehicle, &contacts, case.speed_m_per_s).unwrap();
    (running, names.collect())
}

/// A damper position: its equation, and the same for the plan.
fn position(running: &Running, number: usize) -> (System, PlantWithoutDamper) {
    let without = running.without_damper(number).unwrap();
    let system = System {
        a: without.state_matrix.clone(),
        b: without.input.clone(),
        c: without.output.clone(),
        d: without.damping_n_s_per_m,
        k: without.stiffness_n_per_m,
        actuator: None,
    };
    (system, without.try_into().unwrap())
}

/// Expected delay of positions by a part of their names, ms.
type Expected<'a> = [(&'a str, Option<f64>)];

fn check_vehicle(vehicle: &str, km_h: f64, expected: &Expected) {
    let (running, names) = running(vehicle, km_h);
    assert!(running.without_damper(names.len()).is_none());
    let mut wrong = Vec::new();
    for (number, name) in names.iter().enumerate() {
        let (system, plant) = position(&running, number);
        let found = critical_delay(&plant).unwrap();
        let (_, expected_ms) = (expected.iter())
            .find(|(part, _)| name.contains(part))
            .unwrap_or_else(|| panic!("{name}"));
        let found_ms = found.map(|found| 1e3 * found.delay_s);
        let is_expected = match (found_ms, expected_ms) {
            (Some(found), Some(expected)) => (found / expected - 1.0).abs() < 1e-3,
            (found, expected) => found.is_none() && expected.is_none(),
        };
        if !is_expected {
            wrong.push(format!("{name}: {found_ms:?} ms, expected {expected_ms:?}"));
        }
        // Of dampers side by side, one is enough.
        if name.ends_with('1') {
            check(&system, found);
        }
    }
    assert!(wrong.is_empty(), "{vehicle}, {km_h} km/h: {wrong:#?}");
}

/// Of each kind the bogie has more than one damper, and what remains damps more than the delayed one can excite.
#[test]
fn the_locomotive_bears_any_delay_of_one_damper_at_180_km_h() {
    check_vehicle("locomotive", 180.0, &[("", None)]);
    check_vehicle("locomotive-without-yaw-dampers", 180.0, &[("", None)]);
}

/// Nearer to its critical speed the locomotive needs its lateral and yaw dampers.
#[test]
fn the_locomotive_bears_less_delay_at_high_speed() {
    check_vehicle(
        "locomotive",
        500.0,
        &[
            ("vertical", None),
            ("front lateral damper 1", Some(27.346)),
            ("front lateral damper 2", Some(48.416)),
            ("rear lateral damper 1", Some(25.075)),
            ("rear lateral damper 2", Some(54.466)),
            ("front yaw", Some(42.190)),
            ("rear yaw", Some(42.027)),
        ],
    );
}

/// The coach has two vertical dampers for each bogie, and its bogie frame bounces on them at 9 Hz.
#[test]
fn the_coach_bears_less_than_half_a_period_of_a_vertical_damper() {
    check_vehicle("coach", 180.0, &[("vertical", Some(41.556)), ("", None)]);
}

/// The damper put back gives the vehicle its eigenvalues again.
#[test]
fn the_vehicle_without_a_damper_and_the_damper_are_the_vehicle() {
    let (running, names) = running("locomotive", 180.0);
    for number in [0, names.len() - 1] {
        let (system, _) = position(&running, number);
        let found = system.roots(0.0);
        for [re, im] in running.eigenvalues_rad_per_s().unwrap() {
            let value = Complex::new(re, im);
            let distances = found.iter().map(|root| (root - value).norm());
            let nearest = distances.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6 * value.norm().max(1.0), "{value}: {nearest}");
        }
    }
}

/// A lateral damper that is late by a part of its critical delay bears the rest of it.
#[test]
fn the_margin_of_a_delayed_damper_is_the_rest_of_its_critical_delay() {
    let (running, names) = running("locomotive", 500.0);
    let number = names.iter().position(|name| name.contains("lateral"));
    let (_, plant) = position(&running, number.unwrap());
    let critical = critical_delay(&plant).unwrap().unwrap();
    let delayed = |delay_s: f64| stability(&plant, |s| (-s * delay_s).exp()).unwrap();
    let LoopStability::Stable { margin } = delayed(0.008) else {
        panic!("unstable at 8 ms");
    };
    let rest_s = critical.delay_s - 0.008;
    assert!(
        (margin.unwrap().delay_s / rest_s - 1.0).abs() < 1e-8,
        "{margin:?}"
    );
    let over = delayed(1.01 * critical.delay_s);
    assert_eq!(over, LoopStability::Unstable { roots: 2 });
}

/// The first damper of each kind stands for those beside it.
#[test]
fn the_page_lists_the_critical_delays() {
    let mut table =
        String::from("| vehicle | km/h | damper | critical delay |\n|---|---|---|---|\n");
    for (vehicle, km_h) in [
        ("locomotive", 180.0),
        ("locomotive", 400.0),
        ("locomotive-without-yaw-dampers", 180.0),
        ("coach", 160.0),
    ] {
        let (running, names) = running(vehicle, km_h);
        for (number, name) in names.iter().enumerate() {
            let Some(kind) = name.strip_suffix(" 1") else {
                continue;
            };
            let (_, plant) = position(&running, number);
            let found = critical_delay(&plant).unwrap();
            let text = found.map_or_else(
                || "any".to_owned(),
                |found| {
                    format!(
                        "{:.1} ms, {:.2} Hz",
                        1e3 * found.delay_s,
                        found.frequency_hz
                    )
                },
            );
            table += &format!("| {vehicle} | {km_h:.0} | {kind} | {text} |\n");
        }
    }
    document::compare_part(DOCUMENT, "plan", &table);
}
