//! Vehicles whose wheelsets differ in their contacts.

use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::track::{Defect, Irregularity, Layout, Track};
use dashpot_rail::vehicle::{Body, Running, Vehicle, VehicleError, VehicleParameters, Wheelset};

use crate::support::{Contact, contact, four_springs};

const SMALL_RADIUS_M: f64 = 0.46;

/// A held body between two free wheelsets; the rear one has smaller wheels.
fn parameters() -> VehicleParameters {
    let wheelset = |name: &str, radius_m: f64, x_m: f64| {
        Wheelset::new(name, 12e3, [1.5e3, 400.0, 1.5e3], radius_m).with_x_m(x_m)
    };
    VehicleParameters::new("two wheelsets")
        .with_bodies([Body::new("body", 20e3, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([
            wheelset("front", 0.625, 5.0),
            wheelset("rear", SMALL_RADIUS_M, -5.0),
        ])
        .with_elements(four_springs("body", [250e3; 3], 0.0, [3.0, 1.0, 1.5]))
}

/// S1002 on UIC 60 with the smaller wheels.
fn small() -> Contact {
    let installation = Installation::STANDARD.with_wheel_radius_m(SMALL_RADIUS_M);
    let pair = Pair::standard(installation).unwrap();
    let tables = Tables::new(ContactGeometry::new(pair, Steel::default()).unwrap());
    let friction = Friction::constant(0.3);
    let contact = WheelsetContact::new(Arc::new(tables), KalkerBook::new(), friction).unwrap();
    Arc::new(contact.with_normal_damping(5.0).unwrap())
}

#[test]
fn each_wheelset_rolls_on_its_own_radius() {
    let contacts = vec![contact(5.0), small()];
    let vehicle = Vehicle::with_contacts(&parameters(), contacts, 1e-3, None).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    for _ in 0..500 {
        vehicle.step(&mut state, &track);
    }
    for (axle, radius_m) in [(0, 0.625), (1, SMALL_RADIUS_M)] {
        let contact = &state.contacts()[axle];
        assert!((-contact.force_n[2] / (12e3 * 9.81) - 1.0).abs() < 1e-6);
        // Free rolling on the own radius: no wheel is driven or braked.
        let along = contact.wheels.iter().map(|wheel| wheel.force_n[0].abs());
        assert!(along.fold(0.0, f64::max) < 50.0, "{contact:?}");
        for patch in contact
            .wheels
            .iter()
            .flat_map(|wheel| wheel.loaded_patches())
        {
            assert!((patch.rolling_radius_m - radius_m).abs() < 1e-3);
        }
    }
}

#[test]
fn a_shared_contact_gives_the_same_bits_as_one_for_each_wheelset() {
    let mut parameters = parameters();
    parameters.wheelsets[1].radius_m = parameters.wheelsets[0].radius_m;
    let dip = Defect::CosineDip {
        rails: dashpot_rail::track::Rails::Left,
        start_m: 2.0,
        length_m: 3.0,
        depth_m: 4e-3,
    };
    let track = Track::new(Layout::default(), Irregularity::default(), vec![dip]).unwrap();
    let run = |vehicle: Vehicle<KalkerBook>| {
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        for _ in 0..300 {
            vehicle.step(&mut state, &track);
        }
        state.coordinates().to_vec()
    };
    let shared = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let own = vec![contact(5.0); parameters.wheelsets.len()];
    let own = Vehicle::with_contacts(&parameters, own, 1e-3, None).unwrap();
    assert_eq!(run(shared), run(own));
}

#[test]
fn the_number_of_contacts_must_be_that_of_the_wheelsets() {
    let wrong = |contacts| VehicleError::Contacts {
        contacts,
        wheelsets: 2,
    };
    let built = Vehicle::with_contacts(&parameters(), vec![contact(5.0); 3], 1e-3, None);
    assert_eq!(built.unwrap_err(), wrong(3));
    let linear = Running::with_contacts(&parameters(), &[&*contact(5.0)], 20.0);
    assert_eq!(linear.unwrap_err(), wrong(1));
}

/// Linear equations with two contacts have the modes of the vehicles that have one of them on both wheelsets.
#[test]
fn the_linear_equations_use_the_contact_of_each_wheelset() {
    let (large, small) = (contact(5.0), small());
    let modes = |contacts: &[&WheelsetContact<KalkerBook>]| {
        let running = Running::with_contacts(&parameters(), contacts, 20.0).unwrap();
        let modes = running.modes().unwrap();
        let near = |mode: &dashpot_rail::vehicle::Mode| mode.undamped_hz() < 20.0;
        modes
            .iter()
            .filter(|mode| near(mode))
            .map(|mode| mode.undamped_hz())
            .collect::<Vec<_>>()
    };
    let both = modes(&[&large, &small]);
    let contains = |all: &[f64], hz: f64| all.iter().any(|known| (known / hz - 1.0).abs() < 1e-6);
    let only_large = modes(&[&large, &large]);
    let only_small = modes(&[&small, &small]);
    // The wheelsets are not connected, so each keeps its own modes.
    for hz in &both {
        assert!(
            contains(&only_large, *hz) || contains(&only_small, *hz),
            "{hz} of {both:?}"
        );
    }
    assert!(
        both.iter().any(|hz| !contains(&only_large, *hz)),
        "{both:?} {only_large:?}"
    );
    assert!(
        both.iter().any(|hz| !contains(&only_small, *hz)),
        "{both:?} {only_small:?}"
    );
}
