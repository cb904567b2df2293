//! Fixed bug: the functions that displace a body and set the external force of a damper silently ignored an index out
//! of range, and a force of NaN switched back to the damper's own model. Only replacing a damper reported a wrong
//! index.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleError};

use crate::support::{contact, locomotive};

#[test]
fn wrong_indices_and_forces_are_errors_and_change_nothing() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    let before = state.clone();

    let error = vehicle.displace(&mut state, &track, 99, [1e-3; 5]);
    let expected = VehicleError::NoSuchBodyIndex {
        body: 99,
        bodies: 9,
    };
    assert_eq!(error, Err(expected.clone()));
    assert_eq!(
        expected.to_string(),
        "body 99: the vehicle has 9 bodies and wheelsets, counted from 0"
    );
    for wrong in [f64::NAN, f64::INFINITY, 10.1, -11.0] {
        let error = vehicle.displace(&mut state, &track, 0, [0.0, 0.0, wrong, 0.0, 0.0]);
        let error = error.unwrap_err().to_string();
        assert_eq!(error, format!("body: roll = {wrong}, allowed: -10 to 10"));
    }

    let error = state.set_outside_force_n(42, Some(1e3)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "damper 42: the vehicle has 12 dampers, counted from 0"
    );
    assert!(state.set_outside_force_n(42, None).is_err());
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = state.set_outside_force_n(0, Some(wrong)).unwrap_err();
        let expected = "external force of";
        assert!(error.to_string().contains(expected), "{error}");
    }
    assert_eq!(state, before);

    vehicle.displace(&mut state, &track, 0, [1e-3; 5]).unwrap();
    state.set_outside_force_n(11, Some(1e3)).unwrap();
    assert_ne!(state, before);
}
