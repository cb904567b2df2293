//! States of a small vehicle: queries, energy, invalid requests, external forces, supported rails and cant.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, GRAVITY_M_PER_S2, Law, RailSupport, Stop, Vehicle, VehicleError,
    VehicleParameters,
};

use crate::support::{contact, four_springs, free_wheelset, run};

const BODY_KG: f64 = 20e3;
const WHEELSET_KG: f64 = 20e3;
const TICK_S: f64 = 1e-3;

fn vertical_damper(name: &str, on: &str, at: [f64; 3]) -> Element {
    let law = Law::Damper {
        direction: Direction::Vertical,
        parameters: Box::new(DamperParameters::reduced(20e3, 1.0, Mount::new(4e6))),
    };
    Element::new(name, [End::track(at), End::body(on, at)], law)
}

/// A body of 20 t on springs of 1 MN/m over a wheelset, each with a vertical damper to the track.
fn parameters() -> VehicleParameters {
    VehicleParameters::new("small")
        .with_bodies([Body::new("body", BODY_KG, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([free_wheelset()])
        .with_elements(four_springs("body", [250e3; 3], 0.0, [3.0, 1.0, 1.5]))
        .with_elements([
            vertical_damper("upper damper", "body", [0.0, 0.0, 1.5]),
            vertical_damper("lower damper", "wheelset", [0.0, 0.0, 0.625]),
        ])
}

fn vehicle() -> Vehicle<KalkerBook> {
    Vehicle::new(&parameters(), contact(5.0), TICK_S).unwrap()
}

#[test]
fn a_vehicle_reports_its_parts_and_steps() {
    let vehicle = vehicle();
    assert_eq!(vehicle.names(), ["body", "wheelset"]);
    assert_eq!(vehicle.wheelsets(), 1);
    let names: Vec<&str> = vehicle.damper_names().collect();
    assert_eq!(names, ["upper damper", "lower damper"]);
    let loads: Vec<f64> = vehicle.axle_loads_n().collect();
    assert_eq!(loads, [WHEELSET_KG * GRAVITY_M_PER_S2]);
    // The steps inside a tick are equal and at most 0.25 ms long.
    for (tick_s, step_s) in [(1e-3, 0.25e-3), (0.3e-3, 0.15e-3), (0.25e-3, 0.25e-3)] {
        let vehicle = Vehicle::new(&parameters(), contact(5.0), tick_s).unwrap();
        assert_eq!(vehicle.step_s(), tick_s);
        assert!((vehicle.inner_step_s() - step_s).abs() < 1e-12);
    }
}

#[test]
fn a_state_reports_its_ticks_distance_and_forces() {
    let (vehicle, track) = (vehicle(), Track::default());
    let mut state = vehicle.at_rest(&track, 7.0, 20.0).unwrap();
    run(&vehicle, &mut state, &track, 0.1);
    assert_eq!((state.ticks(), state.speed_m_per_s()), (100, 20.0));
    assert!((state.distance_m() - 9.0).abs() < 1e-9);
    assert_eq!(
        (state.coordinates().len(), state.velocities().len()),
        (2, 2)
    );
    assert!(state.rail_coordinates().is_empty());
    assert!(!state.is_diverged());
    let load = 0.5 * WHEELSET_KG * GRAVITY_M_PER_S2;
    for greatest in state.extremes()[0].greatest_loads_n {
        assert!(
            (greatest / load - 1.0).abs() < 1e-3,
            "{greatest} for {load}"
        );
    }
}

/// A body that is displaced by z and has no dashpots keeps the energy `k z^2 / 2`.
#[test]
fn a_displaced_body_keeps_its_energy() {
    let mut undamped = parameters();
    undamped.elements.truncate(4);
    let vehicle = Vehicle::new(&undamped, contact(0.0), 0.25e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    assert!(vehicle.energy(&state).unwrap().total_j().abs() < 1e-6);
    let displacement = [0.0, 10e-3, 0.0, 0.0, 0.0];
    vehicle
        .displace(&mut state, &track, 0, displacement)
        .unwrap();
    let expected = 0.5 * 1e6 * 10e-3 * 10e-3;
    let start = vehicle.energy(&state).unwrap();
    assert!((start.potential_j - expected).abs() < 1e-6, "{start:?}");
    let (mut max_kinetic, mut max_error) = (0.0_f64, 0.0_f64);
    for _ in 0..4000 {
        vehicle.step(&mut state, &track);
        let energy = vehicle.energy(&state).unwrap();
        assert_eq!(energy.dissipation_w, 0.0);
        max_kinetic = max_kinetic.max(energy.kinetic_j);
        max_error = max_error.max((energy.total_j() - expected).abs());
    }
    assert!((max_kinetic / expected - 1.0).abs() < 1e-3, "{max_kinetic}");
    assert!(max_error < 1e-3 * expected, "{max_error}");
}

/// Dashpots parallel to the springs dissipate `c v^2`.
#[test]
fn dashpots_dissipate_power() {
    let mut damped = parameters();
    damped.elements.truncate(4);
    for element in &mut damped.elements {
        element.law = Law::SpringDamper {
            stiffness_n_per_m: [250e3; 3],
            damping_n_s_per_m: [0.0, 0.0, 5e3],
        };
    }
    let vehicle = Vehicle::new(&damped, contact(0.0), 0.25e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    let displacement = [0.0, 10e-3, 0.0, 0.0, 0.0];
    vehicle
        .displace(&mut state, &track, 0, displacement)
        .unwrap();
    let start = vehicle.energy(&state).unwrap().total_j();
    let mut dissipated = 0.0;
    for _ in 0..4000 {
        vehicle.step(&mut state, &track);
        let power = vehicle.energy(&state).unwrap().dissipation_w;
        let velocity = state.velocities()[0][1];
        assert!((power - 20e3 * velocity * velocity).abs() < 1e-6);
        dissipated += power * 0.25e-3;
    }
    let lost = start - vehicle.energy(&state).unwrap().total_j();
    assert!(
        lost > 0.3 * start && (dissipated / lost - 1.0).abs() < 2e-3,
        "{dissipated} {lost}"
    );
}

#[test]
fn invalid_requests_are_errors_and_change_nothing() {
    let (vehicle, track) = (vehicle(), Track::default());
    for (distance_m, speed) in [(0.0, 0.9), (0.0, 151.0), (1.1e6, 20.0), (f64::NAN, 20.0)] {
        let error = vehicle.at_rest(&track, distance_m, speed);
        assert!(
            matches!(error, Err(VehicleError::OutOfBounds { .. })),
            "{distance_m} {speed}"
        );
    }
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    let before = state.clone();
    let error = vehicle
        .displace(&mut state, &track, 2, [0.0; 5])
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "body 2: the vehicle has 2 bodies and wheelsets, counted from 0"
    );
    let error = vehicle.displace(&mut state, &track, 0, [0.0, 0.0, 10.1, 0.0, 0.0]);
    assert_eq!(
        error.unwrap_err().to_string(),
        "body: roll = 10.1, allowed: -10 to 10"
    );
    for (damper, force_n) in [(2, 1.0), (0, f64::NAN), (1, f64::INFINITY)] {
        assert!(state.set_outside_force_n(damper, Some(force_n)).is_err());
    }
    assert_eq!(state, before);
    let other = Vehicle::new(&parameters(), contact(5.0), 0.5e-3).unwrap();
    assert!(vehicle.can_step(&state) && !other.can_step(&state));
    assert_eq!(other.energy(&state), Err(VehicleError::OtherVehicle));
    other.step(&mut state, &track);
    assert_eq!((state.stop(), state.ticks()), (Some(Stop::OtherVehicle), 0));
    assert!(Vehicle::new(&parameters(), contact(5.0), 3e-3).is_err());
    let mut without = parameters();
    without.wheelsets.clear();
    without.elements.pop();
    let error = Vehicle::new(&without, contact(5.0), TICK_S).unwrap_err();
    assert_eq!(error, VehicleError::NoWheelset);
}

/// A constant external force F displaces the body by F/k. Damper forces are positive if they resist extension.
#[test]
fn an_external_force_replaces_that_of_a_damper() {
    let (mut vehicle, track) = (vehicle(), Track::default());
    let stiff = DamperParameters::reduced(200e3, 1.0, Mount::new(4e6));
    assert!(vehicle.set_damper(2, &stiff).is_err());
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    state.set_outside_force_n(0, Some(-5e3)).unwrap();
    let mut sum = 0.0;
    // Undamped oscillation about F/k over whole periods of 2 pi / sqrt(50).
    let ticks = (10.0 * 2.0 * std::f64::consts::PI / 50.0_f64.sqrt() / TICK_S).round() as usize;
    for _ in 0..ticks {
        vehicle.step(&mut state, &track);
        assert_eq!(state.damper_forces_n()[0], -5e3);
        sum += state.coordinates()[0][1];
    }
    let mean = sum / ticks as f64;
    assert!((mean - 5e-3).abs() < 0.1e-3, "{mean}");
    // The damper's own model returns, and stops the oscillation once it is stiff.
    vehicle.set_damper(0, &stiff).unwrap();
    state.set_outside_force_n(0, None).unwrap();
    run(&vehicle, &mut state, &track, 5.0);
    assert!(state.coordinates()[0][1].abs() < 1e-4);
    assert!(state.damper_displacements_m()[0].abs() < 1e-4);
}

/// Rails sink by the additional load divided by their stiffness.
#[test]
fn supported_rails_sink_by_force_over_stiffness() {
    let support = RailSupport::new(60.0)
        .with_lateral(40e6, 60e3)
        .with_vertical(80e6, 200e3);
    let vehicle = Vehicle::on_rails(&parameters(), contact(5.0), TICK_S, Some(support)).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    state.set_outside_force_n(1, Some(-40e3)).unwrap();
    run(&vehicle, &mut state, &track, 3.0);
    let [left_y, left_z, right_y, right_z, unused] = state.rail_coordinates()[0];
    for z in [left_z, right_z] {
        assert!((z - 20e3 / 80e6).abs() < 2e-6, "{z}");
    }
    // The inclined contacts push the rails apart symmetrically.
    assert!(
        left_y < 0.0 && (left_y + right_y).abs() < 1e-7,
        "{left_y} {right_y}"
    );
    assert_eq!(unused, 0.0);
}

/// An accelerometer on a body at rest in a canted curve measures `v^2/R cos - g sin` toward the inside and `g (1 - cos)
/// - v^2/R sin`.
#[test]
fn cant_and_curvature_accelerate_a_body() {
    const RADIUS_M: f64 = 400.0;
    let parts = [
        Part::Straight { length_m: 20.0 },
        Part::Transition { length_m: 50.0 },
        Part::Circular {
            radius_m: RADIUS_M,
            length_m: 2000.0,
            cant_m: 0.12,
        },
    ];
    let track = Track::new(
        Layout::new(&parts).unwrap(),
        Irregularity::default(),
        vec![],
    )
    .unwrap();
    let vehicle = vehicle();
    let speed = 20.0;
    let state = vehicle.at_rest(&track, 100.0, speed).unwrap();
    let sine = 0.12_f64 / 1.5;
    let cosine = (1.0 - sine * sine).sqrt();
    let centripetal = speed * speed / RADIUS_M;
    let lateral = GRAVITY_M_PER_S2 * sine - centripetal * cosine;
    let vertical = GRAVITY_M_PER_S2 * (cosine - 1.0) + centripetal * sine;
    let found = state.track_acceleration(0);
    assert!((found[0] - lateral).abs() < 1e-12, "{found:?} {lateral}");
    assert!((found[1] - vertical).abs() < 1e-12, "{found:?} {vertical}");
    assert_eq!(found[2..], [0.0; 3]);
    // The track turns with the yaw rate v/R.
    assert!((state.velocities()[0][4] - speed / RADIUS_M).abs() < 1e-12);
}
