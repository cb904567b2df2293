//! A saved and restored state steps to the same bits.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, curve, locomotive, run};

#[test]
fn a_restored_state_steps_to_the_same_bits() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = curve(300.0);
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    run(&vehicle, &mut state, &track, 4.0);
    let saved = state.clone();
    run(&vehicle, &mut state, &track, 0.5);
    let mut again = vehicle.at_rest(&track, 7.0, 30.0).unwrap();
    again.clone_from(&saved);
    run(&vehicle, &mut again, &track, 0.5);
    assert_eq!(state, again);
    assert_ne!(state.coordinates(), saved.coordinates());
}

#[test]
fn any_number_of_threads_steps_to_the_same_bits() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = curve(300.0);
    let once = || {
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        run(&vehicle, &mut state, &track, 4.0);
        state
    };
    let alone = once();
    let together: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(once)).collect();
        threads
            .into_iter()
            .map(|thread| thread.join().unwrap())
            .collect()
    });
    assert!(together.iter().all(|state| *state == alone));
}

/// A damper that is replaced in motion continues from its force. An external force acts from the next tick on.
#[test]
fn a_replaced_damper_has_a_continuous_force_and_may_have_an_external_one() {
    let mut vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = curve(300.0);
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    run(&vehicle, &mut state, &track, 3.0);
    let lateral = vehicle
        .damper_names()
        .position(|name| name == "front lateral damper 1")
        .unwrap();
    let before = state.damper_forces_n()[lateral];
    assert!(before.abs() > 50.0, "{before}");
    let worn = DamperParameters::reduced(90e3, 0.07, Mount::new(3e6).clearance_m(8e-3));
    vehicle.set_damper(lateral, &worn).unwrap();
    vehicle.step(&mut state, &track);
    let after = state.damper_forces_n()[lateral];
    assert!(
        (after - before).abs() < 0.1 * before.abs() + 50.0,
        "{before} {after}"
    );

    state.set_outside_force_n(lateral, Some(1234.0)).unwrap();
    vehicle.step(&mut state, &track);
    assert_eq!(state.damper_forces_n()[lateral], 1234.0);
    let error = state.set_outside_force_n(lateral, Some(f64::NAN));
    assert!(error.is_err());
    vehicle.step(&mut state, &track);
    assert_eq!(state.damper_forces_n()[lateral], 1234.0);
    state.set_outside_force_n(lateral, None).unwrap();
    vehicle.step(&mut state, &track);
    assert_ne!(state.damper_forces_n()[lateral], 1234.0);
    assert!(
        vehicle
            .set_damper(99, &worn)
            .unwrap_err()
            .to_string()
            .contains("12")
    );
}
