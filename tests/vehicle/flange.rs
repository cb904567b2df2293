//! A wheelset that is pushed over the rail: the limit of Nadal (1896).

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::contact::Status;
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, Vehicle, VehicleParameters, Wheelset,
};

use crate::support::{contact, run};

/// Distance of the wheelset ahead of its body, which goes along a curve and keeps its yaw: the angle of attack is the distance
/// over the radius.
const AHEAD_M: f64 = 6.0;

/// A wheelset that a body leads, pushed by a force from outside in the place of a damper.
fn pushed() -> VehicleParameters {
    let mut elements = Vec::new();
    for y in [-1.0, 1.0] {
        let at = [AHEAD_M, y, 0.625];
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
    let at = [AHEAD_M, 0.0, 0.0];
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
            x_m: AHEAD_M,
            radius_m: 0.625,
        }],
        elements,
        ride_points: vec![],
    }
}

#[test]
fn a_wheelset_pushed_over_the_rail_meets_nadals_limit() {
    let parameters = pushed();
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let circle = Part::Circular {
        radius_m: 200.0,
        length_m: 1e3,
        cant_m: 0.0,
    };
    let parts = [
        Part::Straight { length_m: 10.0 },
        Part::Transition { length_m: 20.0 },
        circle,
    ];
    let layout = Layout::new(&parts).unwrap();
    let track = Track::new(layout, Irregularity::default(), vec![]).unwrap();
    let mut state = vehicle.at_rest(&track, 0.0, 2.0).unwrap();
    run(&vehicle, &mut state, &track, 20.0);
    let mut greatest = 0.0_f64;
    let mut climbed = false;
    for tick in 0..60_000 {
        // To the outer rail, slower than anything moves: 5 kN a second.
        let force_n = 5.0 * f64::from(tick);
        state.set_outside_force_n(0, Some(force_n)).unwrap();
        vehicle.step(&mut state, &track);
        assert!(!state.is_diverged());
        greatest = greatest.max(state.contacts()[0].derailment_coefficients()[0]);
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
