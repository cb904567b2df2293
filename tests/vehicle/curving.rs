//! Curving against balances and an independent quasi-static computation of the same locomotive.

use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, curve, locomotive, run};

/// Within `part` of a number.
fn is_near(found: f64, expected: f64, part: f64, what: &str) {
    assert!(
        (found / expected - 1.0).abs() < part,
        "{what}: {found} for {expected}"
    );
}

/// R 300 m, 70 km/h, cant 0.12 m, friction 0.3: an independent, nonlinear quasi-static computation with softness fitted to the load
/// and spin after the exact theory.
#[test]
fn the_locomotive_curves_as_an_independent_computation_has_it() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let track = curve(300.0);
    let speed = 70.0 / 3.6;
    let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
    run(&vehicle, &mut state, &track, 14.0);
    let leading = state.coordinates()[3];
    is_near(leading[0], -6.12e-3, 0.03, "lateral displacement");
    is_near(leading[4], -10.0e-3, 0.03, "yaw");
    let contact = &state.contacts()[0];
    let [outer, inner] = &contact.wheels;
    is_near(outer.force_n[1], 71.5e3, 0.03, "Y of the outer wheel");
    is_near(-outer.force_n[2], 138.6e3, 0.03, "Q of the outer wheel");
    is_near(contact.derailment_coefficients()[0], 0.516, 0.03, "Y/Q");
    is_near(-inner.force_n[2], 65.9e3, 0.03, "Q of the inner wheel");
    is_near(contact.force_n[1], 52.8e3, 0.03, "axle force");
    let body = state.coordinates()[0];
    is_near(body[2], -12.5e-3, 0.03, "roll of the body");
    let wear: f64 = contact
        .wheels
        .iter()
        .flat_map(|wheel| wheel.loaded_patches())
        .map(|patch| patch.dissipation_w / speed)
        .sum();
    is_near(wear, 824.0, 0.03, "wear number");
}

/// The rails carry weight and centripetal force: in the curve's steady state their forces are the balance's.
#[test]
fn the_rails_carry_weight_and_centripetal_force() {
    let parameters = locomotive();
    let mass: f64 = parameters
        .bodies
        .iter()
        .map(|body| body.mass_kg)
        .sum::<f64>()
        + parameters
            .wheelsets
            .iter()
            .map(|wheelset| wheelset.mass_kg)
            .sum::<f64>();
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    for (radius, speed) in [(600.0, 100.0 / 3.6), (-400.0, 70.0 / 3.6)] {
        let track = curve(radius);
        let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
        run(&vehicle, &mut state, &track, 16.0);
        let sine = (0.12_f64 / 1.5).copysign(radius);
        let cosine = (1.0 - sine * sine).sqrt();
        let centripetal = speed * speed / radius;
        let lateral = mass * (centripetal * cosine - 9.81 * sine);
        let vertical = mass * (9.81 * cosine + centripetal * sine);
        let sum = |axis: usize| -> f64 {
            state
                .contacts()
                .iter()
                .map(|contact| contact.force_n[axis])
                .sum()
        };
        is_near(sum(1), lateral, 2e-3, "lateral");
        is_near(-sum(2), vertical, 1e-4, "vertical");
        // The load moves to the outer rail by the moment of the lateral force at the height of the centres of gravity, and by
        // how far they have moved to the side: about the rails' top in the track's axes.
        let bodies = parameters
            .bodies
            .iter()
            .map(|body| (body.mass_kg, body.height_m));
        let wheelsets = parameters
            .wheelsets
            .iter()
            .map(|set| (set.mass_kg, set.radius_m));
        let moment: f64 = bodies
            .chain(wheelsets)
            .zip(state.coordinates())
            .map(|((mass, height), q)| {
                let outward = mass * (9.81 * sine - centripetal * cosine);
                let down = mass * (9.81 * cosine + centripetal * sine);
                outward * height + down * q[0]
            })
            .sum();
        let carried: f64 = state
            .contacts()
            .iter()
            .zip(&state.coordinates()[3..])
            .map(|(contact, q)| {
                let [x, y, z] = contact.force_n;
                let _ = x;
                contact.moment_n_m[0] + q[0] * z + 0.625 * y
            })
            .sum();
        // Both include the gyroscopic moment of the wheels that the curve turns.
        let gyroscopic = 6.0 * 405.0 * speed / 0.625 * speed / radius;
        is_near(carried - gyroscopic, -moment, 0.01, "overturning moment");
    }
}
