//! What is wrong with a vehicle, where, and what is allowed.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, RidePoint, Standstill, VehicleParameters,
};

fn vehicle() -> VehicleParameters {
    let at = |x: f64, y: f64| [x, y, 0.5];
    let spring = |name: &str, x: f64, y: f64| Element {
        name: name.into(),
        ends: [End::track(at(x, y)), End::body("body", at(x, y))],
        law: Law::SpringDamper {
            stiffness_n_per_m: [1e6; 3],
            damping_n_s_per_m: [0.0; 3],
        },
    };
    VehicleParameters {
        name: "test".into(),
        bodies: vec![Body {
            name: "body".into(),
            mass_kg: 30e3,
            inertia_kg_m2: [30e3, 600e3, 600e3],
            x_m: 0.0,
            height_m: 1.5,
        }],
        wheelsets: vec![],
        elements: vec![
            spring("left", 3.0, -1.0),
            spring("right", -3.0, 1.0),
            spring("third", 3.0, 1.0),
        ],
        ride_points: vec![RidePoint {
            name: "seat".into(),
            on: "body".into(),
            at_m: at(3.0, 1.0),
        }],
    }
}

fn error_of(change: impl FnOnce(&mut VehicleParameters)) -> String {
    let mut vehicle = vehicle();
    change(&mut vehicle);
    Standstill::new(&vehicle).unwrap_err().to_string()
}

type Change = fn(&mut VehicleParameters);

#[test]
fn every_error_says_what_where_and_what_is_allowed() {
    assert!(Standstill::new(&vehicle()).is_ok());
    let cases: [(&str, Change); 14] = [
        (
            "left: points of a stop: allowed: displacements that rise by 1e-6 m at least, and forces that do not fall",
            |v| {
                v.elements[0].law = Law::BumpStop {
                    direction: Direction::Lateral,
                    points: vec![[0.02, 0.0], [0.03, 2e3], [0.03, 5e3]],
                };
            },
        ),
        (
            "left: mount.stiffness_n_per_m = 0 is not allowed: must be 1e4 to 1e12 N/m",
            |v| {
                let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(0.0));
                v.elements[0].law = Law::Damper {
                    direction: Direction::Lateral,
                    parameters: Box::new(parameters),
                };
            },
        ),
        ("body: mass_kg = -1, allowed: 1 to 1000000", |v| {
            v.bodies[0].mass_kg = -1.0
        }),
        ("body: pitch = NaN, allowed: 0.001 to 1000000000", |v| {
            v.bodies[0].inertia_kg_m2[1] = f64::NAN;
        }),
        (
            "left: used twice; every body, wheelset, element and ride point has a name of its own",
            |v| {
                v.elements[1].name = "left".into();
            },
        ),
        (
            "left: attached to bogie, which there is not; there are body",
            |v| {
                v.elements[0].ends[0].on = Some("bogie".into());
            },
        ),
        ("left: both ends are on body", |v| {
            v.elements[0].ends[0].on = Some("body".into());
        }),
        ("left: the ends of this element are at one place", |v| {
            v.elements[0].ends[0].at_m[0] = 1.0;
        }),
        (
            "left: stiffness_n_per_m = -5, allowed: 0 to 1000000000000",
            |v| {
                v.elements[0].law = Law::SpringDamper {
                    stiffness_n_per_m: [-5.0; 3],
                    damping_n_s_per_m: [0.0; 3],
                };
            },
        ),
        ("seat: on bogie, which is no body; there are body", |v| {
            v.ride_points[0].on = "bogie".into()
        }),
        ("seat: height_m = -1, allowed: 0 to 10", |v| {
            v.ride_points[0].at_m[2] = -1.0
        }),
        (
            "body: used twice; every body, wheelset, element and ride point has a name of its own",
            |v| v.ride_points[0].name = "body".into(),
        ),
        ("no body: a vehicle has one at least", |v| v.bodies.clear()),
        (
            "body: not held in pitch; add an element that holds it",
            |v| {
                // All springs in the middle.
                for element in &mut v.elements {
                    for end in &mut element.ends {
                        end.at_m[0] = 0.0;
                        end.at_m[2] = 1.5;
                    }
                }
            },
        ),
    ];
    for (expected, change) in cases {
        assert_eq!(error_of(change), expected);
    }
}
