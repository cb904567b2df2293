//! A wheelset that is pushed over the rail: the limit of Nadal (1896).

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::contact::Status;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, Vehicle, VehicleParameters, Wheelset,
};

use crate::support::contact;

/// A wheelset under a body that keeps its yaw, pushed by a force from outside in the place of a damper.
fn pushed() -> VehicleParameters {
    let mut elements = Vec::new();
    for y in [-1.0, 1.0] {
        let at = [0.0, y, 0.625];
        elements.push(Element {
            name: format!("spring {y}"),
            ends: [End::body("body", at), End::body("wheelset", at)],
            law: Law::SpringDamper {
                stiffness_n_per_m: [50e6, 0.0, 1e6],
                damping_n_s_per_m: [0.0, 0.0, 50e3],
            },
        });
    }
    let at = [0.0, 0.0, 1.5];
    elements.push(Element {
        name: "guide".into(),
        ends: [End::track(at), End::body("body", at)],
        law: Law::Bush {
            stiffness_n_per_m: [0.0, 1e8, 0.0],
            damping_n_s_per_m: [0.0, 1e6, 0.0],
            stiffness_n_m_per_rad: [1e9, 1e9, 1e9],
            damping_n_m_s_per_rad: [1e6, 1e6, 1e6],
        },
    });
    let at = [0.0, 0.0, 0.0];
    elements.push(Element {
        name: "pusher".into(),
        ends: [End::track(at), End::body("wheelset", at)],
        law: Law::Damper {
            direction: Direction::Lateral,
            parameters: Box::new(DamperParameters::reduced(1.0, 1.0, Mount::new(1e4))),
        },
    });
    VehicleParameters {
        name: "pushed wheelset".into(),
        bodies: vec![Body {
            name: "body".into(),
            mass_kg: 18e3,
            inertia_kg_m2: [20e3, 100e3, 100e3],
            x_m: 0.0,
            height_m: 1.5,
        }],
        wheelsets: vec![Wheelset {
            name: "wheelset".into(),
            mass_kg: 1800.0,
            inertia_kg_m2: [900.0, 120.0, 900.0],
            x_m: 0.0,
            radius_m: 0.625,
        }],
        elements,
    }
}

#[test]
fn a_wheelset_pushed_over_the_rail_meets_nadals_limit() {
    let parameters = pushed();
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 2.0).unwrap();
    // The nose towards the rail it is pushed against, so that the flange slides down it as it rolls.
    vehicle.displace(&mut state, &track, 0, [0.0, 0.0, 0.0, 0.0, 30e-3]);
    vehicle.displace(&mut state, &track, 1, [0.0, 0.0, 0.0, 0.0, 30e-3]);
    let mut greatest = 0.0_f64;
    let mut climbed = false;
    for tick in 0..60_000 {
        // Slower than anything moves: 5 kN a second; a damper's force pulls its ends together, so that the push is negative.
        state.set_outside_force_n(0, Some(-5.0 * f64::from(tick)));
        vehicle.step(&mut state, &track);
        assert!(!state.is_diverged());
        greatest = greatest.max(state.contacts()[0].derailment_coefficients()[1]);
        if state.status() >= Status::Climbing {
            climbed = true;
            break;
        }
    }
    assert!(climbed, "{:?} at Y/Q {greatest}", state.status());
    // (tan delta - mu)/(1 + mu tan delta), the flange of S1002 at 70 degrees.
    let tan = 70_f64.to_radians().tan();
    let limit = (tan - 0.3) / (1.0 + 0.3 * tan);
    assert!(
        (greatest / limit - 1.0).abs() < 0.03,
        "{greatest} for {limit}"
    );
}
