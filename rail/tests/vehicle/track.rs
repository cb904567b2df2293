//! Bodies and wheelsets on curved and twisted track, against geometry.

use dashpot_rail::track::{Defect, Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{Body, Element, End, Law, Vehicle, VehicleParameters, Wheelset};

use crate::support::{contact, four_springs, free_wheelset, run};

/// A lateral spring couples a body with one that is `AHEAD_M` ahead of it. In a curve of the radius R, the frame of the
/// body ahead lies `AHEAD_M^2/(2 R)` to the side of the tangent and is turned by `AHEAD_M/R`, so its point above the
/// spring lies `-AHEAD_M^2/(2 R)` to the side. The three springs in series divide this offset.
#[test]
fn a_curve_stretches_a_spring_between_bodies_by_its_versine() {
    const AHEAD_M: f64 = 6.0;
    const RADIUS_M: f64 = 200.0;
    let (held, coupling) = (4e6, 1e6);
    let guide = |name: &str, x: f64| {
        let at = [x, 0.0, 1.5];
        let law = Law::Bush {
            stiffness_n_per_m: [0.0, held, 4e6],
            damping_n_s_per_m: [0.0, 400e3, 400e3],
            stiffness_n_m_per_rad: [1e12; 3],
            damping_n_m_s_per_rad: [1e9; 3],
        };
        Element::new(
            format!("{name} guide"),
            [End::track(at), End::body(name, at)],
            law,
        )
    };
    let at = [0.0, 0.0, 1.5];
    let law = Law::SpringDamper {
        stiffness_n_per_m: [0.0, coupling, 0.0],
        damping_n_s_per_m: [0.0; 3],
    };
    let link = Element::new(
        "link",
        [End::body("middle", at), End::body("ahead", at)],
        law,
    );
    let body = |name: &str| Body::new(name, 10e3, [10e3, 100e3, 100e3], 1.5);
    let parameters = VehicleParameters::new("pair")
        .with_bodies([body("middle"), body("ahead").with_x_m(AHEAD_M)])
        .with_wheelsets([free_wheelset()])
        .with_elements([guide("middle", 0.0), guide("ahead", AHEAD_M), link]);
    let parts = [
        Part::Straight { length_m: 20.0 },
        Part::Transition { length_m: 20.0 },
        Part::Circular {
            radius_m: RADIUS_M,
            length_m: 100.0,
            cant_m: 0.0,
        },
    ];
    let layout = Layout::new(&parts).unwrap();
    let track = Track::new(layout, Irregularity::default(), vec![]).unwrap();
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let speed = 2.0;
    let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
    run(&vehicle, &mut state, &track, 35.0);
    let versine = AHEAD_M * AHEAD_M / (2.0 * RADIUS_M);
    // The centrifugal force displaces both bodies outward, to the left, and does not stretch the spring between them.
    let outward = -10e3 * speed * speed / RADIUS_M / held;
    let share = versine / (1.0 + 2.0 * coupling / held) * coupling / held;
    let [middle, ahead] = [0, 1].map(|body| state.coordinates()[body][0]);
    assert!(
        (middle - (outward - share)).abs() < 1e-3 * versine,
        "{middle} {share} {outward}"
    );
    assert!(
        (ahead - (outward + share)).abs() < 1e-3 * versine,
        "{ahead} {share} {outward}"
    );
}

/// A slow wheelset rolls by the cross level over the distance between its contact points, and is level again after the
/// twist.
#[test]
fn a_wheelset_follows_a_twist_to_its_end() {
    const CROSS_LEVEL_M: f64 = 12e-3;
    let twist = Defect::Twist {
        start_m: 5.0,
        base_m: 3.0,
        plateau_m: 4.0,
        cross_level_m: CROSS_LEVEL_M,
        rounding_m: 0.2,
    };
    let track = Track::new(Layout::default(), Irregularity::default(), vec![twist]).unwrap();
    let mut elements = four_springs("body", [250e3; 3], 0.0, [3.0, 1.0, 1.5]);
    for y in [-1.0, 1.0] {
        let at = [0.0, y, 0.625];
        let law = Law::SpringDamper {
            stiffness_n_per_m: [10e6, 10e6, 1e3],
            damping_n_s_per_m: [100e3, 100e3, 0.0],
        };
        let ends = [End::body("wheelset", at), End::body("body", at)];
        elements.push(Element::new(format!("guide {y}"), ends, law));
    }
    let parameters = VehicleParameters::new("guided wheelset")
        .with_bodies([Body::new("body", 20e3, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([Wheelset::new("wheelset", 20e3, [2e3, 500.0, 2e3], 0.625)])
        .with_elements(elements);
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let mut state = vehicle.at_rest(&track, 0.0, 1.0).unwrap();
    // Right side down is a positive roll; a positive cross level raises the left rail.
    for (distance_m, cross_level_m) in [
        (4.8, 0.0),
        (6.5, 0.5 * CROSS_LEVEL_M),
        (10.0, CROSS_LEVEL_M),
        (13.5, 0.5 * CROSS_LEVEL_M),
        (15.2, 0.0),
        (16.0, 0.0),
    ] {
        while state.distance_m() < distance_m - 0.5e-3 {
            vehicle.step(&mut state, &track);
        }
        let [_, _, roll, ..] = state.coordinates()[1];
        let expected = cross_level_m / 1.5;
        assert!(
            (roll - expected).abs() < 0.03 * CROSS_LEVEL_M,
            "{distance_m} m: {roll} for {expected}"
        );
    }
    assert_eq!(state.stop(), None);
}
