//! Error messages of invalid vehicles.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, RidePoint, Standstill, VehicleParameters,
};

fn vehicle() -> VehicleParameters {
    let at = |x: f64, y: f64| [x, y, 0.5];
    let spring = |name: &str, x: f64, y: f64| {
        let ends = [End::track(at(x, y)), End::body("body", at(x, y))];
        let law = Law::SpringDamper {
            stiffness_n_per_m: [1e6; 3],
            damping_n_s_per_m: [0.0; 3],
        };
        Element::new(name, ends, law)
    };
    VehicleParameters::new("test")
        .with_bodies([Body::new("body", 30e3, [30e3, 600e3, 600e3], 1.5)])
        .with_elements([
            spring("left", 3.0, -1.0),
            spring("right", -3.0, 1.0),
            spring("third", 3.0, 1.0),
        ])
        .with_ride_points([RidePoint::new("seat", "body", at(3.0, 1.0))])
}

fn error_after(change: impl FnOnce(&mut VehicleParameters)) -> String {
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
            "left: points of a stop, allowed: displacements rising by at least 1e-6 m, and forces that do not decrease",
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
            "left: used twice; names of bodies, wheelsets, elements and ride points must be unique",
            |v| {
                v.elements[1].name = "left".into();
            },
        ),
        (
            "left: attached to bogie, which does not exist; allowed: body",
            |v| {
                v.elements[0].ends[0].on = Some("bogie".into());
            },
        ),
        ("left: both ends are on body", |v| {
            v.elements[0].ends[0].on = Some("body".into());
        }),
        (
            "left: both ends of this element must be at the same point",
            |v| {
                v.elements[0].ends[0].at_m[0] = 1.0;
            },
        ),
        (
            "left: stiffness_n_per_m = -5, allowed: 0 to 1000000000000",
            |v| {
                v.elements[0].law = Law::SpringDamper {
                    stiffness_n_per_m: [-5.0; 3],
                    damping_n_s_per_m: [0.0; 3],
                };
            },
        ),
        ("seat: on bogie, which is not a body; allowed: body", |v| {
            v.ride_points[0].on = "bogie".into()
        }),
        ("seat: height_m = -1, allowed: 0 to 10", |v| {
            v.ride_points[0].at_m[2] = -1.0
        }),
        (
            "body: used twice; names of bodies, wheelsets, elements and ride points must be unique",
            |v| v.ride_points[0].name = "body".into(),
        ),
        ("no body: a vehicle needs at least one", |v| {
            v.bodies.clear()
        }),
        (
            "body: free to move in pitch; add an element that constrains it",
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
        assert_eq!(error_after(change), expected);
    }
}

/// With its weight, a body whose springs are too soft for its height is an inverted pendulum that falls.
#[test]
fn a_body_that_tips_over_is_refused() {
    let text = "body: tips over at standstill, because its springs are too soft or too close together \
                for the height of its centre of gravity; make them stiffer or the centre lower";
    let found = error_after(|vehicle| {
        for element in &mut vehicle.elements {
            for end in &mut element.ends {
                end.at_m[1] *= 0.1;
            }
        }
    });
    assert_eq!(found, text);
}
