//! What stands still stays, and a body on springs moves as its closed form has it.

use std::f64::consts::PI;

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, Vehicle, VehicleParameters, Wheelset,
};

use crate::support::{contact, locomotive, mass_kg, run};

#[test]
fn the_locomotive_rests_for_a_minute() {
    let parameters = locomotive();
    let vehicle = Vehicle::new(&parameters, contact(0.0), 1e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 50.0).unwrap();
    let weight = 9.81 * mass_kg(&parameters);
    run(&vehicle, &mut state, &track, 60.0);
    assert!((state.distance_m() - 3000.0).abs() < 1e-6);
    // Wheelsets are followed within rounding of the contact's tables; the rails carry the weight.
    for coordinates in state.coordinates() {
        for coordinate in coordinates {
            assert!(coordinate.abs() < 1e-8, "{coordinates:?}");
        }
    }
    let carried: f64 = state
        .contacts()
        .iter()
        .map(|contact| -contact.force_n[2])
        .sum();
    assert!((carried / weight - 1.0).abs() < 1e-6, "{carried}");
    assert!(
        state
            .damper_forces_n()
            .iter()
            .all(|force| force.abs() < 1e-3)
    );
}

/// A body over a wheelset whose primary springs are so stiff that it stands on the track.
fn suspended(elements: Vec<Element>) -> VehicleParameters {
    let mut all = elements;
    let at = |x: f64, y: f64| [x, y, 1.5];
    for (name, x, y) in [
        ("a", 3.0, 1.0),
        ("b", -3.0, 1.0),
        ("c", 3.0, -1.0),
        ("d", -3.0, -1.0),
    ] {
        all.push(Element {
            name: name.into(),
            ends: [End::track(at(x, y)), End::body("body", at(x, y))],
            law: Law::SpringDamper {
                stiffness_n_per_m: [250e3; 3],
                damping_n_s_per_m: [0.0; 3],
            },
        });
    }
    VehicleParameters {
        name: "suspended".into(),
        bodies: vec![Body {
            name: "body".into(),
            mass_kg: 20e3,
            inertia_kg_m2: [20e3, 200e3, 200e3],
            x_m: 0.0,
            height_m: 1.5,
        }],
        // It rolls under the body without touching it.
        wheelsets: vec![Wheelset {
            name: "wheelset".into(),
            mass_kg: 20e3,
            inertia_kg_m2: [2e3, 500.0, 2e3],
            x_m: 0.0,
            radius_m: 0.625,
        }],
        elements: all,
        ride_points: vec![],
    }
}

/// Displacement of the body after each tick from 10 mm up, with a step of `step_s`.
fn bounce(parameters: &VehicleParameters, step_s: f64, seconds: f64) -> Vec<f64> {
    let vehicle = Vehicle::new(parameters, contact(0.0), step_s).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    vehicle
        .displace(&mut state, &track, 0, [0.0, -10e-3, 0.0, 0.0, 0.0])
        .unwrap();
    let ticks = (seconds / step_s).round() as usize;
    (0..ticks)
        .map(|_| {
            vehicle.step(&mut state, &track);
            state.coordinates()[0][1]
        })
        .collect()
}

#[test]
fn a_suspended_body_bounces_as_a_cosine_to_second_order() {
    let parameters = suspended(vec![]);
    // sqrt(1 MN/m / 20 t)
    let omega = 50.0_f64.sqrt();
    let worst = |step_s: f64| {
        let found = bounce(&parameters, step_s, 3.0);
        let expected = |tick: usize| -10e-3 * (omega * step_s * (tick + 1) as f64).cos();
        let errors = found
            .iter()
            .enumerate()
            .map(|(tick, z)| (z - expected(tick)).abs());
        errors.fold(0.0, f64::max)
    };
    let (fine, coarse) = (worst(0.5e-3), worst(2e-3));
    assert!(coarse < 10e-6, "{coarse}");
    // Steps inside a tick are 0.25 ms long: their error is the same for both, below a ten-thousandth.
    assert!(fine < 1e-6, "{fine}");
}

#[test]
fn a_damper_stops_a_body_as_the_maxwell_element_does() {
    let (c, k) = (60e3, 4e6);
    let at = [0.0, 0.0, 1.5];
    let damper = Element {
        name: "damper".into(),
        ends: [End::track(at), End::body("body", at)],
        law: Law::Damper {
            direction: Direction::Vertical,
            parameters: Box::new(DamperParameters::reduced(c, 10.0, Mount::new(k))),
        },
    };
    let found = bounce(&suspended(vec![damper]), 1e-3, 2.0);
    // m z'' + 1e6 z + F = 0, F' = k (z' - F/c): by a fourth-order step a hundred times as short.
    let rate = |[z, v, f]: [f64; 3]| [v, -(1e6 * z + f) / 20e3, k * (v - f / c)];
    let mut y = [-10e-3, 0.0, 0.0];
    let h = 1e-5;
    let mut worst = 0.0_f64;
    for z in &found {
        for _ in 0..100 {
            let along = |y: [f64; 3], k: [f64; 3], h: f64| {
                [y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2]]
            };
            let k1 = rate(y);
            let k2 = rate(along(y, k1, 0.5 * h));
            let k3 = rate(along(y, k2, 0.5 * h));
            let k4 = rate(along(y, k3, h));
            for i in 0..3 {
                y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
        worst = worst.max((z - y[0]).abs());
    }
    assert!(worst < 5e-6, "{worst}");
    let period = 2.0 * PI / 50.0_f64.sqrt();
    let late = found.iter().skip((1.5 * period * 1e3) as usize);
    assert!(late.map(|z| z.abs()).fold(0.0, f64::max) < 5e-3);
}
