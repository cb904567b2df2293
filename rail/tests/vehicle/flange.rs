//! A wheelset pushed over the rail, against the limit of Nadal (1896).

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::contact::Status;
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, Vehicle, VehicleParameters, Wheelset,
};

use crate::support::{contact, run};

/// Distance of the wheelset ahead of its body, m. The body follows the curve, so the angle of attack is this distance
/// over the radius.
const AHEAD_M: f64 = 6.0;

/// A wheelset guided by a body; an external force in place of a damper pushes it.
fn pushed() -> VehicleParameters {
    let mut elements = Vec::new();
    for y in [-1.0, 1.0] {
        let at = [AHEAD_M, y, 0.625];
        let law = Law::SpringDamper {
            stiffness_n_per_m: [50e6, 0.0, 1e6],
            damping_n_s_per_m: [0.0, 0.0, 50e3],
        };
        let ends = [End::body("body", at), End::body("wheelset", at)];
        elements.push(Element::new(format!("spring {y}"), ends, law));
    }
    let at = [0.0, 0.0, 1.5];
    let law = Law::Bush {
        stiffness_n_per_m: [0.0, 1e8, 0.0],
        damping_n_s_per_m: [0.0, 1e6, 0.0],
        stiffness_n_m_per_rad: [1e9; 3],
        damping_n_m_s_per_rad: [1e6; 3],
    };
    let ends = [End::track(at), End::body("body", at)];
    elements.push(Element::new("guide", ends, law));
    let at = [AHEAD_M, 0.0, 0.0];
    let law = Law::Damper {
        direction: Direction::Lateral,
        parameters: Box::new(DamperParameters::reduced(1.0, 1.0, Mount::new(1e4))),
    };
    let ends = [End::track(at), End::body("wheelset", at)];
    elements.push(Element::new("pusher", ends, law));
    let wheelset = Wheelset::new("wheelset", 1800.0, [900.0, 120.0, 900.0], 0.625);
    VehicleParameters::new("pushed wheelset")
        .with_bodies([Body::new("body", 18e3, [20e3, 100e3, 100e3], 1.5)])
        .with_wheelsets([wheelset.with_x_m(AHEAD_M)])
        .with_elements(elements)
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
    let mut max = 0.0_f64;
    let mut climbed = false;
    for tick in 0..60_000 {
        // Pushes toward the outer rail, at a quasi-static rate of 5 kN/s.
        let force_n = 5.0 * f64::from(tick);
        state.set_outside_force_n(0, Some(force_n)).unwrap();
        vehicle.step(&mut state, &track);
        assert!(!state.is_diverged());
        max = max.max(state.contacts()[0].derailment_coefficients()[0]);
        if state.status() >= Status::Climbing {
            climbed = true;
            break;
        }
    }
    assert!(climbed, "{:?} at Y/Q {max}", state.status());
    // (tan delta - mu)/(1 + mu tan delta), with the flange angle of 70 degrees of S1002.
    let tan = 70_f64.to_radians().tan();
    let limit = (tan - 0.3) / (1.0 + 0.3 * tan);
    assert!((max / limit - 1.0).abs() < 0.03, "{max} for {limit}");
}
