//! Step and reference with unequal wheels, friction that differs between the rails, and a changing gauge.

use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::profile::{Profile, s1002, uic60};
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleError, VehicleParameters};
use dashpot_reference::ReferenceError;
use dashpot_reference::vehicle::VehicleReference;

use crate::common::{dip, straight, wagon};

type Contact = Arc<WheelsetContact<KalkerBook>>;

/// S1002 with up to 0.3 mm worn off its tread, most at 10 mm to the field side.
fn worn() -> Profile {
    let points: Vec<[f64; 2]> = s1002::profile()
        .points()
        .iter()
        .step_by(5)
        .map(|point| {
            let from_deepest = (point.y_m - 0.01) / 0.02;
            [
                point.y_m,
                point.z_m - 0.3e-3 * (-from_deepest * from_deepest).exp(),
            ]
        })
        .collect();
    Profile::through("worn", &points, 0.0).unwrap()
}

fn tables(wheel: Profile, radius_m: f64) -> Arc<Tables> {
    let installation = Installation::default().with_wheel_radius_m(radius_m);
    let pair = Pair::new(wheel, &uic60::profile(), installation).unwrap();
    Arc::new(Tables::new(
        ContactGeometry::new(pair, Steel::default()).unwrap(),
    ))
}

const REAR_RADIUS_M: f64 = 0.5;

/// The front axle has a worn left wheel, the rear axle smaller wheels.
fn contacts(friction: Friction) -> Vec<Contact> {
    let new = tables(s1002::profile(), 0.625);
    let small = tables(s1002::profile(), REAR_RADIUS_M);
    let sides = [[tables(worn(), 0.625), new], [Arc::clone(&small), small]];
    sides
        .map(|sides| {
            let contact = WheelsetContact::with_sides(sides, KalkerBook::new(), friction);
            Arc::new(contact.unwrap().with_normal_damping(5.0).unwrap())
        })
        .into()
}

/// The wagon with smaller wheels at the rear.
fn vehicle() -> VehicleParameters {
    let mut wagon = wagon([200e3, 60e3, 30e3]);
    wagon.wheelsets[1].radius_m = REAR_RADIUS_M;
    wagon
}

/// A dip, then a gauge that widens by 12 mm and a right rail on which the friction drops to a fifth.
fn track() -> Track {
    let track = straight(vec![dip(12.0)]);
    let track = track
        .with_gauge(&[[20.0, 0.0], [30.0, 0.012], [45.0, -0.002]])
        .unwrap();
    track
        .with_friction(&[[25.0, 1.0, 1.0], [26.0, 1.0, 0.2], [40.0, 0.6, 0.2]])
        .unwrap()
}

/// Root mean squares of the differences: lateral displacement of the axles, m, and load of the wheels, N.
fn differences(contacts: &[Contact], with_step: &Track, with_reference: &Track) -> [f64; 2] {
    const SPEED: f64 = 25.0;
    let vehicle = vehicle();
    let engine = Vehicle::with_contacts(&vehicle, contacts.to_vec(), 1e-3, None).unwrap();
    let mut state = engine.at_rest(with_step, 0.0, SPEED).unwrap();
    let ticks = 2400;
    let times: Vec<f64> = (1..=ticks).map(|tick| f64::from(tick) * 1e-3).collect();
    let shared = contacts.iter().map(AsRef::as_ref).collect();
    let mut reference =
        VehicleReference::with_contacts(&vehicle, shared, with_reference, SPEED, 0.0).unwrap();
    let samples = reference.run(&times, 1e-7).unwrap();
    let (mut lateral, mut load) = ([0.0; 2], [0.0; 4]);
    for sample in &samples {
        engine.step(&mut state, with_step);
        for (axle, sum) in lateral.iter_mut().enumerate() {
            let error: f64 = state.coordinates()[1 + axle][0] - sample.coordinates[1 + axle][0];
            *sum += error * error;
        }
        for (wheel, sum) in load.iter_mut().enumerate() {
            let of = |contacts: &[WheelsetForces]| contacts[wheel / 2].wheels[wheel % 2].force_n[2];
            *sum += (of(state.contacts()) - of(&sample.contacts)).powi(2);
        }
    }
    assert_eq!(state.stop(), None);
    let worst =
        |sums: &[f64]| (sums.iter().fold(0.0_f64, |a, b| a.max(*b)) / f64::from(ticks)).sqrt();
    [worst(&lateral), worst(&load)]
}

#[test]
fn the_step_runs_as_the_reference() {
    let falling = Friction::constant(0.3)
        .with_residual_ratio(0.5)
        .with_decay_speed_m_per_s(0.5);
    let contacts = contacts(falling);
    let [lateral_m, load_n] = differences(&contacts, &track(), &track());
    assert!(
        lateral_m < 5e-6 && load_n < 300.0,
        "{lateral_m} m, {load_n} N"
    );
    // Each part of the track matters more than the bounds allow, so the reference has seen all of them.
    let with_gauge_only = straight(vec![dip(12.0)])
        .with_gauge(&[[20.0, 0.0], [30.0, 0.012], [45.0, -0.002]])
        .unwrap();
    for other in [with_gauge_only, straight(vec![dip(12.0)])] {
        let [lateral_m, _] = differences(&contacts, &track(), &other);
        assert!(lateral_m > 50e-6, "{lateral_m} m");
    }
    let swapped: Vec<Contact> = contacts.iter().rev().cloned().collect();
    let [lateral_m, _] = differences_between(&contacts, &swapped);
    assert!(lateral_m > 50e-6, "{lateral_m} m");
}

/// Differences of two steps with different contacts.
fn differences_between(first: &[Contact], second: &[Contact]) -> [f64; 2] {
    let track = track();
    let run = |contacts: &[Contact]| {
        let engine = Vehicle::with_contacts(&vehicle(), contacts.to_vec(), 1e-3, None).unwrap();
        let mut state = engine.at_rest(&track, 0.0, 25.0).unwrap();
        for _ in 0..2400 {
            engine.step(&mut state, &track);
        }
        state.coordinates().to_vec()
    };
    let (first, second) = (run(first), run(second));
    [
        (first[1][0] - second[1][0]).abs(),
        (first[2][0] - second[2][0]).abs(),
    ]
}

#[test]
fn the_number_of_contacts_must_be_that_of_the_wheelsets() {
    let contact = crate::common::contact(0.3);
    let track = straight(vec![]);
    let built = VehicleReference::with_contacts(&vehicle(), vec![&contact], &track, 20.0, 0.0);
    let expected = VehicleError::Contacts {
        contacts: 1,
        wheelsets: 2,
    };
    match built.err().unwrap() {
        ReferenceError::Vehicle(error) => assert_eq!(error, expected),
        other => panic!("{other}"),
    }
}
