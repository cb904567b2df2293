//! Fixed bug: `Vehicle::step` must not fail, but it panicked on a state of a vehicle with fewer bodies, and silently
//! stepped a state of a vehicle with other masses.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{RailSupport, Stop, Vehicle, VehicleError, VehicleState};
use fastrand::Rng;

use crate::support::{Contact, contact, curve, locomotive, run};

const SUPPORT: RailSupport = RailSupport::new(100.0)
    .with_lateral(20e6, 50e3)
    .with_vertical(70e6, 70e3);

fn vehicle(name: &str, step_s: f64) -> Vehicle<dashpot_rail::creep::KalkerBook> {
    let parameters = dashpot_files::vehicle::load(name, &[]).unwrap();
    Vehicle::new(&parameters, contact(5.0), step_s).unwrap()
}

/// Vehicles to which a state of the locomotive does not belong.
fn others() -> Vec<Vehicle<dashpot_rail::creep::KalkerBook>> {
    let mut heavier = locomotive();
    heavier.bodies[0].mass_kg += 1.0;
    let mut softer = locomotive();
    softer.elements.remove(0);
    let on_rails = Vehicle::on_rails(&locomotive(), contact(5.0), 1e-3, Some(SUPPORT));
    vec![
        vehicle("coach", 1e-3),
        vehicle("locomotive", 0.5e-3),
        Vehicle::new(&heavier, contact(5.0), 1e-3).unwrap(),
        Vehicle::new(&softer, contact(5.0), 1e-3).unwrap(),
        on_rails.unwrap(),
    ]
}

#[test]
fn a_state_of_another_vehicle_is_unchanged_and_reports_it() {
    let own = vehicle("locomotive-without-yaw-dampers", 1e-3);
    let track = curve(300.0);
    let mut before = own.at_rest(&track, 0.0, 20.0).unwrap();
    run(&own, &mut before, &track, 0.1);
    for other in others() {
        let mut state = before.clone();
        assert!(!other.can_step(&state));
        let refused = Err(VehicleError::OtherVehicle);
        assert_eq!(other.displace(&mut state, &track, 0, [0.0; 5]), refused);
        assert_eq!(other.energy(&state), Err(VehicleError::OtherVehicle));
        assert_eq!(state, before);
        other.step(&mut state, &track);
        assert_eq!(state.stop(), Some(Stop::OtherVehicle));
        assert!(state.is_diverged());
        // Its own vehicle does not step it any more, either.
        own.step(&mut state, &track);
        assert_eq!(state.ticks(), before.ticks());
        assert_eq!(state.coordinates(), before.coordinates());
        assert_eq!(state.stop(), Some(Stop::OtherVehicle));
    }
}

/// Vehicles with equal parameters share states, also if a damper or the contact differs.
#[test]
fn a_state_belongs_to_every_vehicle_of_its_parameters() {
    let own = vehicle("locomotive-without-yaw-dampers", 1e-3);
    let track = Track::default();
    let mut state = own.at_rest(&track, 0.0, 20.0).unwrap();
    let mut replaced = vehicle("locomotive-without-yaw-dampers", 1e-3);
    let worn = DamperParameters::reduced(90e3, 0.07, Mount::new(3e6));
    replaced.set_damper(0, &worn).unwrap();
    let undamped: Contact = contact(0.0);
    let others = [
        vehicle("locomotive-without-yaw-dampers", 1e-3),
        replaced,
        Vehicle::new(&locomotive(), undamped, 1e-3).unwrap(),
    ];
    for (other, ticks) in others.iter().zip(1..) {
        assert!(other.can_step(&state));
        other.step(&mut state, &track);
        assert_eq!((state.stop(), state.ticks()), (None, ticks));
    }
}

/// A saved state with damaged bytes either gives a finite result or reports divergence.
#[test]
fn no_number_in_a_state_makes_the_step_panic() {
    let own = vehicle("locomotive-without-yaw-dampers", 1e-3);
    let track = curve(300.0);
    let mut state = own.at_rest(&track, 0.0, 20.0).unwrap();
    run(&own, &mut state, &track, 0.1);
    let whole = postcard::to_stdvec(&state).unwrap();
    let mut rng = Rng::with_seed(13);
    let patterns = [
        f64::NAN,
        -f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        1e300,
        -1e12,
        f64::MIN_POSITIVE,
    ];
    let (mut read, mut diverged) = (0, 0);
    for _ in 0..3_000 {
        let mut bytes = whole.clone();
        let place = rng.usize(..bytes.len() - 8);
        let pattern = patterns[rng.usize(..patterns.len())];
        bytes[place..place + 8].copy_from_slice(&pattern.to_le_bytes());
        let Ok(mut damaged) = postcard::from_bytes::<VehicleState>(&bytes) else {
            continue;
        };
        read += 1;
        for _ in 0..3 {
            own.step(&mut damaged, &track);
        }
        diverged += usize::from(damaged.stop().is_some());
        let finite = damaged
            .coordinates()
            .iter()
            .flatten()
            .all(|q| q.is_finite());
        assert!(finite || damaged.is_diverged(), "byte {place}: {pattern}");
    }
    assert!(read > 1_000 && diverged > 30, "{read} {diverged}");
}

#[test]
fn a_state_with_a_wrong_length_belongs_to_no_vehicle() {
    let own = vehicle("locomotive-without-yaw-dampers", 1e-3);
    let track = Track::default();
    let state = own.at_rest(&track, 0.0, 20.0).unwrap();
    let mut value = serde_json::to_value(&state).unwrap();
    let lists: Vec<String> = value
        .as_object()
        .unwrap()
        .iter()
        .filter(|(_, value)| value.as_array().is_some_and(|list| !list.is_empty()))
        .map(|(name, _)| name.clone())
        .collect();
    assert!(lists.len() > 8, "{lists:?}");
    for name in lists {
        let list = value[&name].as_array_mut().unwrap();
        let last = list.pop().unwrap();
        let mut short: VehicleState = serde_json::from_value(value.clone()).unwrap();
        value[&name].as_array_mut().unwrap().push(last);
        assert!(!own.can_step(&short), "{name}");
        own.step(&mut short, &track);
        assert_eq!(short.stop(), Some(Stop::OtherVehicle), "{name}");
    }
}
