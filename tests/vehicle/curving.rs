//! Compares curving with force balances and an independent quasi-static computation of the same locomotive.

use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, curve, locomotive, mass_kg, run};

/// Asserts that the relative error is below `tolerance`.
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found / expected - 1.0).abs() < tolerance,
        "{what}: {found} for {expected}"
    );
}

/// The curve has R 300 m, 70 km/h, cant 0.12 m and friction 0.3. The expected values come from an independent nonlinear
/// quasi-static computation, with a contact compliance fitted to the load and spin from the exact theory.
#[test]
fn steady_curving_agrees_with_an_independent_computation() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = curve(300.0);
    let speed = 70.0 / 3.6;
    let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
    run(&vehicle, &mut state, &track, 14.0);
    let leading = state.coordinates()[3];
    assert_near(leading[0], -6.12e-3, 0.03, "lateral displacement");
    assert_near(leading[4], -10.0e-3, 0.03, "yaw");
    let contact = &state.contacts()[0];
    let [outer, inner] = &contact.wheels;
    assert_near(outer.force_n[1], 71.5e3, 0.03, "Y of the outer wheel");
    assert_near(-outer.force_n[2], 138.6e3, 0.03, "Q of the outer wheel");
    assert_near(contact.derailment_coefficients()[0], 0.516, 0.03, "Y/Q");
    assert_near(-inner.force_n[2], 65.9e3, 0.03, "Q of the inner wheel");
    assert_near(contact.force_n[1], 52.8e3, 0.03, "axle force");
    let body = state.coordinates()[0];
    assert_near(body[2], -12.5e-3, 0.03, "roll of the body");
}

/// In a steady curve the forces of the rails balance weight and centrifugal force.
#[test]
fn the_rails_balance_weight_and_centrifugal_force() {
    let parameters = locomotive();
    let mass = mass_kg(&parameters);
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    for (radius, speed) in [(600.0, 100.0 / 3.6), (-400.0, 70.0 / 3.6)] {
        let track = curve(radius);
        let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
        run(&vehicle, &mut state, &track, 16.0);
        let sine = (0.12_f64 / 1.5).copysign(radius);
        let cosine = (1.0 - sine * sine).sqrt();
        let centripetal = speed * speed / radius;
        let outward = 9.81 * sine - centripetal * cosine;
        let down = 9.81 * cosine + centripetal * sine;
        // Mass, height, and lateral offset of the track from its tangent at the vehicle's middle.
        let aside = |x_m: f64| 0.5 * x_m * x_m / radius;
        let bodies: Vec<[f64; 3]> = parameters
            .bodies
            .iter()
            .map(|body| [body.mass_kg, body.height_m, aside(body.x_m)])
            .chain(
                parameters
                    .wheelsets
                    .iter()
                    .map(|wheelset| [wheelset.mass_kg, wheelset.radius_m, aside(wheelset.x_m)]),
            )
            .collect();
        let wheelset = &parameters.wheelsets[0];
        // The body keeps swaying within the clearance of its dampers, so forces are averaged over four periods.
        let ticks = 8000;
        let (mut sums, mut moments) = ([0.0; 2], [0.0; 2]);
        for _ in 0..ticks {
            vehicle.step(&mut state, &track);
            let wheelsets = state.coordinates()[3..].iter().zip(&bodies[3..]);
            for (contact, (q, [_, _, aside])) in state.contacts().iter().zip(wheelsets) {
                let [_, y, z] = contact.force_n;
                let moment = contact.moment_n_m[0] + (q[0] + aside) * z + wheelset.radius_m * y;
                sums[0] += y / f64::from(ticks);
                sums[1] += z / f64::from(ticks);
                moments[0] += moment / f64::from(ticks);
            }
            for ([mass, height, aside], q) in bodies.iter().zip(state.coordinates()) {
                let moment = mass * (outward * height + down * (q[0] + aside));
                moments[1] += moment / f64::from(ticks);
            }
        }
        assert_near(sums[0], -mass * outward, 1e-3, "lateral");
        assert_near(-sums[1], mass * down, 1e-4, "vertical");
        // Moments about the middle of the track: the moment of the rails balances those of the lateral force, the
        // laterally displaced weight and the gyroscopic effect of the wheels.
        let spin = wheelset.inertia_kg_m2[1] * speed / wheelset.radius_m;
        let gyroscopic = parameters.wheelsets.len() as f64 * spin * speed / radius;
        assert_near(
            moments[0],
            gyroscopic - moments[1],
            2e-3,
            "overturning moment",
        );
    }
}
